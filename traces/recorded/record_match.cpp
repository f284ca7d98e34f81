// SPDX-License-Identifier: MIT
#include "traces/recorded/record_match.hpp"

#include <algorithm>
#include <cstring>
#include <variant>

namespace rovernet {
namespace {

/// Whether all bits of two values are equal: 0 and -0 are not.
template <class T>
bool are_bits_equal(const T& a, const T& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}
static_assert(sizeof(Leg) == 13 * sizeof(double), "no padding");

bool are_equal(const Reception& a, const Reception& b) {
    return a.time == b.time && a.node == b.node && a.fate == b.fate && a.delivered == b.delivered;
}

/// Compares two records of one kind.
class Matcher {
  public:
    Matcher(const RecordContext& of_a, const RecordContext& of_b) : of_a_(of_a), of_b_(of_b) {}

    bool match(const Sent& a, const Sent& b) const {
        return a.time == b.time && a.node == b.node && match(a.message, b.message) &&
               a.ttl == b.ttl && a.robots == b.robots && a.reachable == b.reachable;
    }
    bool match(const Transmitted& a, const Transmitted& b) const {
        return a.time == b.time && match(a.frame, b.frame) && a.heard_from == b.heard_from;
    }
    bool match(const Received& a, const Received& b) const {
        return match(a.frame, b.frame) && a.reserved == b.reserved && a.header == b.header &&
               std::equal(a.receptions.begin(), a.receptions.end(), b.receptions.begin(),
                          b.receptions.end(),
                          [](const auto& p, const auto& q) { return are_equal(p, q); });
    }
    bool match(const Dropped& a, const Dropped& b) const {
        return a.time == b.time && a.node == b.node && match(a.frame, b.frame) &&
               a.reason == b.reason;
    }
    bool match(const Moved& a, const Moved& b) const {
        return a.time == b.time && a.node == b.node && are_bits_equal(a.leg, b.leg);
    }
    bool match(const Arrived& a, const Arrived& b) const {
        return a.time == b.time && a.node == b.node;
    }
    bool match(const NoWay& a, const NoWay& b) const {
        return a.time == b.time && a.node == b.node && are_bits_equal(a.goal, b.goal);
    }
    bool match(const Switched& a, const Switched& b) const {
        return a.time == b.time && a.node == b.node && a.on == b.on;
    }
    template <class LinkChange>
    requires requires(const LinkChange& r) { r.from, r.to; }
    bool match(const LinkChange& a, const LinkChange& b) const {
        return a.time == b.time && a.from == b.from && a.to == b.to;
    }
    bool match(const AirSent& a, const AirSent& b) const {
        return a.time == b.time && match(a.air, b.air) && a.bytes == b.bytes;
    }
    bool match(const ControlReceived& a, const ControlReceived& b) const {
        return match(a.air, b.air) && are_equal(a.reception, b.reception) && a.bytes == b.bytes;
    }

  private:
    bool match(MessageId a, MessageId b) const {
        return of_a_.messages[a].uid == of_b_.messages[b].uid;
    }
    static bool are_hops_equal(const Frame& a, const Frame& b) {
        return a.sender == b.sender && a.ttl == b.ttl && a.hops == b.hops &&
               a.next_hop == b.next_hop;
    }
    bool match(const Frame& a, const Frame& b) const {
        return are_hops_equal(a, b) && match(a.message, b.message);
    }
    bool match(const AirFrame& a, const AirFrame& b) const {
        return a.kind == b.kind && are_hops_equal(a.frame, b.frame) &&
               a.heard_from == b.heard_from && a.attempt == b.attempt && a.number == b.number &&
               a.reserved == b.reserved &&
               (a.kind != AirFrame::data || match(a.frame.message, b.frame.message));
    }

    const RecordContext& of_a_;
    const RecordContext& of_b_;
};

}  // namespace

bool are_same(const Record& a, const RecordContext& of_a, const Record& b,
              const RecordContext& of_b) {
    if (a.index() != b.index()) return false;
    return std::visit(
        [&](const auto& one) {
            const auto* other = std::get_if<std::decay_t<decltype(one)>>(&b);
            return other && Matcher(of_a, of_b).match(one, *other);
        },
        a);
}

}  // namespace rovernet
