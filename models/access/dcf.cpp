// SPDX-License-Identifier: MIT
#include "models/access/dcf.hpp"

#include "models/access/wifi_frames.hpp"
#include "sim/fields.hpp"

#include <functional>

namespace rovernet {

std::unique_ptr<Access> Csma::make_access() const { return std::make_unique<Dcf>(*this); }

Dcf::Dcf(const Csma& settings)
    : settings_{settings, settings.timing(),
                settings.basic_rates.value_or(mandatory_rates(settings.standard)),
                settings.sends_at_once()} {
    const double slot = seconds(settings_.timing.slot);
    if (!positive.contains(slot)) throw_out_of_range("csma", "slot", positive.text, slot);
    auto& rates = settings_.rates;
    std::sort(rates.begin(), rates.end(), std::less<>());
    const double lowest = rates.empty() ? 0 : rates.front().value;
    if (!positive.contains(lowest)) {
        throw_out_of_range("csma", "basic_rates", positive.text, lowest);
    }
}

BitRate Dcf::answer_rate(BitRate rate) const {
    const auto& rates = settings_.rates;
    const auto above = std::upper_bound(rates.begin(), rates.end(), rate);
    return above == rates.begin() ? rates.front() : *(above - 1);
}

BitRate Dcf::rate(const AirFrame& frame, BitRate sender, BitRate receiver) const {
    const bool for_everyone = frame.frame.next_hop == everyone;
    if (!frame.control && !for_everyone) return sender;
    if (frame.control != &wifi_ack) return settings_.rates.front();  // a CTS answers an RTS
    return for_everyone ? settings_.timing.lowest_rate : answer_rate(receiver);
}

void Dcf::add() {
    stations_.emplace_back();
    listening_.push_back({Backoff(settings_.timing)});
    stations_.back().window = settings_.timing.cw_min;
}

void Dcf::send(Air& air, const QueuedFrame& frame) {
    const NodeId node = frame.frame.sender;
    const auto refused =
        at(node).queue.push(frame, static_cast<std::size_t>(settings_.queue), settings_.priority);
    if (refused) return air.lost(*refused, DropReason::queue_full);
    if (at(node).state == State::idle) contend(air, node);
}

/// Starts contention for the first frame of the queue.
void Dcf::contend(Air& air, NodeId node) {
    Station& s = at(node);
    const Time now = air.now();
    s.state = State::contending;
    s.fresh = false;
    // The backoff after the last frame may still be running.
    if (!(s.backing_off && backoff(node).grant() > now)) {
        const bool is_busy = backoff(node).is_busy(now);
        const Time from = is_busy ? now : now + settings_.timing.difs;
        if (is_busy || !settings_.at_once) {
            draw_backoff(air, node, from);
        } else {
            backoff(node).begin(0, from);
            s.fresh = true;
        }
    }
    set_timer(air, node, backoff(node).grant(), access);
}

void Dcf::set_timer(Air& air, NodeId node, Time t, Tag tag) {
    at(node).timer = t;
    air.access_timer(node, t, tag);
}

void Dcf::draw_backoff(Air& air, NodeId node, Time from) {
    Station& s = at(node);
    const double slots = air.access_draw(node, s.draws++) * (s.window + 1);
    backoff(node).begin(static_cast<int>(slots), from);
    s.backing_off = true;
}

void Dcf::on_timer(Air& air, NodeId node, std::uint32_t tag) {
    Station& s = at(node);
    if (tag == response) return send_response(air, node);
    const bool contends = s.state == State::contending;
    if (s.timer != air.now() || contends != (tag == access)) return;  // another took its place
    s.timer = never;
    if (tag == answer) {
        // A frame that is arriving may be the response.
        if (listening_[node.index()].on_air_until > air.now())
            return set_timer(air, node, listening_[node.index()].on_air_until, answer);
        return answer_missing(air, node);
    }
    if (s.fresh && backoff(node).was_busy()) {
        s.fresh = false;
        draw_backoff(air, node, air.now());
    }
    if (backoff(node).grant() > air.now())
        return set_timer(air, node, backoff(node).grant(), access);
    transmit_head(air, node);
}

AirFrame Dcf::data_frame(NodeId node) const {
    const Station& s = stations_[node.index()];
    return {.frame = s.queue.front().frame,
            .heard_from = s.queue.front().heard_from,
            .attempt = static_cast<std::uint8_t>(s.short_count + s.long_count),
            .number = s.number};
}

AirFrame Dcf::control_frame(NodeId from, NodeId to, const ControlFrame& kind) {
    AirFrame control{.control = &kind};
    control.frame.sender = from;
    control.frame.next_hop = to;
    return control;
}

/// Transmits the first frame of the queue, or an RTS for it.
void Dcf::transmit_head(Air& air, NodeId node) {
    const AirFrame data = data_frame(node);
    const NodeId to = data.frame.next_hop;
    const bool asks = to != everyone && air.bytes(data) > settings_.rts_threshold.value;
    if (!asks) return transmit_data(air, node);
    AirFrame rts = control_frame(node, to, wifi_rts);
    const Duration sifs = settings_.timing.sifs;
    rts.reserved = 3 * sifs + air.airtime(control_frame(to, node, wifi_cts)) + air.airtime(data) +
                   air.airtime(control_frame(to, node, wifi_ack));
    await(air, node, transmit(air, rts), State::awaiting_cts);
}

void Dcf::transmit_data(Air& air, NodeId node) {
    AirFrame data = data_frame(node);
    const NodeId to = data.frame.next_hop;
    if (to == everyone) return finish(air, node, transmit(air, data), std::nullopt);
    data.reserved = settings_.timing.sifs + air.airtime(control_frame(to, node, wifi_ack));
    await(air, node, transmit(air, data), State::awaiting_ack);
}

/// Transmits a frame; returns its end.
Time Dcf::transmit(Air& air, const AirFrame& frame) {
    const Time end = air.transmit(frame);
    backoff(frame.frame.sender).energy(air.now(), end);
    at(frame.frame.sender).sends_until = end;
    return end;
}

/// Sets the timer for the response to a frame that ends at `end`.
void Dcf::await(Air& air, NodeId node, Time end, State state) {
    const WifiTiming& t = settings_.timing;
    at(node).state = state;
    set_timer(air, node, end + t.sifs + t.slot + t.rx_start_delay, answer);
}

void Dcf::answer_missing(Air& air, NodeId node) {
    Station& s = at(node);
    const bool behind_rts = s.state == State::awaiting_ack && s.asked;
    int& count = behind_rts ? s.long_count : s.short_count;
    const int limit = behind_rts ? settings_.long_retries : settings_.short_retries;
    s.asked = false;
    if (++count == limit) return finish(air, node, air.now(), DropReason::retries);
    s.window = std::min(2 * s.window + 1, settings_.timing.cw_max);
    s.state = State::contending;
    draw_backoff(air, node, air.now());
    set_timer(air, node, backoff(node).grant(), access);
}

/// Ends the work on the first frame of the queue: it was sent, or lost with a reason. A backoff
/// follows, with or without another frame.
void Dcf::finish(Air& air, NodeId node, Time end, std::optional<DropReason> reason) {
    Station& s = at(node);
    const QueuedFrame done = s.queue.pop();
    next_frame(s);
    s.state = State::idle;
    s.timer = never;
    draw_backoff(air, node, end);
    if (!s.queue.empty()) {
        s.state = State::contending;
        set_timer(air, node, backoff(node).grant(), access);
    }
    if (reason) {
        air.lost(done, *reason);
    } else {
        air.sent(done);
    }
}

void Dcf::next_frame(Station& s) {
    ++s.number;
    s.short_count = s.long_count = 0;
    s.asked = false;
    s.window = settings_.timing.cw_min;
}

void Dcf::sensed(Air& air, std::span<const Sensing> nodes) {
    for (const auto& [node, decodable, coding, begin, end] : nodes) {
        Listening& l = listening_[node.index()];
        l.backoff.energy(begin, end);
        l.on_air_until = std::max(l.on_air_until, end);
    }
    if (settings_.eifs != EifsRule::ns2) return;
    for (const Sensing& each : nodes) {
        if (!each.decodable) defer_as_ns2(air, each.node, each.end);
    }
}

void Dcf::received(Air& air, NodeId node, const AirFrame& frame) {
    Station& s = at(node);
    const bool is_sooner = backoff(node).frame_decoded() && s.state == State::contending;
    if (is_sooner) set_timer(air, node, backoff(node).grant(), access);
    if (frame.frame.next_hop == node) return answer_to(air, node, frame);
    if (frame.reserved == Duration{0}) return;
    reserve(node, air.now(), air.now() + frame.reserved);
}

void Dcf::reserve(NodeId node, Time from, Time until) {
    at(node).reserved_until = std::max(at(node).reserved_until, until);
    backoff(node).energy(from, until);
}

/// Handles a frame for this node that has ended, and answers it.
void Dcf::answer_to(Air& air, NodeId node, const AirFrame& frame) {
    Station& s = at(node);
    const NodeId from = frame.frame.sender;
    if (!frame.control) return respond(air, node, control_frame(node, from, wifi_ack));
    if (frame.control == &wifi_rts) {
        if (s.reserved_until > air.now()) return;
        AirFrame cts = control_frame(node, from, wifi_cts);
        cts.reserved = frame.reserved - settings_.timing.sifs - air.airtime(cts);
        return respond(air, node, cts);
    }
    if (frame.control == &wifi_cts) {
        if (s.state != State::awaiting_cts) return;
        s.timer = never;
        s.short_count = 0;
        s.asked = true;
        return respond(air, node, data_frame(node));
    }
    if (s.state == State::awaiting_ack) finish(air, node, air.now(), std::nullopt);
}

/// Schedules `frame` after a SIFS, without carrier sensing.
void Dcf::respond(Air& air, NodeId node, const AirFrame& frame) {
    const Time begin = air.now() + settings_.timing.sifs;
    at(node).response = frame;
    backoff(node).energy(air.now(), begin + air.airtime(frame));
    air.access_timer(node, begin, response);
}

void Dcf::send_response(Air& air, NodeId node) {
    Station& s = at(node);
    if (!s.response) return;
    const AirFrame frame = *std::exchange(s.response, std::nullopt);
    if (!frame.control) return transmit_data(air, node);
    transmit(air, frame);
}

void Dcf::missed(Air& air, NodeId node, bool locked) {
    if (settings_.eifs == EifsRule::ns2) return defer_as_ns2(air, node, air.now());
    if (settings_.eifs == EifsRule::none || !locked) return;
    backoff(node).frame_lost(air.now(), eifs(air, node));
}

Duration Dcf::eifs(const Air& air, NodeId node) const {
    const WifiTiming& t = settings_.timing;
    return t.sifs + air.airtime(control_frame(node, everyone, wifi_ack)) + t.difs;
}

void Dcf::defer_as_ns2(const Air& air, NodeId node, Time end) {
    if (at(node).sends_until > end) return;
    reserve(node, end, end + eifs(air, node));
}

bool Dcf::is_repeated(NodeId node, const AirFrame& frame) {
    const std::uint64_t link = std::uint64_t{node.value} << 32 | frame.frame.sender.value;
    const auto [last, is_new] = last_numbers_.try_emplace(link, frame.number);
    return !is_new && std::exchange(last->second, frame.number) == frame.number;
}

std::vector<QueuedFrame> Dcf::take(NodeId node, const FrameTest& is_taken) {
    Station& s = at(node);
    const bool contends = s.state == State::contending;
    const bool takes_first = contends && is_taken(s.queue.front().frame);
    auto frames = s.queue.take(is_taken, !contends);
    if (!takes_first) return frames;
    next_frame(s);
    if (!s.queue.empty()) return frames;
    s.state = State::idle;  // its backoff goes on
    s.timer = never;
    return frames;
}

void Dcf::switch_off(Air& air, NodeId node) {
    Station& s = at(node);
    const bool has_sent = s.state == State::awaiting_ack;
    s.state = State::idle;
    s.timer = never;
    s.response.reset();
    if (has_sent) air.sent(s.queue.pop());  // the frame may still arrive, or has arrived
    for (const QueuedFrame& frame : s.queue.take_all()) air.lost(frame, DropReason::end);
}

}  // namespace rovernet
