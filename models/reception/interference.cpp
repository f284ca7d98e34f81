// SPDX-License-Identifier: MIT
#include "models/reception/interference.hpp"

#include <algorithm>

namespace rovernet {

void Interference::goes(NodeId node, const Leg& leg) {
    on_air_.goes(leg, settings_.medium->stations().radio(node).antenna_height);
}

std::uint64_t Interference::add(Emission frame, const Transmission& how,
                                std::span<const Reception> receptions) {
    frame.squared_reach = settings_.medium->arrivals().squared_reach(frame.from);
    const std::uint64_t serial = on_air_.add(frame);
    judge_->begins({on_air_[serial], *settings_.phy, how, receptions});
    return serial;
}

void Interference::judge(std::uint64_t serial, std::span<Reception> receptions, Time now) {
    const Emission& judged = on_air_[serial];
    // Frames that ended by `since` or begin at `until` overlap with it nowhere; nor, if that
    // matters, with frames that its receivers may have been receiving before.
    const Duration past = judge_->looks_back() ? on_air_.longest() : Duration{0};
    const Time since = judged.begin - longest_delay() - past;
    const Time until = judged.end + longest_delay();
    const bool all_frames = settings_.all_frames;
    const Frames nearby = all_frames ? Frames{} : on_air_.near(judged, since, until, now);
    if (!nearby.empty()) {  // all at once, so that no load waits for the one before
        for (const Reception& r : receptions) settings_.medium->prefetch_position(r.node);
    }
    all_.clear();
    earlier_is_near_.reset();
    for (Reception& r : receptions) {
        if (!settings_.medium->stations().is_on(r.node)) continue;
        const bool near = !all_frames && !on_air_.has_changed(r.node);
        if (!near && all_.empty()) {
            for (const Emission& e : on_air_.frames()) {
                const bool may_matter = e.end > since && e.begin < until;
                if (may_matter && e.serial != judged.serial) all_.push_back(&e);
            }
        }
        judge_->judge(*this, judged, near ? nearby : Frames{all_}, r);
    }
}

Frames Interference::earlier(const Emission& judged, NodeId node) {
    const bool near = !settings_.all_frames && !on_air_.has_stored_change(node);
    if (earlier_is_near_ == near) return earlier_;
    earlier_is_near_ = near;
    earlier_.clear();
    const Duration delay = longest_delay();
    const Time since = judged.begin - judge_->airtimes_kept() * (longest_airtime() + delay);
    const Time until = judged.begin + delay;
    if (near) {
        const Frames found = on_air_.past(judged, since, until, judged.end + delay);
        earlier_.assign(found.begin(), found.end());
    } else {
        for (const auto* frames : {&on_air_.past_frames(), &on_air_.frames()}) {
            for (const Emission& e : *frames) {
                const bool may_matter = e.end > since && e.begin < until;
                if (may_matter && e.serial != judged.serial) earlier_.push_back(&e);
            }
        }
    }
    std::sort(earlier_.begin(), earlier_.end(),
              [](const Emission* a, const Emission* b) { return a->serial > b->serial; });
    return earlier_;
}

std::optional<Arrival> Interference::arrival(const Emission& frame, NodeId node) {
    if (frame.from == node) return own_frame(node, frame.begin, frame.end);
    Medium& medium = *settings_.medium;
    if (medium.stations().is_directional()) [[unlikely]]
        return directional_arrival(frame, node);
    if (on_air_.has_stored_change(node)) return arrival_before_change(frame, node);
    return medium.arrivals().of(frame, node, medium.position(node, frame.begin, *settings_.legs));
}

/// Like arrival(), at a node whose leg or radio may have changed since the frame began.
std::optional<Arrival> Interference::arrival_before_change(const Emission& frame, NodeId node) {
    Medium& medium = *settings_.medium;
    const OnAir::Before* before = on_air_.before(node, frame);
    if (before && !before->on) return std::nullopt;
    const Vec3 at = before ? before->leg.position(frame.begin)
                           : medium.position(node, frame.begin, *settings_.legs);
    return medium.arrivals().of(frame, node, at);
}

/// Like arrival(), with the headings of both ends when the frame began.
std::optional<Arrival> Interference::directional_arrival(const Emission& frame, NodeId node) {
    const auto before = [&](NodeId end) {
        return on_air_.has_stored_change(end) ? on_air_.before(end, frame) : nullptr;
    };
    const auto leg_of = [&](NodeId end) {
        const OnAir::Before* changed = before(end);
        return changed ? changed->leg : settings_.legs->leg(end);
    };
    if (const OnAir::Before* changed = before(node); changed && !changed->on) return std::nullopt;
    const Leg leg = leg_of(node);
    const Headings headings{{leg_of(frame.from).heading_at(frame.begin)},
                            {leg.heading_at(frame.begin)}};
    return settings_.medium->arrivals().of(frame, node, leg.position(frame.begin), headings);
}

double Interference::draw(Purpose purpose, NodeId from, NodeId to, std::uint64_t number) const {
    return uniform(
        {settings_.seed, settings_.replication, purpose, combine(key(from), key(to)), number, 0});
}

}  // namespace rovernet
