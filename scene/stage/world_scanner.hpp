// SPDX-License-Identifier: MIT
#pragma once

#include "scene/stage/world_tokens.hpp"

#include <cstddef>
#include <string>
#include <string_view>

namespace rovernet {

/// Lexer for Stage worlds: splits the text of one world file into tokens.
class WorldScanner {
  public:
    /// @param text    text of the file, which must outlive the scanner
    /// @param file    number of the file, which is stored in its tokens
    /// @param source  name of the file, for error messages
    WorldScanner(std::string_view text, int file, std::string source);

    /// Next token; always file_end after the end of the text.
    /// @throws InputError for text that is not a token
    WorldToken next();

  private:
    char here() const { return at_ < text_.size() ? text_[at_] : '\0'; }
    void skip_blanks();
    void end_line();
    WorldToken piece(WorldToken::Kind kind, std::size_t length);
    WorldToken word();
    WorldToken number();
    WorldToken quoted();
    void check_length(std::string_view found) const;
    [[noreturn]] void fail(std::size_t at, const std::string& message) const;
    [[noreturn]] void reject_number(std::string_view found) const;
    [[noreturn]] void reject_character() const;

    std::string_view text_;
    std::string source_;
    std::size_t at_ = 0;
    std::size_t line_begin_ = 0;
    int file_;
    int line_ = 1;
};

}  // namespace rovernet
