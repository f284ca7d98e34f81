// SPDX-License-Identifier: MIT
#include "models/reception/collision.hpp"

#include "models/reception/collision_receiver.hpp"
#include "models/reception/interference.hpp"
#include "sim/math.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace rovernet {
namespace {

/// Number of airtimes of the longest frame over which the arrivals at a receiver are traced back.
/// More are needed only if in all this time each frame began during one that is stronger by the
/// capture ratio or lasts longer; then the receiver is taken for free at the beginning.
constexpr int airtimes_traced = 8;

/// Change of the capture ratio [dB], <= 0, because the receiver rejects part of `other` while it
/// receives `wanted`.
Db rejection(const Interference& air, const Arrival& wanted, const Arrival& other) {
    const double left = air.phy().rejection(wanted.coding, other.coding);
    return left == 1 ? Db{0} : Db{10 * math::log10(left)};
}

/// Arrivals at one node, compared as its receiver compares them.
class Receiver {
  public:
    Receiver(const Collision& model, Interference& air, NodeId node)
        : model_(model), air_(air), node_(node) {}

    /// Whether the receiver ignores `frame` while `current` is its current frame.
    bool ignores(Arrival& frame, Arrival& current) const {
        const Db by = model_.capture_ratio + rejection(air_, current, frame);
        return air_.is_stronger(current, frame, by, node_);
    }
    /// Order in which the receiver notices frames: by begin, then by falling level.
    bool precedes(const Arrival& a, const Arrival& b) const {
        if (a.begin != b.begin) return a.begin < b.begin;
        const double mine = level(a), other = level(b);
        return mine == other ? air_.key(a.from) < air_.key(b.from) : mine > other;
    }
    /// Whether the receiver is free when `signal`, the arrival of `judged`, begins.
    /// @param memory  memory for other arrivals
    [[gnu::noinline]] bool is_free(const Emission& judged, const Arrival& signal,
                                   std::vector<Arrival>& memory) const;

  private:
    double level(const Arrival& arrival) const {
        const bool open = std::isnan(arrival.level_dbm);
        return open ? air_.level(arrival, node_).value : arrival.level_dbm;
    }
    bool is_start(Arrival& arrival, std::vector<Arrival>& others) const;
    bool is_free_after(std::vector<Arrival>& arrivals, Time t) const;

    const Collision& model_;
    Interference& air_;
    NodeId node_;
};

/// Traces the arrivals before `signal` back to one that certainly became the current frame, and
/// forward from there.
bool Receiver::is_free(const Emission& judged, const Arrival& signal,
                       std::vector<Arrival>& arrivals) const {
    arrivals.clear();
    const Duration longest = air_.longest_airtime() + air_.longest_delay();
    std::size_t next = 0;
    for (const Emission* frame : air_.earlier(judged, node_)) {
        // What was on air when arrival number `next` began is complete.
        for (; next < arrivals.size() && frame->begin <= arrivals[next].begin - longest; ++next) {
            if (!is_start(arrivals[next], arrivals)) continue;
            const Arrival start = arrivals[next];
            std::erase_if(arrivals, [&](const Arrival& each) { return precedes(each, start); });
            return is_free_after(arrivals, signal.begin);
        }
        const auto arrival = air_.arrival(*frame, node_);
        if (arrival && !arrival->own && arrival->begin < signal.begin) arrivals.push_back(*arrival);
    }
    return is_free_after(arrivals, signal.begin);
}

/// Whether `arrival` certainly became the current frame when it began: none of the `others` on air
/// then can have been a reason to ignore it, and none lasts as long.
bool Receiver::is_start(Arrival& arrival, std::vector<Arrival>& others) const {
    return std::none_of(others.begin(), others.end(), [&](Arrival& each) {
        if (&each == &arrival || each.end <= arrival.begin || !precedes(each, arrival)) {
            return false;
        }
        return each.end >= arrival.end || ignores(arrival, each);
    });
}

/// Whether the receiver is free at `t`, after these arrivals and no others.
bool Receiver::is_free_after(std::vector<Arrival>& arrivals, Time t) const {
    std::sort(arrivals.begin(), arrivals.end(),
              [this](const Arrival& a, const Arrival& b) { return precedes(a, b); });
    CollisionReceiver receiver;
    for (Arrival& each : arrivals) {
        receiver.arrives(each,
                         [this](Arrival& f, Arrival& current) { return ignores(f, current); });
    }
    return receiver.is_free(t);
}

class CollisionJudge final : public Judge {
  public:
    explicit CollisionJudge(const Collision& model) : model_(model) {}

