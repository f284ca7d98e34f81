// SPDX-License-Identifier: MIT
#pragma once

#include "scene/stage/worldfile.hpp"

#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// Search for the includes and bitmaps of a world: in the folder of the world, then
/// WorldOptions::search_path, then the folders of the environment variable STAGEPATH.
class WorldSearch {
  public:
    /// @param world_path  the top file, as the user named it
    WorldSearch(const std::string& world_path, const WorldOptions& options);

    /// Result of a search.
    struct Result {
        std::optional<std::string> path = {};  ///< path of the first regular file there is
        std::vector<std::string> tried = {};   ///< every place looked at, in order

        /// The places tried, for an error: "a, b and c".
        std::string places() const;
    };

    /// Looks for `name` in each folder, then for its last part alone in each. An absolute name is
    /// first looked for as it stands.
    Result find(const std::string& name) const;

  private:
    std::vector<std::string> folders_;
};

}  // namespace rovernet
