// SPDX-License-Identifier: MIT
#include "routing/dsr/dsr_cache.hpp"

#include <algorithm>

namespace rovernet::dsr {
namespace {

constexpr std::size_t most_own = 30, most_others = 64;

/// Whether a route is a beginning of a stored one, which is most often a new one.
bool knows(const std::vector<Cache::Known>& all, const Path& path) {
    return std::any_of(all.rbegin(), all.rend(),
                       [&](const Cache::Known& each) { return each.path.starts_with(path); });
}

}  // namespace

void Cache::add(const Path& path, Origin origin, Time now) {
    if (path.size() < 2 || knows(own_, path)) return;
    const bool is_own = origin == Origin::own;
    if (!is_own && knows(others_, path)) return;
    std::vector<Known>& all = is_own ? own_ : others_;
    std::erase_if(all, [&](const Known& each) { return path.starts_with(each.path); });
    if (all.size() >= (is_own ? most_own : most_others)) all.erase(all.begin());
    all.push_back({path, now});
}

void Cache::remove_link(NodeId from, NodeId to) {
    for (std::vector<Known>* all : {&own_, &others_}) {
        for (Known& each : *all) {
            const std::size_t i = each.path.place(from);
            if (i + 1 < each.path.size() && each.path[i + 1] == to) each.path.truncate(i + 1);
        }
        std::erase_if(*all, [](const Known& each) { return each.path.size() < 2; });
    }
}

std::optional<Path> Cache::find(NodeId destination) const {
    const Path* best = nullptr;
    std::size_t size = Path::longest + 1;
    for (const std::vector<Known>* all : {&own_, &others_}) {
        for (const Known& each : *all) {
            const std::size_t i = each.path.place(destination);
            if (i == each.path.size() || i + 1 >= size) continue;
            best = &each.path;
            size = i + 1;
        }
    }
    if (!best) return std::nullopt;
    return best->first(size);
}

}  // namespace rovernet::dsr