    bool looks_back() const override { return model_.capture == CaptureOrder::first; }
    int airtimes_kept() const override { return looks_back() ? airtimes_traced : 0; }
    void judge(Interference& air, const Emission& judged, Frames others,
               Reception& reception) override;

  private:
    /// Frame that a receiver locked onto, and that did not collide, although others began during
    /// it: the receiver ignored these.
    struct HeldFrame {
        Time begin = never, end = never;
        std::uint64_t serial = 0;
        bool hid(const Emission& frame, const Arrival& arrival) const {
            return begin <= arrival.begin && arrival.begin < end && frame.serial != serial;
        }
    };
    HeldFrame& held_at(NodeId node) {
        if (node.index() >= held_.size()) held_.resize(node.index() + 1);
        return held_[node.index()];
    }
    bool may_be_ignored(Interference& air, const Emission& frame, Arrival& arrives, Frames others,
                        NodeId node) const;

    Collision model_;
    std::vector<HeldFrame> held_;    // last one, by node
    std::vector<Arrival> arrivals_;  // memory of Receiver::is_free()
};

void CollisionJudge::judge(Interference& air, const Emission& judged, Frames others,
                           Reception& reception) {
    if (others.empty()) return;
    const NodeId node = reception.node;
    const Time since = judged.begin - air.longest_delay();  // frames over by then met it nowhere
    constexpr double open = std::numeric_limits<double>::quiet_NaN();
    Arrival signal{.begin = reception.time - (judged.end - judged.begin),
                   .end = reception.time,
                   .level_dbm = open,
                   .squared_distance = open,
                   .from = judged.from,
                   .coding = judged.coding};
    bool hides_others = false, finds_others = false;
    const auto is_stronger = [&](Arrival& mine, Arrival& other, Db by) {
        hides_others = true;  // or they collide
        if (std::isnan(mine.squared_distance)) mine = *air.arrival(judged, node);
        // Frames of two codings may both be stronger; the receiver locks onto one of them.
        const bool is_tie = other.begin == mine.begin && other.coding != mine.coding;
        if (is_tie && looks_back() && Receiver(model_, air, node).precedes(other, mine)) {
            return false;
        }
        return air.is_stronger(mine, other, by + rejection(air, mine, other), node);
    };
    for (const Emission* frame : others) {
        if (frame->end <= since) continue;
        auto other = air.arrival(*frame, node);
        if (!other || model_.survives(signal, *other, is_stronger)) continue;
        if (!other->own && model_.finds_receiver_at(signal, *other) &&
            may_be_ignored(air, *frame, *other, others, node)) {
            finds_others |= !held_at(node).hid(*frame, *other);
            continue;
        }
        reception.fate = other->own ? Fate::busy : Fate::collided;
        if (!other->own) return;
    }
    if (finds_others && !Receiver(model_, air, node).is_free(judged, signal, arrivals_)) {
        reception.fate = Fate::collided;
    } else if (hides_others && looks_back()) {
        held_at(node) = {signal.begin, signal.end, judged.serial};
    }
}

/// Whether one of the `others` was on air at `node` and stronger by the capture ratio when `frame`
/// began there. Otherwise the receiver cannot have ignored `frame`.
bool CollisionJudge::may_be_ignored(Interference& air, const Emission& frame, Arrival& arrives,
                                    Frames others, NodeId node) const {
    const Time over = arrives.begin - air.longest_delay();  // frames over by then were so here
    const auto is_stronger = [&](Arrival& a, Arrival& b, Db by) {
        return air.is_stronger(a, b, by + rejection(air, a, b), node);
    };
    return std::any_of(others.begin(), others.end(), [&](const Emission* each) {
        if (each->begin > arrives.begin || each->end <= over || each == &frame) return false;
        auto other = air.arrival(*each, node);
        return other && model_.lets_pass(arrives, *other, is_stronger);
    });
}

}  // namespace

std::unique_ptr<Judge> Collision::make_judge() const {
    return std::make_unique<CollisionJudge>(*this);
}

}  // namespace rovernet
