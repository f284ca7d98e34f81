// SPDX-License-Identifier: MIT
#include "scene/stage/world_search.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

namespace rovernet {
namespace {

std::vector<std::string> folders_in(std::string_view path_list) {
    std::vector<std::string> folders;
    while (!path_list.empty()) {
        const std::size_t colon = std::min(path_list.find(':'), path_list.size());
        if (colon > 0) folders.emplace_back(path_list.substr(0, colon));
        path_list.remove_prefix(std::min(colon + 1, path_list.size()));
    }
    return folders;
}

}  // namespace

WorldSearch::WorldSearch(const std::string& world_path, const WorldOptions& options)
    : folders_{std::filesystem::path(world_path).parent_path().string()} {
    folders_.insert(folders_.end(), options.search_path.begin(), options.search_path.end());
    if (const char* stage_path = std::getenv("STAGEPATH")) {
        for (auto& folder : folders_in(stage_path)) folders_.push_back(std::move(folder));
    }
}

std::string WorldSearch::Result::places() const {
    std::string text;
    for (std::size_t i = 0; i < tried.size(); ++i) {
        if (i > 0) text += i + 1 < tried.size() ? ", " : " and ";
        text += tried[i];
    }
    return text;
}

WorldSearch::Result WorldSearch::find(const std::string& name) const {
    Result result;
    const auto look = [&result](const std::filesystem::path& path) {
        std::string place = path.string();
        if (std::find(result.tried.begin(), result.tried.end(), place) != result.tried.end()) {
            return false;
        }
        std::error_code ignored;
        const bool there = std::filesystem::is_regular_file(path, ignored);
        if (there) result.path = place;
        result.tried.push_back(std::move(place));
        return there;
    };
    const std::filesystem::path whole(name);
    const std::filesystem::path last = whole.filename();
    for (const auto& folder : folders_) {
        if (look(std::filesystem::path(folder) / whole)) return result;
    }
    for (const auto& folder : folders_) {
        if (last != whole && look(std::filesystem::path(folder) / last)) return result;
    }
    return result;
}

}  // namespace rovernet
