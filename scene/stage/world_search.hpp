// SPDX-License-Identifier: MIT
#pragma once

#include "scene/stage/worldfile.hpp"

#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// Search for the includes and bitmaps of a Stage world: first in the folder of the world file,
/// then in WorldOptions::search_path, then in the folders of the environment variable STAGEPATH.
class WorldSearch {
  public:
    /// @param world_path  path of the world file, as the user typed it
    WorldSearch(const std::string& world_path, const WorldOptions& options);

    /// Result of a search for a file.
    struct Result {
        std::optional<std::string> path = {};  ///< path of the first regular file found
        std::vector<std::string> tried = {};   ///< all paths tried, in order

        /// Paths tried, for an error: "a, b and c".
        std::string places() const;
    };

    /// Searches each folder for the path `name`, and then each folder for the last part of `name`,
    /// the file name without folders. An absolute path is tried first as given.
    Result find(const std::string& name) const;

  private:
    std::vector<std::string> folders_;
};

}  // namespace rovernet
