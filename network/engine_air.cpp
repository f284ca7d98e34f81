// SPDX-License-Identifier: MIT
// From a node that sends to those that get the frame.
#include "network/engine.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace rovernet {
namespace {

constexpr std::size_t most_counted = 64;

/// Counts for each of a few receptions how many come before it: more comparisons than other ways to
/// sort take, but none that is mispredicted. All come within 2^31 ns from `first` on.
void sort_by_counting(std::span<Reception> all, Time first) {
    std::array<std::int64_t, most_counted> order;
    std::array<Reception, most_counted> unsorted;
    for (std::size_t i = 0; i < all.size(); ++i) {
        order[i] = (all[i].time - first).count() << 32 | all[i].node.value;
        unsorted[i] = all[i];
    }
    for (std::size_t i = 0; i < all.size(); ++i) {
        std::size_t before = 0;
        for (std::size_t k = 0; k < all.size(); ++k) before += order[k] < order[i];
        all[before] = unsorted[i];
    }
}

}  // namespace

Time Engine::transmit(const AirFrame& air) {
    const Frame& frame = air.frame;
    ++transmissions_;
    if (air.kind == AirFrame::data) emit(Transmitted{now_, frame, air.heard_from});
    if (wanted_ & kind_of<AirSent>()) emit(AirSent{now_, air, bytes(air)});
    const std::size_t slot = flights_.take();
    Flight& flight = flights_[slot];
    flight.air = air;
    flight.arrived = 0;
    const Time end = now_ + airtime(air);
    if (dcf_) {
        transmit_sensed(flight, end);
    } else {
        medium_.find_receivers(frame.sender, now_, end, legs_, flight.receivers);
        sort(flight.receivers);
    }
    if (frames_meet_) put_on_air(slot, end);
    const bool errors = medium_.radio(frame.sender).success_rate < 1;
    if (errors) garble(flight);
    if (air.kind == AirFrame::data && frame.next_hop != everyone) tell_if_unheard(flight);
    flight.undisturbed = !errors && !frames_meet_;
    if (flight.receivers.all().empty()) {
        if (!frames_meet_) flights_.release(slot);
        return end;
    }
    if (air.kind == AirFrame::data) messages_.hold(frame.message);
    queue_.schedule(flight.receivers.first, Priority::frame_end,
                    {Occurrence::Kind::frame, frame.sender, slot});
    return end;
}

/// Finds the receivers, and tells all that sense the frame.
void Engine::transmit_sensed(Flight& flight, Time end) {
    const NodeId sender = flight.air.frame.sender;
    const auto sensors = medium_.find_sensors(sender, now_, end, legs_, flight.receivers);
    sort(flight.receivers);
    const Duration airtime = end - now_;
    for (const Reception& r : flight.receivers.all()) {
        dcf_->energy(r.node, r.time - airtime, r.time);
    }
    for (const Medium::Found& s : sensors) {
        const Duration delay = medium_.delay(std::sqrt(s.squared_distance));
        dcf_->energy(s.node, now_ + delay, end + delay);
    }
}

/// Puts the receptions of a frame in order.
void Engine::sort(Medium::Receivers& receivers) {
    const std::span<Reception> all = receivers.all();
    if (all.empty()) return;
    constexpr Duration longest{std::numeric_limits<std::int32_t>::max()};
    if (all.size() > most_counted || receivers.last - receivers.first > longest) {
        std::sort(all.begin(), all.end());
    } else {
        sort_by_counting(all, receivers.first);
    }
}

/// Keeps a frame for as long as it may meet others.
void Engine::put_on_air(std::size_t slot, Time end) {
    Flight& flight = flights_[slot];
    const NodeId sender = flight.air.frame.sender;
    if (std::holds_alternative<Sinr>(settings_.reception)) {
        count_on_air(end);
        flight.locks.assign(flight.receivers.all().size(), Lock::open);
        flight.number = node(sender).transmissions++;
    }
    forget_frames();
    flight.emission = on_air_.add({.begin = now_,
                                   .end = end,
                                   .origin = medium_.origin(),
                                   .from = sender,
                                   .heard_within = medium_.heard_within(),
                                   .squared_reach = medium_.squared_reach(sender),
                                   .flight = static_cast<std::uint32_t>(slot)});
}

/// Forgets those that matter no more.
void Engine::forget_frames() {
    // A reception may still be judged that began so long ago, and one that it depends on before.
    const Duration matters = 2 * (on_air_.longest() + longest_delay());
    on_air_.forget(now_ - matters, [&](const Emission& frame) { flights_.release(frame.flight); });
}

/// Before a node's leg or radio changes: what it was matters for the frames on air.
void Engine::keep_past(NodeId id, bool on) {
    forget_frames();
    on_air_.changes(id, legs_.leg(id), on);
}

