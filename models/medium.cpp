// SPDX-License-Identifier: MIT
#include "models/medium.hpp"

#include "models/friis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rovernet {
namespace {

/// What a receiver adds to a link budget: gain - cable loss - sensitivity.
Db receiver_share(const Radio& radio) {
    return Db{-radio.sensitivity.value} + radio.antenna_gain - radio.cable_loss;
}

Duration flight_time(double d) { return from_seconds(d / speed_of_light); }

/// The place of `value` in `list`, added if it is not there yet.
template <class T>
std::uint32_t number_of(std::vector<T>& list, const T& value) {
    const auto found = std::find(list.begin(), list.end(), value);
    const auto place = static_cast<std::uint32_t>(found - list.begin());
    if (found == list.end()) list.push_back(value);
    return place;
}

}  // namespace

Medium::Membership Medium::membership(const Radio& radio) {
    return {.essid = number_of(essids_, radio.essid),
            .channel = number_of(channels_, {radio.channel, radio.frequency}),
            .gated = radio.gate == Gate::network};
}

void Medium::add(const Radio& radio, std::uint64_t key, const Propagation& propagation) {
    check_fields(radio, "radio");
    propagation.check_frequency(radio.frequency);
    const std::uint32_t model = number_of(models_, propagation);
    stations_.push_back({key, radio.antenna_height.value, model});
    memberships_.push_back(membership(radio));
    radios_.push_back(radio);
    // All match as long as all have the same network, or none is gated.
    gated_ = gated_ || (memberships_.back().gated && (essids_.size() > 2 || channels_.size() > 1));

    if (receiver_share(radio) > best_receiver_) {
        best_receiver_ = receiver_share(radio);
        for (auto& station : stations_) station.reach2 = -1;
    }
}

std::string_view Medium::propagation(NodeId node) const { return model(node).name(); }

Vec3 Medium::antenna(NodeId node, Time t, const Legs& legs) const {
    Vec3 p = legs.position(node, t);
    p.z += stations_[node.index()].antenna_height;
    return p;
}

double Medium::squared_reach(NodeId from) {
    Station& sender = stations_[from.index()];
    if (sender.reach2 < 0) {
        constexpr double slack = 1 + 1e-9;  // rounding of the model's inverse
        const Radio& mine = radio(from);
        const Db budget =
            best_receiver_ + Db{mine.power.value} + mine.antenna_gain - mine.cable_loss;
        const double reach = model(from).reach(budget, mine.frequency).value * slack;
        sender.reach2 = reach * reach;
    }
    return sender.reach2;
}

LinkBatch Medium::batch(NodeId from, Vec3 origin) const {
    return {.frequency = radio(from).frequency,
            .from = origin,
            .to = positions_,
            .from_key = stations_[from.index()].key,
            .to_keys = keys_,
            .scene = settings_.scene,
            .floor_height = settings_.floor_height,
            .seed = settings_.seed,
            .replication = settings_.replication};
}

void Medium::gather(NodeId from, Time t, const Legs& legs) {
    const double reach2 = squared_reach(from);
    nodes_.clear();
    positions_.clear();
    keys_.clear();
    origin_ = antenna(from, t, legs);
    for (std::uint32_t i = 0; i < stations_.size(); ++i) {
        const NodeId node{i};
        if (node == from || !stations_[i].on) continue;
        const Vec3 p = antenna(node, t, legs);
        if (squared_distance(origin_, p) > reach2 || !may_link(from, node)) continue;
        nodes_.push_back(node);
        positions_.push_back(p);
        keys_.push_back(stations_[i].key);
    }
}

void Medium::keep_those_in_budget(NodeId from) {
    if (nodes_.empty()) return;
    Db give_up{-std::numeric_limits<double>::infinity()};
    for (const NodeId node : nodes_) {
        give_up = std::max(give_up, link_budget(radio(from), radio(node)));
    }
    loss_db_.resize(nodes_.size());
    model(from).loss(batch(from, origin_), give_up, loss_db_);

    std::size_t kept = 0;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        if (loss_db_[i] > link_budget(radio(from), radio(nodes_[i])).value) continue;
        nodes_[kept] = nodes_[i];
        positions_[kept] = positions_[i];
        ++kept;
    }
    nodes_.resize(kept);
    positions_.resize(kept);
}

void Medium::receivers(NodeId from, Time start, Time end, const Legs& legs,
                       std::vector<Reception>& out) {
    gather(from, start, legs);
    keep_those_in_budget(from);
    const auto first = static_cast<std::ptrdiff_t>(out.size());
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        const Duration delay = settings_.propagation_delay
                                   ? flight_time(distance(origin_, positions_[i]))
                                   : Duration{0};
        out.push_back({.node = nodes_[i], .time = end + delay});
    }
    std::sort(out.begin() + first, out.end(), [](const Reception& a, const Reception& b) {
        return a.time != b.time ? a.time < b.time : a.node < b.node;
    });
}

std::uint32_t Medium::reachable(NodeId from, Time t, const Legs& legs) {
    std::vector<bool> seen(stations_.size());
    std::vector<NodeId> frontier{from};
    seen[from.index()] = true;
    for (std::size_t next = 0; next < frontier.size(); ++next) {
        gather(frontier[next], t, legs);
        keep_those_in_budget(frontier[next]);
        for (const NodeId node : nodes_) {
            if (seen[node.index()]) continue;
            seen[node.index()] = true;
            frontier.push_back(node);
        }
    }
    return static_cast<std::uint32_t>(frontier.size() - 1);
}

bool Medium::link_up(NodeId from, NodeId to, Time t, const Legs& legs) const {
    return from != to && is_on(from) && is_on(to) && may_link(from, to) &&
           path_loss(from, to, t, legs) <= link_budget(radio(from), radio(to));
}

Db Medium::path_loss(NodeId from, NodeId to, Time t, const Legs& legs) const {
    const Vec3 position = antenna(to, t, legs);
    LinkBatch link = batch(from, antenna(from, t, legs));
    link.to = {&position, 1};
    link.to_keys = {&stations_[to.index()].key, 1};
    double loss = 0;
    model(from).loss(link, Db{std::numeric_limits<double>::infinity()}, {&loss, 1});
    return {loss};
}

}  // namespace rovernet
