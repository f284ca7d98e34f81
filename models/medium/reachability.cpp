// SPDX-License-Identifier: MIT
#include "models/medium/reachability.hpp"

#include "models/medium/medium.hpp"

#include <algorithm>

namespace rovernet {
namespace {

/// Whether the node rests until its leg is replaced, with a constant antenna direction if that
/// matters.
bool rests(const Leg& leg, bool by_heading) {
    return leg.velocity == Vec3{} && leg.from == leg.to && !(by_heading && leg.turning != 0);
}

}  // namespace

bool Reachability::is_at_rest(const Now& now) {
    const std::pair state{now.medium.changes(), &now.medium.settings().scene_at(now.t)};
    if (std::exchange(answers_of_, state) == state) return at_rest_;
    answers_.clear();
    const bool by_heading = now.medium.stations().is_directional();
    const auto moves = [&](NodeId node) { return !rests(now.legs.leg(node), by_heading); };
    at_rest_ = mover_.index() >= now.legs.size() || !moves(mover_);
    for (NodeId n{0}; at_rest_ && n.index() < now.legs.size(); ++n.value) {
        if (!moves(n)) continue;
        at_rest_ = false;
        mover_ = n;
    }
    if (at_rest_) answers_.resize(now.legs.size(), unknown);
    return at_rest_;
}

std::uint32_t Reachability::count(Medium& medium, NodeId from, Time t, const Legs& legs) {
    const Now now{medium, legs, t, from};
    const bool keeps = is_at_rest(now);
    if (keeps && answers_[from.index()] != unknown) return answers_[from.index()];
    search(now);
    const auto others = static_cast<std::uint32_t>(reached_.size() - 1);
    if (!keeps) return others;
    if (medium.stations().all_are_alike() && medium.stations().is_on(from)) {  // links go both ways
        for (const NodeId node : reached_) answers_[node.index()] = others;
    }
    return answers_[from.index()] = others;
}

bool Reachability::reaches(Medium& medium, NodeId from, NodeId to, Time t, const Legs& legs) {
    if (medium.hears(from, to, t, legs)) return true;
    search({medium, legs, t, from});
    return state(to) == State::reached;
}

/// Fills reached_.
void Reachability::search(const Now& now) {
    const std::size_t nodes = now.legs.size();
    for (auto n = static_cast<std::uint32_t>(parents_.size()); n < nodes; ++n) {
        parents_.push_back(NodeId{n});
    }
    marks_.resize(nodes, 0);
    if (++round_ == (1U << 30)) {
        std::fill(marks_.begin(), marks_.end(), 0);
        round_ = 1;
    }
    reached_.clear();
    expanded_ = 0;
    reach(now.from);
    expand(now, now.from);
    ++expanded_;
    const std::size_t all =
        now.medium.stations().on() + (now.medium.stations().is_on(now.from) ? 0 : 1);
    if (reached_.size() == all) return;
    follow_parents(now);
    if (reached_.size() == all) return;
    list_open(now);
    while (expanded_ < reached_.size() && reached_.size() < all) {
        if (now.medium.stations().all_are_alike() && open_.size() < reached_.size() - expanded_) {
            return look_back(now);
        }
        expand(now, reached_[expanded_++]);
        if (2 * (all - reached_.size()) < open_.size()) list_open(now);
    }
}

/// Marks nodes reached by their stored links, if these are still up.
void Reachability::follow_parents(const Now& now) {
    for (NodeId n{0}; n.index() < parents_.size(); ++n.value) {
        path_.clear();
        NodeId at = n;
        while (state(at) == State::open) {
            set(at, State::tried);
            path_.push_back(at);
            at = parents_[at.index()];
        }
        for (; state(at) == State::reached && !path_.empty(); path_.pop_back()) {
            if (!now.medium.hears(at, path_.back(), now.t, now.legs)) break;
            at = path_.back();
            reach(at);
        }
    }
}

/// Lists the nodes that are on and not reached in open_.
void Reachability::list_open(const Now& now) {
    open_.clear();
    for (NodeId n{0}; n.index() < parents_.size(); ++n.value) {
        if (state(n) != State::reached && now.medium.stations().is_on(n)) open_.push_back(n);
    }
}

/// Marks the nodes that hear a reached node.
void Reachability::expand(const Now& now, NodeId node) {
    ++searches_;
    const auto take = [&](NodeId to) {
        if (state(to) == State::reached) return;
        // A robot reached by the sender keeps its other parent, because that link may last longer.
        if (node != now.from || parents_[to.index()] == to) parents_[to.index()] = node;
        reach(to);
    };
    constexpr std::size_t few = 16;
    if (node == now.from || open_.size() > few) {
        for (const Medium::Found& found : now.medium.hearers(node, now.t, now.legs)) {
            take(found.node);
        }
        return;
    }
    for (const NodeId to : open_) {
        if (state(to) != State::reached && now.medium.hears(node, to, now.t, now.legs)) take(to);
    }
}

/// Searches from nodes that are not reached, if all links are bidirectional: a component that hears
/// no reached node is not reachable.
void Reachability::look_back(const Now& now) {
    for (const NodeId first : open_) {
        if (state(first) == State::reached || state(first) == State::cut) continue;
        path_.assign(1, first);
        set(first, State::cut);
        bool joined = false;
        for (std::size_t next = 0; next < path_.size() && !joined; ++next) {
            const NodeId node = path_[next];
            ++searches_;
            for (const Medium::Found& found : now.medium.hearers(node, now.t, now.legs)) {
                if (state(found.node) == State::cut) continue;
                if (state(found.node) == State::reached) {
                    join(found.node, node, first);
                    joined = true;
                    break;
                }
                parents_[found.node.index()] = node;
                set(found.node, State::cut);
                path_.push_back(found.node);
            }
        }
        if (!joined) continue;
        for (const NodeId node : path_) reach(node);
    }
}

/// Makes `reached` the parent of `node`, and reverses the stored links from `first` to `node`.
void Reachability::join(NodeId reached, NodeId node, NodeId first) {
    NodeId parent = reached;
    for (;;) {
        const NodeId next = std::exchange(parents_[node.index()], parent);
        if (node == first) return;
        parent = std::exchange(node, next);
    }
}

std::optional<std::uint32_t> Reachability::shortest(Medium& medium, NodeId from, NodeId to, Time t,
                                                    const Legs& legs) {
    std::vector<std::uint32_t> hops(legs.size(), unknown);
    std::vector<NodeId> frontier{from};
    hops[from.index()] = 0;
    for (std::size_t next = 0; next < frontier.size() && hops[to.index()] == unknown; ++next) {
        const std::uint32_t behind = hops[frontier[next].index()] + 1;
        for (const Medium::Found& found : medium.hearers(frontier[next], t, legs)) {
            if (hops[found.node.index()] != unknown) continue;
            hops[found.node.index()] = behind;
            frontier.push_back(found.node);
        }
    }
    const std::uint32_t found = hops[to.index()];
    return found == unknown ? std::nullopt : std::optional(found);
}

std::uint32_t Reachability::count_anew(Medium& medium, NodeId from, Time t, const Legs& legs) {
    std::vector<bool> seen(legs.size());
    std::vector<NodeId> frontier{from};
    seen[from.index()] = true;
    for (std::size_t next = 0; next < frontier.size(); ++next) {
        for (const auto [node, squared_distance] : medium.hearers(frontier[next], t, legs)) {
            if (seen[node.index()]) continue;
            seen[node.index()] = true;
            frontier.push_back(node);
        }
    }
    return static_cast<std::uint32_t>(frontier.size() - 1);
}

}  // namespace rovernet