void Engine::count_on_air(Time end) {
    std::erase_if(ends_, [&](Time each) { return each <= now_; });
    ends_.push_back(end);
    most_on_air_ = std::max(most_on_air_, ends_.size());
}

std::optional<Db> Engine::interference_left_out() const {
    if (!std::holds_alternative<Sinr>(settings_.reception)) return std::nullopt;
    // Beside the frame that is received.
    return medium_.left_out(std::max<std::size_t>(most_on_air_, 1) - 1);
}

/// Decides which receivers get the frame with errors, by its sender's success rate.
void Engine::garble(Flight& flight) {
    if (flight.air.kind != AirFrame::data) return;
    const Frame& frame = flight.air.frame;
    const double success = medium_.radio(frame.sender).success_rate;
    for (Reception& r : flight.receivers.all()) {
        const Key draw{settings_.seed,
                       settings_.replication,
                       Purpose::link_success,
                       combine(key(frame.sender), key(r.node)),
                       combine(messages_[frame.message].key, frame.path),
                       frame.hops + (std::uint64_t{flight.air.attempt} << 16)};
        if (is_decoded(r.fate) && uniform(draw) >= success) r.fate = Fate::garbled;
    }
}

/// Decides what becomes of receptions that end now, by what else is on air there.
void Engine::judge(const Flight& flight, std::span<Reception> receptions) {
    const Emission& judged = on_air_[flight.emission];
    const bool locks = std::holds_alternative<Sinr>(settings_.reception);
    const auto* rung = std::get_if<Collision>(&settings_.reception);
    // What was over by `since` or begins at `until` arrives nowhere together with it; nor, where
    // that matters, with what its receivers may have been at before.
    const bool past_matters = locks || rung->capture == CaptureOrder::first;
    const Duration past = past_matters ? on_air_.longest() : Duration{0};
    const Time since = judged.begin - longest_delay() - past;
    const Time until = judged.end + longest_delay();
    const Frames nearby = settings_.reference ? Frames{} : on_air_.near(judged, since, until, now_);
    if (!nearby.empty()) {  // together, so that none waits for the one before
        for (const Reception& r : receptions) medium_.prefetch_position(r.node);
    }
    all_.clear();
    const SinrFrame sent = locks ? sinr_frame(flight) : SinrFrame{};
    for (Reception& r : receptions) {
        if (!medium_.is_on(r.node)) continue;
        const bool near = !settings_.reference && !on_air_.has_changed(r.node);
        if (!near && all_.empty()) {
            for (const Emission& e : on_air_.frames()) {
                const bool may_matter = e.end > since && e.begin < until;
                if (may_matter && e.serial != judged.serial) all_.push_back(&e);
            }
        }
        const Frames frames = near ? nearby : Frames{all_};
        if (locks) {
            judge_sinr(sent, judged, frames, r);
        } else if (!frames.empty()) {
            judge_collision(judged, frames, r);
        }
    }
}

/// A frame as it arrives at a node; nothing if the node does not notice it.
std::optional<Arrival> Engine::arrival(const Emission& frame, NodeId node) {
    if (frame.from == node) return own_frame(node, frame.begin, frame.end);
    if (on_air_.has_changed(node)) {
        if (const OnAir::Before* before = on_air_.before(node, frame)) {
            if (!before->on) return std::nullopt;
            return medium_.arrival(frame, node, before->leg.position(frame.begin));
        }
    }
    return medium_.arrival(frame, node, medium_.position(node, frame.begin, legs_));
}

void Engine::judge_collision(const Emission& judged, Frames others, Reception& reception) {
    const NodeId node = reception.node;
    const auto& rung = std::get<Collision>(settings_.reception);
    const Time since = judged.begin - longest_delay();  // who was over by then met it nowhere
    constexpr double open = std::numeric_limits<double>::quiet_NaN();
    Arrival signal{.begin = reception.time - (judged.end - judged.begin),
                   .end = reception.time,
                   .level_dbm = open,
                   .squared_distance = open,
                   .from = judged.from};
    const auto is_stronger = [&](Arrival& mine, Arrival& other, Db by) {
        if (std::isnan(mine.squared_distance)) mine = *arrival(judged, node);
        return medium_.is_stronger(mine, other, by, node);
    };
    for (const Emission* frame : others) {
        if (frame->end <= since) continue;
        auto other = arrival(*frame, node);
        if (!other || rung.survives(signal, *other, is_stronger)) continue;
        if (!other->own && rung.finds_receiver_at(signal, *other) &&
            was_let_pass(*frame, *other, others, node)) {
            continue;
        }
        reception.fate = other->own ? Fate::busy : Fate::collided;
        if (!other->own) return;
    }
}

