// SPDX-License-Identifier: MIT
#pragma once

#include "scene/stage/worldfile.hpp"
#include "sim/error.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace rovernet {

/// A piece of a world file.
struct WorldToken {
    enum class Kind : std::uint8_t {
        word,         ///< a letter, then letters, digits and . - _ [ ]
        number,       ///< digits with an optional sign and point; no exponent
        text,         ///< text in double quotes, on one line, without escapes
        open,         ///< (
        close,        ///< )
        open_tuple,   ///< [
        close_tuple,  ///< ]
        line_end,
        file_end,  ///< end of the top file
    };
    Kind kind = Kind::file_end;
    std::string text = {};  ///< text as it is written, without quotes
    double number = 0;
    int file = 0;  ///< index into WorldTokens::files
    int line = 1;
    int column = 1;  ///< [bytes] from 1

    /// Words for it in errors: "the word \"size\"", "\"(\"", "the end of the line".
    std::string description() const;
};

/// A world file in pieces, its includes in their places, comments and blanks left out.
struct WorldTokens {
    std::vector<WorldToken> tokens = {};    ///< the last one is the file's end
    std::vector<std::string> files = {};    ///< files as they were found, the top one first
    std::vector<std::string> notices = {};  ///< notices of includes that are left out

    Location where(const WorldToken& token) const {
        return {files[static_cast<std::size_t>(token.file)], token.line, token.column};
    }
};

/// The most tokens of a world, its includes and every use of a macro counted.
inline constexpr std::size_t most_world_tokens = 1'000'000;

/// Reads a world file and what it includes.
///
/// Bounds: 16 MiB a file and 64 MiB in all, includes 16 deep, most_world_tokens tokens.
/// @throws InputError for a file that cannot be read, a token that cannot be, an include that
/// includes itself or is missing (unless options.lenient)
WorldTokens read_world_tokens(const std::string& path, const WorldOptions& options);

}  // namespace rovernet
