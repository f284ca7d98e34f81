// SPDX-License-Identifier: MIT
#include "network/engine.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace rovernet {

/// Looks at all links once; from then on the watch is told of every leg and switch.
void Engine::start_watch() {
    watch_.emplace(LinkWatch::Settings{
        .medium = &medium_, .legs = &legs_, .scene = scene_, .search = settings_.links});
    watch_->start(now_);
    expect_link_change();
}

/// Queues an event for the next link change, unless there is one that comes no later.
void Engine::expect_link_change() {
    const Time next = std::max(watch_->next().value_or(never), now_);
    if (next >= link_event_) return;
    link_event_ = next;
    queue_.schedule(next, Priority::timer, {Occurrence::Kind::link_change, NodeId{0}, 0});
}

void Engine::change_links() {
    if (link_event_ != now_) return;  // an earlier one took its place
    link_event_ = never;
    std::vector<std::pair<NodeId, NodeId>> lost;  // to, from
    watch_->advance(now_, [&](const LinkChange& change) {
        if (change.up) return emit(LinkUp{change.time, change.from, change.to});
        emit(LinkDown{change.time, change.from, change.to});
        if (on_link_lost_.contains(change.to)) lost.emplace_back(change.to, change.from);
    });
    std::sort(lost.begin(), lost.end(), [this](const auto& a, const auto& b) {
        return std::pair(key(a.first), key(a.second)) < std::pair(key(b.first), key(b.second));
    });
    for (const auto& [to, from] : lost) tell_lost(to, from);
    expect_link_change();
}

/// Calls back who waits for `node` to hear `from` no more.
void Engine::tell_lost(NodeId node, NodeId from) {
    for (const auto& react : on_link_lost_.at(node)) {
        auto call = std::make_shared<std::function<void()>>([react, from] { (*react)(from); });
        schedule(now_ + least_reaction, {std::move(call)});
    }
}

}  // namespace rovernet
