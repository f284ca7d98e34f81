// SPDX-License-Identifier: MIT
#pragma once

#include "scene/stage/worldfile.hpp"
#include "sim/error.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace rovernet {

/// Token of a Stage world file.
struct WorldToken {
    enum class Kind : std::uint8_t {
        word,    ///< a letter, then letters, digits and . - _ [ ]
        number,  ///< digits with an optional sign and point; no exponent. In a sequence of digits,
                 ///< signs and points only the number at the front counts, as in Stage
        text,    ///< text in double quotes, on one line, without escapes
        open,    ///< (
        close,   ///< )
        open_tuple,   ///< [
        close_tuple,  ///< ]
        line_end,
        file_end,  ///< end of the world file (not of an included file)
    };
    Kind kind = Kind::file_end;
    std::string text = {};  ///< text of the token, without quotes
    double number = 0;
    bool is_cut = false;  ///< true if ignored characters follow the number: 3.75 in "3.75.2"
    int file = 0;         ///< file of the token: index into WorldTokens::files
    int line = 1;
    int column = 1;  ///< column in the line [bytes], from 1

    /// Description of the token for errors: "the word \"size\"", "\"(\"", "the end of the line".
    std::string description() const;
};

/// Tokens of a Stage world file, without comments and blanks. The tokens of an included file stand
/// in place of the include.
struct WorldTokens {
    std::vector<WorldToken> tokens = {};    ///< the last token is file_end
    std::vector<std::string> files = {};    ///< path of the world file, then paths of its includes
    std::vector<std::string> notices = {};  ///< notices about missing includes, which are left out

    Location where(const WorldToken& token) const {
        return {files[static_cast<std::size_t>(token.file)], token.line, token.column};
    }
};

/// Largest number of tokens of a Stage world, with all includes and after macro expansion.
inline constexpr std::size_t most_world_tokens = 1'000'000;

/// Reads a Stage world file and its includes, and splits them into tokens.
///
/// Limits: 16 MiB per file and 64 MiB in total, includes 16 deep, most_world_tokens tokens.
/// @throws InputError for an unreadable file, an invalid token, and an include that includes itself
///         or is missing (unless options.lenient)
WorldTokens read_world_tokens(const std::string& path, const WorldOptions& options);

}  // namespace rovernet
