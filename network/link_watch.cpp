// SPDX-License-Identifier: MIT
#include "network/link_watch.hpp"

#include "models/medium/medium.hpp"
#include "scene/scene_change.hpp"
#include "sim/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace rovernet {

bool LinkWatch::later(const Entry& p, const Entry& q) {
    return std::tie(p.time, p.from, p.to) > std::tie(q.time, q.from, q.to);
}

void LinkWatch::grow(std::size_t robots) {
    if (robots > most_robots) {
        throw RunError(fmt::format(
            "{} robots have {} links, too many to find all changes of these links; expected "
            "at most {} robots",
            robots, robots * (robots - 1), most_robots));
    }
    robots_ = robots;
    next_.resize(robots * robots, never);
    state_.resize(robots * robots, 0);
}

void LinkWatch::start(Time now) {
    begin_ = now;
    grow(settings_.legs->size());
    look_at_all(now);
}

void LinkWatch::scene_changed(const Scene& scene, Time now) {
    settings_.scene = &scene;
    walls_.reset();
    look_at_all(now);
}

void LinkWatch::look_at_all(Time now) {
    for (std::uint32_t i = 0; i < robots_; ++i)
        for (std::uint32_t j = 0; j < robots_; ++j) look_at(NodeId{i}, NodeId{j}, now);
    drop_stale();
}

void LinkWatch::added(NodeId node, Time now) {
    grow(std::max(robots_, node.index() + 1));
    look_at(node, now);
}

void LinkWatch::look_at(NodeId node, Time now) {
    for (std::uint32_t i = 0; i < robots_; ++i) {
        look_at(node, NodeId{i}, now);
        look_at(NodeId{i}, node, now);
    }
    drop_stale();
}

/// Searches a pair again, and discards its pending time. If its state differs from the reported
/// one, a change is due now.
void LinkWatch::look_at(NodeId from, NodeId to, Time now) {
    if (from == to) return;
    if (settings_.medium->links().is_up(from, to, now, *settings_.legs) != is_up(from, to))
        expect(from, to, now, true);
    else
        search(from, to, now);
}

void LinkWatch::search(NodeId from, NodeId to, Time after) {
    // A run may end long before its legs do, so the search goes only as far ahead as the run has
    // lasted, but at least 16 samples.
    constexpr std::int64_t fewest_looks = 16, most_looks = 65536;
    const std::int64_t so_far = (after - begin_) / settings_.search.min_dwell;
    const Legs& legs = *settings_.legs;
    // Changes after a scene change are searched for when the scene has changed.
    const Time next_scene = next_change(settings_.medium->settings().scene_changes, after);
    const Time scene_ends = next_scene == never ? never : next_scene - Duration{1};
    const Time ends = std::min({legs.leg(from).end, legs.leg(to).end, scene_ends});
    const LinkOutlook outlook =
        look_ahead(*settings_.medium, legs, walls_for(from), from, to, after, ends,
                   settings_.search, std::clamp(so_far, fewest_looks, most_looks));
    if (outlook.change)
        expect(from, to, *outlook.change, true);
    else
        expect(from, to, outlook.until + Duration{1} < ends ? outlook.until : never, false);
}

/// Sets the pending time of a pair; `never` means that nothing is pending.
void LinkWatch::expect(NodeId from, NodeId to, Time time, bool change) {
    const std::size_t i = pair(from, to);
    state_[i] = static_cast<std::uint8_t>((state_[i] & up) | (change ? 0 : look_again));
    if (next_[i] == time) return;
    if (next_[i] != never) --pending_;
    next_[i] = time;
    if (time == never) return;
    ++pending_;
    heap_.push_back({time, from, to});
    std::push_heap(heap_.begin(), heap_.end(), later);
}

/// Removes stale entries from the top of the heap, and all stale entries if most are stale.
void LinkWatch::drop_stale() {
    constexpr std::size_t few = 1024;
    while (!heap_.empty() && stale(heap_.front())) {
        std::pop_heap(heap_.begin(), heap_.end(), later);
        heap_.pop_back();
    }
    if (heap_.size() < 2 * pending_ + few) return;
    const auto key = [](const Entry& e) { return std::tie(e.time, e.from, e.to); };
    std::erase_if(heap_, [&](const Entry& e) { return stale(e); });
    std::sort(heap_.begin(), heap_.end(),
              [&](const Entry& p, const Entry& q) { return key(p) < key(q); });
    heap_.erase(std::unique(heap_.begin(), heap_.end(),
                            [&](const Entry& p, const Entry& q) { return key(p) == key(q); }),
                heap_.end());  // sorted is a heap
}

std::optional<Time> LinkWatch::next() const {
    if (heap_.empty()) return std::nullopt;
    return heap_.front().time;
}

void LinkWatch::advance(Time now, const Tell& tell) {
    while (!heap_.empty() && heap_.front().time <= now) {
        std::pop_heap(heap_.begin(), heap_.end(), later);
        const Entry due = heap_.back();
        heap_.pop_back();
        if (stale(due)) continue;
        const std::size_t i = pair(due.from, due.to);
        const bool change = (state_[i] & look_again) == 0;
        if (change) {
            state_[i] ^= up;
            tell({due.time, due.from, due.to, is_up(due.from, due.to)});
        }
        search(due.from, due.to, due.time);
    }
    drop_stale();
}

const WallPassages& LinkWatch::walls_for(NodeId from) {
    if (settings_.medium->stations().model(from).shape() != LossShape::by_walls) return no_walls_;
    if (!walls_) walls_.emplace(*settings_.scene);
    return *walls_;
}

}  // namespace rovernet
