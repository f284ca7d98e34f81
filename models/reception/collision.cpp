// SPDX-License-Identifier: MIT
#include "models/reception/collision.hpp"

#include "models/reception/interference.hpp"
#include "sim/math.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rovernet {
namespace {

/// Change of the capture ratio [dB], <= 0, because the receiver rejects part of `other` while it
/// receives `wanted`.
Db rejection(const Interference& air, const Arrival& wanted, const Arrival& other) {
    const double left = air.phy().rejection(wanted.coding, other.coding);
    return left == 1 ? Db{0} : Db{10 * math::log10(left)};
}

class CollisionJudge final : public Judge {
  public:
    explicit CollisionJudge(const Collision& model) : model_(model) {}

    bool looks_back() const override { return model_.capture == CaptureOrder::first; }
    void judge(Interference& air, const Emission& judged, Frames others,
               Reception& reception) override;

  private:
    bool was_let_pass(Interference& air, const Emission& frame, Arrival& arrives, Frames others,
                      NodeId node) const;

    Collision model_;
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
    const auto is_stronger = [&](Arrival& mine, Arrival& other, Db by) {
        if (std::isnan(mine.squared_distance)) mine = *air.arrival(judged, node);
        return air.is_stronger(mine, other, by + rejection(air, mine, other), node);
    };
    for (const Emission* frame : others) {
        if (frame->end <= since) continue;
        auto other = air.arrival(*frame, node);
        if (!other || model_.survives(signal, *other, is_stronger)) continue;
        if (!other->own && model_.finds_receiver_at(signal, *other) &&
            was_let_pass(air, *frame, *other, others, node)) {
            continue;
        }
        reception.fate = other->own ? Fate::busy : Fate::collided;
        if (!other->own) return;
    }
}

/// Whether `node`, where `frame` arrives, was receiving one of the `others` when it began, and
/// ignored it.
bool CollisionJudge::was_let_pass(Interference& air, const Emission& frame, Arrival& arrives,
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
