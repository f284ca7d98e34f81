// SPDX-License-Identifier: MIT
#pragma once

#include "sim/error.hpp"

#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace rovernet {

/// A number or a text of a world file.
using WorldAtom = std::variant<double, std::string>;

/// `name value` or `name [values]`.
struct WorldProperty {
    std::string name;
    std::vector<WorldAtom> values;
    bool is_tuple = false;
    Location where;  ///< place of the name

    /// The number or text. @throws InputError if the value is anything else
    double number() const;
    const std::string& text() const;
};

/// `type ( properties and children )`; macros are expanded: `type` is the last one's base.
struct WorldEntity {
    std::string type = {};                       ///< "position", "model", "wifi"; "" for the file
    std::string macro = {};                      ///< the name it was made by, if it is a macro's
    std::vector<WorldProperty> properties = {};  ///< a later one of the same name overrides
    std::vector<WorldEntity> children = {};
    Location where = {};

    /// The last property of that name, or null.
    const WorldProperty* find(std::string_view name) const;
};

/// Options of reading Stage worlds.
struct WorldOptions {
    std::vector<std::string> search_path =
        {};  ///< folders for includes and bitmaps, then STAGEPATH
    /// Bitmaps by other names: OLD as the world names it, NEW relative to the world or to OLD.
    std::vector<std::pair<std::string, std::string>> bitmaps = {};
    bool lenient = false;  ///< a missing include or bitmap is a notice, not an error
};

/// A parsed world: its entities, and what a person should know of it.
struct WorldFile {
    std::string path;
    WorldEntity root;                  ///< the globals are its properties, the models its children
    std::vector<std::string> notices;  ///< each "file:line: text"
};

/// Reads a Stage world file, of Stage 2 to 4, with its includes and macros. Lengths and angles are
/// as in the file.
///
/// A macro's use is the macro's entity with the properties and children of the use appended. Of two
/// macros of one name the first counts. A model type that Stage does not know is a notice. Bounds:
/// 16 MiB a file and 64 MiB in all, includes 16 deep, entities and macros 64 deep, 1e6 words and
/// values once the macros are expanded.
/// @throws InputError with file, line and column
WorldFile read_worldfile(const std::string& path, const WorldOptions& options);

/// "file:line: text": how a world's notices read; "file: text" for a place without a line.
std::string world_notice(const Location& where, std::string_view text);

}  // namespace rovernet
