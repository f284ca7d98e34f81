// SPDX-License-Identifier: MIT
// Routing, upwards: frames that have ended at their receivers.
#include "network/routing.hpp"
#include "network/world.hpp"

#include <algorithm>

namespace rovernet {

void Routing::frame_ended(const AirFrame& frame, const Arriving& part) {
    if (frame.frame.next_hop == everyone) {
        receive_broadcast(frame, part);
    } else {
        receive_unicast(frame, part);
    }
}

void Routing::receive_broadcast(const AirFrame& air, const Arriving& part) {
    if (part.error_free && world_.medium.stations().all_are_on()) {
        hand_up(air.frame, part.receptions, part.levels);
    } else {
        hand_up_heard(air.frame, part);
    }
    const auto record = [&] {
        return Received{
            air.frame, part.receptions, {}, mac_.header(), world_.for_sinks(part.levels)};
    };
    drops_.empty() ? world_.emit(record()) : emit_with_drops(record());
    user_.delivered(air.frame, part.receptions, part.levels);
}

/// Passes a frame to the router; without a router it is for everybody, and is not forwarded.
void Routing::hand_up(const Frame& frame, std::span<Reception> receptions,
                      std::span<const Dbm> levels) {
    if (arp_ && world_.messages[frame.message].is_link_packet()) {
        return arp_->receive(frame, receptions);
    }
    if (!router_) {
        for (Reception& r : receptions) {
            r.fate = Fate::arrived;
            r.delivered = true;
        }
        return;
    }
    handed_up_ = receptions.data();
    levels_ = levels;
    receiving_ = true;
    router_->on_receive(*this, frame, receptions);
    receiving_ = false;
    if (world_.messages[frame.message].kind.empty()) return;
    for (Reception& r : receptions) r.delivered = false;  // no application's message
}

/// Passes up receptions that were decoded at nodes that are on; marks the others as off.
void Routing::hand_up_heard(const Frame& frame, const Arriving& part) {
    const std::span<Reception> receptions = part.receptions;
    // Receptions are selected without a branch, which would often be mispredicted.
    heard_.resize(receptions.size());
    heard_levels_.resize(part.levels.size());
    places_.resize(receptions.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < receptions.size(); ++i) {
        const bool on = world_.medium.stations().is_on(receptions[i].node);
        heard_[count] = receptions[i];
        places_[count] = i;
        count += on & is_decoded(receptions[i].fate);
        if (!on) receptions[i].fate = Fate::off;
    }
    if (count == 0) return;
    if (!part.levels.empty()) {
        for (std::size_t k = 0; k < count; ++k) heard_levels_[k] = part.levels[places_[k]];
    }
    hand_up(frame, std::span{heard_}.first(count), heard_levels_);
    for (std::size_t k = 0; k < count; ++k) receptions[places_[k]] = heard_[k];
}

void Routing::receive_unicast(const AirFrame& air, const Arriving& part) {
    const bool overhears = router_ && router_->traits().overhears;
    for (std::size_t i = 0; i < part.receptions.size(); ++i) {
        Reception& r = part.receptions[i];
        const auto level = part.levels.empty() ? part.levels : part.levels.subspan(i, 1);
        if (r.node == air.frame.next_hop) {
            receive_unicast(air, r, level);
        } else if (overhears && is_decoded(r.fate) && world_.medium.stations().is_on(r.node)) {
            Reception overheard = r;
            hand_up(air.frame, {&overheard, 1}, level);
            if (!drops_.empty()) emit_drops({&r, 1}, [](std::size_t) {});
        }
    }
}

/// Passes a unicast frame to its destination.
void Routing::receive_unicast(const AirFrame& air, Reception& r, std::span<const Dbm> level) {
    if (!world_.medium.stations().is_on(r.node)) {
        r.fate = Fate::off;
    } else if (is_decoded(r.fate)) {
        if (mac_.is_repeated(r.node, air)) {
            r.fate = Fate::duplicate;
            r.delivered = false;
        } else {
            const Message& message = world_.messages[air.frame.message];
            world_.messages.pass_to(air.frame.message, r.node);
            if (message.is_routed || message.is_link_packet()) {
                hand_up(air.frame, {&r, 1}, level);
            } else {
                r.fate = Fate::arrived;
                r.delivered = true;
            }
        }
    }
    const Received record{air.frame, {&r, 1}, air.reserved, mac_.header(), world_.for_sinks(level)};
    drops_.empty() ? world_.emit(record) : emit_with_drops(record);
    user_.delivered(air.frame, {&r, 1}, level);
}

void Routing::emit_with_drops(const Received& record) {
    Received part = record;
    const std::span<const Reception> all = record.receptions;
    std::size_t emitted = 0;
    const auto emit_to = [&](std::size_t end) {
        if (end <= emitted) return;
        part.receptions = all.subspan(emitted, end - emitted);
        if (!record.levels.empty()) part.levels = record.levels.subspan(emitted, end - emitted);
        world_.emit(part);
        emitted = end;
    };
    emit_drops(all, [&](std::size_t place) { emit_to(std::min(place + 1, all.size())); });
    emit_to(all.size());
}

/// Emits the drops in on_receive, in the order of the receptions; those of other nodes last.
template <class Before>
void Routing::emit_drops(std::span<const Reception> receptions, Before before) {
    const auto place_of = [&](const Dropped& dropped) {
        const auto is_here = [&](const Reception& r) { return r.node == dropped.node; };
        return static_cast<std::size_t>(
            std::find_if(receptions.begin(), receptions.end(), is_here) - receptions.begin());
    };
    std::stable_sort(drops_.begin(), drops_.end(),
                     [&](const Dropped& a, const Dropped& b) { return place_of(a) < place_of(b); });
    for (Dropped& dropped : drops_) {
        const std::size_t place = place_of(dropped);
        before(place);
        if (place < receptions.size()) dropped.time = receptions[place].time;
        world_.emit(dropped);
        world_.release(dropped.frame);
    }
    drops_.clear();
}

}  // namespace rovernet
