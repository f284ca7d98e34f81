// SPDX-License-Identifier: MIT
#include "network/mac.hpp"

#include "network/world.hpp"

#include <algorithm>

namespace rovernet {

Mac::Mac(World& world, Channel& channel, MacUser& user)
    : world_(world),
      channel_(channel),
      user_(user),
      access_(world.settings.access.make_access()),
      listens_(access_->listens()),
      has_own_rates_(!access_->own_rates().empty()),
      has_priority_(access_->has_priority()),
      header_(access_->header()) {}

Time Mac::now() const { return world_.now; }

Time Mac::transmit(const AirFrame& air) {
    const bool data = !air.control;
    if (data) world_.emit(Transmitted{world_.now, air.frame, air.heard_from});
    const Transmission how = transmission(air);  // a copy: others are made meanwhile
    if (world_.records.wants<AirSent>()) {
        world_.emit(
            AirSent{.time = world_.now,
                    .air = air,
                    .bytes = how.bytes,
                    .header = data ? header_ : 0,
                    .airtime = how.airtime(),
                    .rate = how.rate,
                    .queue = static_cast<std::uint32_t>(access_->queued(air.frame.sender))});
    }
    const auto receptions = channel_.transmit(air, how, audience_of(air.frame));
    const Time end = world_.now + how.airtime();
    if (world_.now >= start_of_run + world_.settings.warmup) airtime_so_far_ += how.airtime();
    const auto is_next_hop = [&](const Reception& r) { return r.node == air.frame.next_hop; };
    if (data && !listens_ && air.frame.next_hop != everyone &&
        std::none_of(receptions.begin(), receptions.end(), is_next_hop)) {
        miss(air, end);
    }
    return end;
}

Audience Mac::audience_of(const Frame& frame) const {
    if (listens_) return Audience::sensors;
    if (frame.next_hop == everyone) return Audience::receivers;
    const bool is_overheard = world_.router && world_.router->traits().overhears;
    return is_overheard ? Audience::receivers : Audience::next_hop;
}

void Mac::miss(const AirFrame& air, Time end) {
    const Frame& frame = air.frame;
    if (!judges(frame)) {
        world_.emit(Dropped{world_.now, frame.sender, frame, DropReason::unheard});
        return;
    }
    await_end({frame, air.heard_from}, end);
}

void Mac::report_end(const QueuedFrame& frame) {
    constexpr Duration longest_delay{10'000'000};  // light travels 3,000 km
    await_end(frame, world_.now + airtime({.frame = frame.frame}) + longest_delay);
}

void Mac::await_end(const QueuedFrame& frame, Time end) {
    const std::size_t slot = unheard_.take();
    unheard_[slot] = frame;
    world_.events.schedule(end, Priority::frame_end,
                           {Occurrence::Kind::unheard, frame.frame.sender, slot});
}

void Mac::on_unheard(std::size_t slot) {
    const QueuedFrame frame = unheard_[slot];
    unheard_.release(slot);
    if (!listens_) return user_.lost(frame, DropReason::unheard);
    const NodeId at = world_.messages.at(frame.frame.message);
    if (at == frame.frame.next_hop || at == world_.messages[frame.frame.message].to) {
        user_.sent(frame, false);
    } else {
        user_.lost(frame, DropReason::end);
    }
}

void Mac::judge(const AirFrame& air, std::span<const Reception> receptions) {
    const QueuedFrame frame{air.frame, air.heard_from};
    for (const Reception& r : receptions) {
        if (r.node != air.frame.next_hop) continue;
        if (is_decoded(r.fate)) {
            user_.sent(frame, true);
        } else {
            user_.lost(frame, DropReason::retries);
        }
    }
}

bool Mac::is_on(const QueuedFrame& frame) const {
    return world_.medium.stations().is_on(frame.frame.sender);
}

std::uint32_t Mac::bytes(const AirFrame& frame) const {
    if (frame.control) return frame.control->bytes;
    return frame.frame.size_of(world_.messages[frame.frame.message]) + header();
}

BitRate Mac::rate_of(const AirFrame& frame) const {
    const BitRate sender = world_.medium.stations().radio(frame.frame.sender).rate;
    if (!has_own_rates_) return sender;
    const NodeId to = frame.frame.next_hop;
    return access_->rate(frame, sender,
                         to == everyone ? sender : world_.medium.stations().radio(to).rate);
}

/// The last transmission is kept, as most frames of a run are sent alike.
const Transmission& Mac::transmission(const AirFrame& frame) const {
    const Stations& stations = world_.medium.stations();
    const RadioKinds::Kind kind = stations.kind(frame.frame.sender);
    const BitRate rate = rate_of(frame);
    const std::uint32_t size = bytes(frame);
    if (kind != last_kind_ || rate != last_.rate || size != last_.bytes) {
        last_ = world_.phy.transmission(stations.radio(frame.frame.sender), rate, size);
        last_kind_ = kind;
    }
    return last_;
}

void Mac::access_timer(NodeId node, Time at, std::uint32_t tag) {
    world_.events.schedule(at, Priority::timer, {Occurrence::Kind::access_timer, node, tag});
}

double Mac::access_draw(NodeId node, std::uint64_t index) const {
    return world_.draw(Purpose::backoff, world_.key(node), 0, index);
}

void Mac::frame_ended(const AirFrame& frame, const Arriving& part) {
    if (!frame.control) {
        user_.frame_ended(frame, part);
        if (judges(frame.frame)) judge(frame, part.receptions);
    }
    if (listens_) tell_stations(frame, part.receptions);
}

/// Reports to the access model at which stations the frame was received or missed.
void Mac::tell_stations(const AirFrame& frame, std::span<const Reception> receptions) {
    const AirFrame air = frame;
    const Medium& medium = world_.medium;
    if (air.control && world_.records.wants<ControlReceived>()) {
        for (const Reception& r : receptions) {
            if (r.node != air.frame.next_hop || !medium.stations().is_on(r.node)) continue;
            world_.emit(ControlReceived{air, r, bytes(air)});
        }
    }
    for (const Reception& r : receptions) {
        world_.now = r.time;
        if (!medium.stations().is_on(r.node)) continue;
        if (is_decoded(r.fate)) {
            access_->received(*this, r.node, air);
        } else {
            access_->missed(*this, r.node, r.locked);
        }
    }
}

}  // namespace rovernet
