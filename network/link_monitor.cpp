// SPDX-License-Identifier: MIT
#include "network/link_monitor.hpp"

#include "network/world.hpp"

#include <algorithm>
#include <utility>

namespace rovernet {

void LinkMonitor::begin() {
    if (!wanted_ || watch_) return;
    watch_.emplace(LinkWatch::Settings{.medium = &world_.medium,
                                       .legs = &world_.legs,
                                       .scene = world_.scene,
                                       .search = world_.settings.links});
    watch_->start(world_.now);
    expect_change();
}

void LinkMonitor::added(NodeId node) {
    if (watch_) watch_->added(node, world_.now);
}

void LinkMonitor::look_at(NodeId node) {
    if (!watch_) return;
    watch_->changed(node, world_.now);
    expect_change();
}

void LinkMonitor::scene_changed() {
    if (!watch_) return;
    watch_->scene_changed(*world_.scene, world_.now);
    expect_change();
}

/// Queues an event for the next link change, unless an earlier or equal one is queued.
void LinkMonitor::expect_change() {
    const Time next = std::max(watch_->next().value_or(never), world_.now);
    if (next >= expected_) return;
    expected_ = next;
    world_.events.schedule(next, Priority::timer, {Occurrence::Kind::link_change, NodeId{0}, 0});
}

void LinkMonitor::change_links() {
    if (expected_ != world_.now) return;  // an earlier one took its place
    expected_ = never;
    std::vector<std::pair<NodeId, NodeId>> lost;  // to, from
    watch_->advance(world_.now, [&](const LinkChange& change) {
        if (change.up) return world_.emit(LinkUp{change.time, change.from, change.to});
        world_.emit(LinkDown{change.time, change.from, change.to});
        if (on_lost_.contains(change.to)) lost.emplace_back(change.to, change.from);
    });
    const auto keys = [this](const std::pair<NodeId, NodeId>& link) {
        return std::pair(world_.key(link.first), world_.key(link.second));
    };
    std::sort(lost.begin(), lost.end(),
              [&](const auto& a, const auto& b) { return keys(a) < keys(b); });
    for (const auto& [to, from] : lost) tell_lost(to, from);
    expect_change();
}

void LinkMonitor::on_link_lost(NodeId node, Callback<NodeId> react) {
    want();
    on_lost_[node].push_back(std::move(react));
}

/// Queues the callbacks of a node that cannot hear `from` any more.
void LinkMonitor::tell_lost(NodeId node, NodeId from) {
    auto& reactions = on_lost_.at(node);
    std::erase_if(reactions, [](const auto& each) { return each.has_ended(); });
    for (const auto& react : reactions) {
        world_.schedule(world_.now + least_reaction, Callback<>([react, from] { react(from); }));
    }
}

}  // namespace rovernet