/// At the rung "collision": `node`, where `frame` arrives, was at one of the `others` when it
/// began, and let it pass.
bool Engine::was_let_pass(const Emission& frame, Arrival& arrives, Frames others, NodeId node) {
    const auto& rung = std::get<Collision>(settings_.reception);
    const Time over = arrives.begin - longest_delay();  // who was so by then was so here
    const auto is_stronger = [&](Arrival& a, Arrival& b, Db by) {
        return medium_.is_stronger(a, b, by, node);
    };
    return std::any_of(others.begin(), others.end(), [&](const Emission* each) {
        if (each->begin > arrives.begin || each->end <= over || each == &frame) return false;
        auto other = arrival(*each, node);
        return other && rung.lets_pass(arrives, *other, is_stronger);
    });
}

/// What judging a flight's receptions takes, but for the receiver's noise.
SinrFrame Engine::sinr_frame(const Flight& flight) const {
    const Emission& sent = on_air_[flight.emission];
    const BitRate rate = rate_of(flight.air);
    return {.modulation = *modulation_of(rate),
            .rate = rate.value,
            .payload = sent.end - sent.begin - medium_.radio(sent.from).preamble};
}

void Engine::judge_sinr(const SinrFrame& sent, const Emission& judged, Frames others,
                        Reception& reception) {
    const NodeId node = reception.node;
    arrivals_.clear();
    const auto add = [&](const Emission& frame) {
        const auto arrives = arrival(frame, node);
        if (!arrives) return;
        arrivals_.push_back(*arrives);
        arrivals_.back().lock = lock_of(flights_[frame.flight], node);
    };
    add(judged);
    for (const Emission* frame : others) add(*frame);
    SinrFrame frame = sent;
    frame.noise = medium_.noise(node);
    const Fate fate = sinr_receiver_.judge(
        arrivals_.front(), arrivals_, frame,
        [&](const Arrival& a) { return medium_.level(a, node).value; },
        [&] {
            const std::uint64_t pair = combine(key(judged.from), key(node));
            return uniform({settings_.seed, settings_.replication, Purpose::bit_errors, pair,
                            flights_[judged.flight].number, 0});
        },
        [this](NodeId a, NodeId b) { return key(a) < key(b); });
    const bool decoded_but_garbled = is_decoded(fate) && reception.fate == Fate::garbled;
    if (!decoded_but_garbled) reception.fate = fate;
}

/// What `node` made of a frame; null if it could not decode it.
Lock* Engine::lock_of(Flight& flight, NodeId node) {
    const auto all = flight.receivers.all();
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Reception& r) { return r.node == node; });
    if (found == all.end()) return nullptr;
    return &flight.locks[static_cast<std::size_t>(found - all.begin())];
}

/// The last time up to which receptions can be served in a row, the first of which is now, by
/// `key`: what a reception sets off happens no sooner than least_reaction after it, and whatever is
/// queued takes its turn.
Time Engine::served_until(EventKey key) const {
    if (settings_.reference) return key.time();
    const Time most = std::min(key.time() + least_reaction, end_of_run_);
    const EventKey next = queue_.next_key();
    if (next.time() > most) return most;
    return key.at(next.time()) < next ? next.time() : next.time() - Duration{1};
}

/// The receptions that are served next, by `key`; now is when the last of them ends.
std::span<Reception> Engine::next_of(Flight& flight, EventKey key) {
    const auto rest = flight.receivers.all().subspan(flight.arrived);
    const Time until = served_until(key);
    std::size_t count = 1;
    if (flight.receivers.last <= until) {
        count = rest.size();
    } else {
        while (rest[count].time <= until) ++count;
    }
    now_ = rest[count - 1].time;
    flight.arrived += count;
    return rest.first(count);
}

/// Serves the receptions of a transmission by one event: all, if nothing else can happen in
/// between. Otherwise as many as come before that; then the event is queued again for the rest, in
/// its old place among equal times.
void Engine::arrive(const Scheduler<Occurrence>::Event& event) {
    Flight& flight = flights_[event.payload.data];
    for (auto key = event.key;;) {
        const std::span<Reception> ended = next_of(flight, key);
        if (frames_meet_) judge(flight, ended);
        if (flight.air.kind == AirFrame::data) messages_.arrived(flight.air.frame.message);
        receive(flight, ended);
        if (dcf_) tell_stations(flight, ended);
        if (flight.arrived == flight.receivers.all().size()) break;
        key = event.key.at(flight.receivers.all()[flight.arrived].time);
        const bool is_next = key.time() <= end_of_run_ && queue_.runs_before_next(key);
        if (settings_.reference || !is_next) {
            queue_.requeue(key, event.payload);
            return;
        }
    }
    const AirFrame air = flight.air;
    if (!frames_meet_) flights_.release(event.payload.data);  // else once it is off the air
    if (air.kind == AirFrame::data) release(air.frame.message);
}

}  // namespace rovernet
