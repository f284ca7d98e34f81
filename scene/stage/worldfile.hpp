// SPDX-License-Identifier: MIT
#pragma once

#include "sim/error.hpp"

#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace rovernet {

/// Number or text in a Stage world file.
using WorldAtom = std::variant<double, std::string>;

/// Property in a Stage world file: `name value` or `name [values]`.
struct WorldProperty {
    std::string name;
    std::vector<WorldAtom> values;
    bool is_tuple = false;
    Location where;  ///< place of the property's name in the file

    /// Value as a number or as a text. @throws InputError if the value is of another type
    double number() const;
    const std::string& text() const;
};

/// Entity in a Stage world file: `type ( properties and children )`. Macros are expanded: if the
/// entity uses a macro, `type` is the base type of the macro.
struct WorldEntity {
    std::string type = {};   ///< type: "position", "model", "wifi" ...; "" for the whole file
    std::string macro = {};  ///< name of the macro that the entity uses; empty: none
    std::vector<WorldProperty> properties = {};  ///< properties; of equal names the last is valid
    std::vector<WorldEntity> children = {};
    Location where = {};

    /// Last property with the name `name`; null if there is none.
    const WorldProperty* find(std::string_view name) const;
};

/// Options of reading Stage worlds.
struct WorldOptions {
    std::vector<std::string> search_path =
        {};  ///< folders for includes and bitmaps, before STAGEPATH
    /// Replacements of bitmaps, pairs (OLD, NEW): NEW is read wherever the world names OLD. The
    /// path NEW is relative to the world file or to OLD.
    std::vector<std::pair<std::string, std::string>> bitmaps = {};
    bool lenient = false;  ///< a missing include or bitmap causes a notice, not an error
};

/// Parsed Stage world: its entities, and notices to the user.
struct WorldFile {
    std::string path;
    WorldEntity root;                  ///< whole file: global properties, and models as children
    std::vector<std::string> notices;  ///< notices to the user, each "file:line: text"
};

/// Reads a Stage world file (Stage 2 to 4) with its includes and macros. Lengths and angles are in
/// the units of the file.
///
/// The use of a macro becomes the macro's entity with the properties and children of the use
/// appended. Of two macros with one name the first counts. A model type unknown to Stage causes a
/// notice. Limits: 16 MiB per file and 64 MiB in total, includes 16 deep, entities and macros 64
/// deep, 1e6 words and values after macro expansion.
/// @throws InputError with file, line and column
WorldFile read_worldfile(const std::string& path, const WorldOptions& options);

/// Notice about a Stage world: "file:line: text", or "file: text" if `where` has no line.
std::string world_notice(const Location& where, std::string_view text);

}  // namespace rovernet
