// SPDX-License-Identifier: MIT
#include "traces/ns2/ns2_diff.hpp"

#include <chrono>
#include <optional>
#include <string_view>
#include <type_traits>

namespace rovernet {
namespace {

constexpr std::size_t around = 2;  // events shown before and after the first difference

/// Whether both lines have the field, with different values.
template <class T>
bool both_differ(const std::optional<T>& a, const std::optional<T>& b) {
    return a && b && !(*a == *b);
}

/// Name of the first IP field that differs; "" if none does.
std::string_view ip_difference(const Ns2Packet& a, const Ns2Packet& b) {
    if (!a.ip || !b.ip) return a.ip.has_value() == b.ip.has_value() ? "" : "IP header";
    if (a.ip->from != b.ip->from || a.ip->from_port != b.ip->from_port) return "source";
    if (a.ip->to != b.ip->to || a.ip->to_port != b.ip->to_port) return "destination";
    if (a.ip->ttl != b.ip->ttl) return "ttl";
    if (a.dialect == b.dialect && a.ip->next_hop != b.ip->next_hop) return "next hop";
    return "";
}

std::string_view difference(const Ns2Packet& a, const Ns2Packet& b) {
    const bool is_one_dialect = a.dialect == b.dialect;
    const bool tells_reason = a.dialect != Ns2Dialect::tagged && b.dialect != Ns2Dialect::tagged;
    if (a.op != b.op) return "event";
    if (a.node != b.node) return "robot";
    if (a.layer != b.layer) return "layer";
    if (tells_reason && a.reason != b.reason) return "reason";
    if (a.uid_column > 0 && b.uid_column > 0 && a.uid != b.uid) return "id";
    if (!a.type.empty() && !b.type.empty() && a.type != b.type) return "type";
    if (both_differ(a.size, b.size)) return "size";
    if (both_differ(a.mac, b.mac)) return "MAC header";
    if (const auto field = ip_difference(a, b); !field.empty()) return field;
    if (both_differ(a.position, b.position)) return "place";
    if (both_differ(a.energy, b.energy)) return "energy";
    return is_one_dialect && a.payload != b.payload ? "payload" : "";
}
std::string_view difference(const Ns2Move& a, const Ns2Move& b) {
    if (a.node != b.node) return "robot";
    if (!(a.from == b.from)) return "place";
    if (!(a.to == b.to)) return "goal";
    return a.speed == b.speed ? "" : "speed";
}
std::string_view difference(const Ns2Energy& a, const Ns2Energy& b) {
    if (a.node != b.node) return "robot";
    return a.energy == b.energy ? "" : "energy";
}
std::string_view difference(const Ns2Reachable& a, const Ns2Reachable& b) {
    if (a.uid != b.uid) return "id";
    return a.robots == b.robots ? "" : "robots reachable";
}

std::string_view difference_of(const Ns2Line& a, const Ns2Line& b, Duration tolerance) {
    if (a.index() != b.index()) return "event";
    return std::visit(
        [&](const auto& left) -> std::string_view {
            using Event = std::decay_t<decltype(left)>;
            if constexpr (requires { left.time; }) {
                const auto& right = *std::get_if<Event>(&b);
                if (const auto field = difference(left, right); !field.empty()) return field;
                return std::chrono::abs(left.time - right.time) > tolerance ? "time" : "";
            }
            return "";
        },
        a);
}

std::string kind_name(const Ns2Line& event) {
    if (std::holds_alternative<Ns2Move>(event)) return "M";
    if (std::holds_alternative<Ns2Energy>(event)) return "N";
    const auto* p = std::get_if<Ns2Packet>(&event);
    if (!p) return "v reachable";
    std::string kind{p->op};
    kind.append(" ").append(p->layer);
    if (p->reason != "---") kind.append(" ").append(p->reason);
    return kind;
}

/// One of the two files, with its last event.
class Side {
  public:
    Side(Ns2Source source, Ns2Strictness strictness) : file_(std::move(source), strictness) {}

    const Ns2Line* next() { return event_ = file_.next(); }
    const Ns2Line* event() const { return event_; }
    const Ns2Counts& counts() const { return file_.counts(); }
    void expect_trace() const { file_.expect_trace(); }

    /// Stores the event, and removes the oldest if there are more than `most`.
    void keep(std::vector<NumberedLine>& shown, std::size_t most) const {
        if (!event_) return;
        if (shown.size() == most) shown.erase(shown.begin());
        shown.push_back({file_.line(), std::string(file_.text())});
    }

  private:
    Ns2File file_;
    const Ns2Line* event_ = nullptr;
};

/// Counts the kinds of all remaining events of a file, including the current one.
template <class Count>
void count_rest(Side& side, std::vector<NumberedLine>& shown, Count count) {
    for (std::size_t n = 0; side.event(); side.next(), ++n) {
        if (n <= around) side.keep(shown, shown.size() + 1);
        ++count(kind_name(*side.event()));
    }
}

}  // namespace

TraceDifference diff_ns2(Ns2Source source_a, Ns2Source source_b, Duration tolerance,
                         Ns2Strictness strictness, DiffExtent extent) {
    TraceDifference result;
    Side a(std::move(source_a), strictness), b(std::move(source_b), strictness);
    a.next(), b.next();
    for (; a.event() && b.event(); a.next(), b.next()) {
        result.field = difference_of(*a.event(), *b.event(), tolerance);
        if (!result.field.empty()) break;
        a.keep(result.a, around), b.keep(result.b, around);
        auto& both = result.kinds[kind_name(*a.event())];
        ++both.first, ++both.second;
    }
    if (!a.event() != !b.event()) result.field = a.event() ? "B ends before A" : "A ends before B";
    result.is_equal = result.field.empty();
    result.place = result.a.size();
    if (extent == DiffExtent::first_difference) {
        a.keep(result.a, around + 1), b.keep(result.b, around + 1);
        result.counts_a = a.counts(), result.counts_b = b.counts();
        return result;
    }
    count_rest(a, result.a,
               [&](const std::string& kind) -> std::uint64_t& { return result.kinds[kind].first; });
    count_rest(b, result.b, [&](const std::string& kind) -> std::uint64_t& {
        return result.kinds[kind].second;
    });
    a.expect_trace(), b.expect_trace();
    result.counts_a = a.counts(), result.counts_b = b.counts();
    return result;
}

}  // namespace rovernet
