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
    Location where;
};

/// `type ( properties and children )`; macros are expanded: `type` is the last one's base.
struct WorldEntity {
    std::string type;                       ///< "position", "model", "wifi"; "" for the whole file
    std::string macro;                      ///< the name it was made by, if it is a macro's
    std::vector<WorldProperty> properties;  ///< a later one of the same name overrides
    std::vector<WorldEntity> children;
    Location where;

    /// The last property of that name, or null.
    const WorldProperty* find(std::string_view name) const;
};

/// How Stage worlds are read.
struct WorldOptions {
    std::vector<std::string> search_path =
        {};  ///< folders for includes and bitmaps, then STAGEPATH
    /// Bitmaps by other names: OLD as the world names it, NEW relative to the world.
    std::vector<std::pair<std::string, std::string>> bitmaps = {};
    bool lenient = false;  ///< a missing include or bitmap is a notice, not an error
};

/// A parsed world: its entities, and what a person should know of it.
struct WorldFile {
    std::string path;
    WorldEntity root;  ///< the globals are its properties, the models its children
    std::vector<std::string> notices;
};

/// Reads a Stage world file, of Stage 2 to 4, with its includes and macros. Lengths and angles are
/// as in the file.
/// @throws InputError with file, line and column; depth, size and number of entities are bounded
WorldFile read_worldfile(const std::string& path, const WorldOptions& options);

}  // namespace rovernet
