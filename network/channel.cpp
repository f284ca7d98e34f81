// SPDX-License-Identifier: MIT
#include "network/channel.hpp"

#include "network/world.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

namespace rovernet {
namespace {

constexpr std::size_t most_counted = 64;

/// Sorts up to 64 receptions, which only have time and node, by counting the earlier ones for each:
/// more comparisons than other sorting algorithms, but without branches to mispredict.
/// @tparam Order  signed integer that holds the time since `first` [ns] and, below it, the node
/// @param first      a time not after any of theirs
/// @param node_bits  number of bits of the largest node
template <class Order>
void sort_by_counting(std::span<Reception> all, Time first, int node_bits) {
    // Padding: the number of keys is a multiple of those that one instruction compares, 4 or 2.
    constexpr std::size_t at_once = 16 / sizeof(Order);
    std::array<Order, most_counted + at_once> order;
    std::fill_n(order.begin() + static_cast<std::ptrdiff_t>(all.size()), at_once,
                std::numeric_limits<Order>::max());
    for (std::size_t i = 0; i < all.size(); ++i) {
        const auto after = static_cast<Order>((all[i].time - first).count());
        order[i] = static_cast<Order>(after << node_bits | static_cast<Order>(all[i].node.value));
    }
    const Order nodes = (Order{1} << node_bits) - 1;
    const auto reception = [&](std::size_t i) {
        return Reception{first + Duration{order[i] >> node_bits},
                         NodeId{static_cast<std::uint32_t>(order[i] & nodes)}};
    };
    // Two receptions are counted at a time, which halves the loads.
    const std::size_t compared = (all.size() + at_once - 1) / at_once * at_once;
    for (std::size_t i = 0; i < all.size(); i += 2) {
        std::make_unsigned_t<Order> before = 0, before_next = 0;
        for (std::size_t k = 0; k < compared; ++k) {
            before += order[k] < order[i];
            before_next += order[k] < order[i + 1];
        }
        all[before] = reception(i);
        if (before_next < all.size()) all[before_next] = reception(i + 1);
    }
}

/// Sorts the receptions of a frame.
/// @param nodes  number of nodes of the network
void sort(Medium::Receivers& receivers, std::size_t nodes) {
    const std::span<Reception> all = receivers.all();
    if (all.empty()) return;
    const auto longest = static_cast<std::uint64_t>((receivers.last - receivers.first).count());
    const auto node_bits = static_cast<int>(std::bit_width(nodes));
    const int bits = static_cast<int>(std::bit_width(longest)) + node_bits;
    if (all.size() > most_counted || bits > 63) {
        std::sort(all.begin(), all.end());
    } else if (bits > 31) {
        sort_by_counting<std::int64_t>(all, receivers.first, node_bits);
    } else {  // twice as many comparisons by one instruction
        sort_by_counting<std::int32_t>(all, receivers.first, node_bits);
    }
}

}  // namespace

Channel::Channel(World& world, ChannelUser& user) : world_(world), user_(user) {
    auto judge = world.settings.reception.make_judge();
    if (!judge) return;
    interference_.emplace(Interference::Settings{.medium = &world.medium,
                                                 .legs = &world.legs,
                                                 .phy = &world.phy,
                                                 .all_frames = world.settings.reference,
                                                 .seed = world.settings.seed,
                                                 .replication = world.settings.replication},
                          std::move(judge));
}

std::span<const Reception> Channel::transmit(const AirFrame& air, const Transmission& how,
                                             Audience audience) {
    const Frame& frame = air.frame;
    ++world_.transmissions;
    const std::size_t slot = flights_.take();
    Flight& flight = flights_[slot];
    flight.air = air;
    flight.served = 0;
    find_receivers(flight, how, audience);
    flight.levels.clear();
    if (world_.wants_levels()) find_levels(flight, world_.now + how.airtime());
    if (interference_) put_on_air(slot, how);
    const bool errors = world_.medium.stations().radio(frame.sender).success_rate < 1;
    if (errors) garble(flight);
    flight.error_free = !errors && !interference_;
    const std::span<const Reception> all = flight.receivers.all();
    if (all.empty()) {
        if (!interference_) flights_.release(slot);
        return all;
    }
    if (!air.control) world_.hold(frame);
    world_.events.schedule(flight.receivers.first, Priority::frame_end,
                           {Occurrence::Kind::frame, frame.sender, slot});
    return all;
}

/// Finds the receivers that matter: all of them where frames interfere, as others may depend on
/// them.
void Channel::find_receivers(Flight& flight, const Transmission& how, Audience audience) {
    if (audience == Audience::sensors) return find_sensors(flight, how);
    const Frame& frame = flight.air.frame;
    const Time now = world_.now, end = now + how.airtime();
    if (audience == Audience::next_hop && !interference_ && !world_.settings.reference) {
        return world_.medium.find_receiver(frame.sender, frame.next_hop, how.coding, now, end,
                                           world_.legs, flight.receivers);
    }
    world_.medium.find_receivers(frame.sender, how.coding, now, end, world_.legs, flight.receivers);
    sort(flight.receivers, world_.size());
}

/// Finds the receivers, and reports all nodes that sense the frame to the user.
void Channel::find_sensors(Flight& flight, const Transmission& how) {
    Medium& medium = world_.medium;
    const Duration airtime = how.airtime();
    const Time now = world_.now, end = now + airtime;
    const NodeId sender = flight.air.frame.sender;
    const auto sensors =
        medium.find_sensors(sender, how.coding, now, end, world_.legs, flight.receivers);
    sort(flight.receivers, world_.size());
    const std::span<const Reception> receptions = flight.receivers.all();
    sensed_.resize(receptions.size() + sensors.size());
    Sensing* next = sensed_.data();
    for (const Reception& r : receptions) {
        *next++ = {r.node, true, how.coding, r.time - airtime, r.time};
    }
    for (const Medium::Found& s : sensors) {
        const Duration delay = medium.arrivals().delay(std::sqrt(s.squared_distance));
        *next++ = {s.node, false, how.coding, now + delay, end + delay};
    }
    user_.sensed(sensed_);
}

/// Frame that starts now, as it leaves its sender.
Emission Channel::emission_of(const Flight& flight, Time end) const {
    return {.begin = world_.now,
            .end = end,
            .origin = flight.receivers.origin,
            .from = flight.air.frame.sender,
            .heard_within = flight.receivers.heard_within};
}

/// Computes the received power of each reception at a node that asks for it; NaN at the others.
void Channel::find_levels(Flight& flight, Time end) {
    Medium& medium = world_.medium;
    const std::span<const Reception> all = flight.receivers.all();
    const auto is_wanted = [&](const Reception& r) { return world_.wants_level_at(r.node); };
    if (std::none_of(all.begin(), all.end(), is_wanted)) return;
    const NodeId sender = flight.air.frame.sender;
    Emission frame = emission_of(flight, end);
    frame.squared_reach = std::numeric_limits<double>::infinity();
    const auto level_at = [&](NodeId node) {
        const Vec3 there = medium.position(node, world_.now, world_.legs);
        const Headings headings{{world_.legs.leg(sender).heading_at(world_.now)},
                                {world_.legs.leg(node).heading_at(world_.now)}};
        const auto arrives = medium.stations().is_directional()
                                 ? medium.arrivals().of(frame, node, there, headings)
                                 : medium.arrivals().of(frame, node, there);
        const bool open = std::isnan(arrives->level_dbm);
        return open ? medium.arrivals().level(*arrives, node) : Dbm{arrives->level_dbm};
    };
    constexpr Dbm unknown{std::numeric_limits<double>::quiet_NaN()};
    for (const Reception& r : all) {
        flight.levels.push_back(is_wanted(r) ? level_at(r.node) : unknown);
    }
}

/// Adds a frame to the interference, which keeps it while it may overlap with other frames.
void Channel::put_on_air(std::size_t slot, const Transmission& how) {
    Flight& flight = flights_[slot];
    forget_frames();
    Emission frame = emission_of(flight, world_.now + how.airtime());
    frame.flight = static_cast<std::uint32_t>(slot);
    frame.coding = how.coding;
    flight.emission = interference_->add(frame, how, flight.receivers.all());
}

/// Removes frames that cannot affect receptions any more, and frees their flights.
void Channel::forget_frames() {
    interference_->forget(world_.now,
                          [&](const Emission& frame) { flights_.release(frame.flight); });
}

void Channel::added(NodeId node, const Leg& leg) {
    before_change(node, false);
    goes(node, leg);
}

void Channel::before_change(NodeId node, bool on) {
    if (!interference_) return;
    forget_frames();
    interference_->before_change(node, on);
}

void Channel::goes(NodeId node, const Leg& leg) {
    if (interference_) interference_->goes(node, leg);
}

void Channel::check(BitRate rate) const {
    if (interference_) interference_->rule().check(world_.phy, rate);
}

std::optional<Db> Channel::interference_left_out() const {
    if (!interference_ || !interference_->rule().interference_cut()) return std::nullopt;
    // One of the frames on air is the received one itself.
    const std::size_t most = interference_->rule().most_on_air();
    return world_.medium.stations().kinds().left_out(std::max<std::size_t>(most, 1) - 1);
}

/// Marks receptions as garbled by the sender's success rate.
void Channel::garble(Flight& flight) {
    if (flight.air.control) return;
    const Frame& frame = flight.air.frame;
    const Message& message = world_.messages[frame.message];
    std::uint64_t number = frame.hops + (std::uint64_t{flight.air.attempt} << 16);
    if (message.is_routed && frame.next_hop != everyone) {
        // The protocol may send the message to the same robot again: each frame has its own draw.
        const std::size_t sender = frame.sender.index();
        if (sender >= unicasts_.size()) unicasts_.resize(sender + 1);
        number += std::uint64_t{++unicasts_[sender]} << 32;
    }
    const double success = world_.medium.stations().radio(frame.sender).success_rate;
    for (Reception& r : flight.receivers.all()) {
        if (!is_decoded(r.fate)) continue;
        const double draw = world_.draw(Purpose::link_success,
                                        combine(world_.key(frame.sender), world_.key(r.node)),
                                        combine(message.key, frame.path), number);
        if (draw >= success) r.fate = Fate::garbled;
    }
}

/// Last time up to which receptions can be served together, the first of which is now, by `key`. A
/// reaction to a reception, at least least_reaction later, is after all of them; other events in
/// the queue come first.
Time Channel::served_until(EventKey key) const {
    if (world_.settings.reference) return key.time();
    const Time most = std::min(key.time() + least_reaction - Duration{1}, world_.end_of_run);
    const EventKey next = world_.events.next_key();
    if (next.time() > most) return most;
    return key.at(next.time()) < next ? next.time() : next.time() - Duration{1};
}

/// Receptions to serve next, by `key`; sets World::now to the end of the last one.
std::span<Reception> Channel::next_of(Flight& flight, EventKey key) const {
    const auto rest = flight.receivers.all().subspan(flight.served);
    const Time until = served_until(key);
    std::size_t count = 1;
    if (flight.receivers.last <= until) {
        count = rest.size();
    } else {
        while (rest[count].time <= until) ++count;
    }
    world_.now = rest[count - 1].time;
    flight.served += count;
    return rest.first(count);
}

/// Serves receptions of a transmission: all of them, if no other event is between. Otherwise it
/// serves those before the other event, and queues the event again for the rest, with its old
/// position among equal times.
void Channel::arrive(const Event& event) {
    Flight& flight = flights_[event.payload.data];
    for (auto key = event.key;;) {
        const std::span<Reception> ended = next_of(flight, key);
        if (interference_) interference_->judge(flight.emission, ended, world_.now);
        if (!flight.air.control) world_.messages.mark_ended(flight.air.frame.message);
        const std::size_t begin = flight.served - ended.size();
        const std::span<const Dbm> levels =
            flight.levels.empty() ? std::span<const Dbm>{}
                                  : std::span(flight.levels).subspan(begin, ended.size());
        user_.frame_ended(flight.air, {ended, levels, flight.error_free});
        if (flight.served == flight.receivers.all().size()) break;
        key = event.key.at(flight.receivers.all()[flight.served].time);
        const bool is_next = key.time() <= world_.end_of_run && world_.events.runs_before_next(key);
        if (world_.settings.reference || !is_next) {
            world_.events.requeue(key, event.payload);
            return;
        }
    }
    const AirFrame air = flight.air;
    if (!interference_) flights_.release(event.payload.data);  // else once it is off the air
    if (!air.control) world_.release(air.frame);
}

}  // namespace rovernet
