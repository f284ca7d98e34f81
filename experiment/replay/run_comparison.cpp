// SPDX-License-Identifier: MIT
#include "experiment/replay/run_comparison.hpp"

#include "experiment/replay/recorded_day.hpp"
#include "experiment/replay/trace_input.hpp"
#include "sim/error.hpp"
#include "traces/recorded/record_match.hpp"
#include "traces/recorded/recorded_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>
#include <variant>

namespace rovernet {
namespace {

/// Checks that two runs have the same robots in the same order, since they are compared by NodeId.
void check_same_robots(const RecordedRun& a, const std::string& name_a, const RecordedRun& b,
                       const std::string& name_b) {
    if (a.robots == b.robots) return;
    const auto [one, other] =
        std::mismatch(a.robots.begin(), a.robots.end(), b.robots.begin(), b.robots.end());
    const std::string found = a.robots.size() != b.robots.size()
                                  ? fmt::format("found {} robots, but {} robots in {}",
                                                b.robots.size(), a.robots.size(), name_a)
                                  : fmt::format(
                                        "found the robot \"{}\", but {} has the robot \"{}\" at "
                                        "the same position of the list",
                                        *other, name_a, *one);
    throw InputError(
        {.source = name_b},
        found +
            "; two runs are compared robot by robot: expected the same robots in the same order");
}

std::vector<Delivery> deliveries_of(RecordedReader& trace) {
    const auto deliveries = std::make_shared<Deliveries>();
    trace.read(Sink(deliveries));
    return std::move(deliveries->all);
}

/// Sink that completes changes, which are sorted by delivery, from the records of one run.
struct ChangeSink {
    std::vector<ChangedDelivery>& changes;
    bool is_second;

    KindMask kinds() const { return kind_of<Received>(); }
    void on(const Record& record, const RecordContext& context) {
        for_each_reception(record, context, [&](const auto&... each) { take(each...); });
    }

  private:
    void take(const Delivery& delivery, const Reception& reception) {
        const auto at = std::lower_bound(
            changes.begin(), changes.end(), delivery,
            [](const ChangedDelivery& c, const Delivery& d) { return c.delivery < d; });
        if (at == changes.end() || at->delivery != delivery) return;
        if (at->is_gained != is_second) {
            at->other = reception.fate;
        } else if (reception.delivered) {
            at->time = reception.time;
        }
    }
};

/// Deliveries in only one run, without time and fate; at most `most`, those sent first.
std::vector<ChangedDelivery> changes_of(const DeliveryDifference& difference, std::size_t most) {
    std::vector<ChangedDelivery> changes;
    for (const Delivery& each : difference.gained) changes.push_back({each, true, each.sent});
    for (const Delivery& each : difference.lost) changes.push_back({each, false, each.sent});
    if (changes.size() > most) {
        std::stable_sort(changes.begin(), changes.end(),
                         [](const auto& x, const auto& y) { return x.time < y.time; });
        changes.resize(most);
    }
    std::sort(changes.begin(), changes.end(),
              [](const auto& x, const auto& y) { return x.delivery < y.delivery; });
    return changes;
}

/// Next record of other kinds than `left_out`; null at the end.
const Record* next_of(RecordedReader& trace, KindMask left_out) {
    const Record* record = trace.next();
    while (record && (left_out & KindMask{1} << record->index()) != 0) record = trace.next();
    return record;
}

/// Whether the records of two traces are the same: much faster than the comparison of their text,
/// which tells how they differ.
bool are_equal(const std::string& path_a, const std::string& path_b, KindMask left_out) {
    RecordedReader a(path_a), b(path_b);
    const unsigned format = std::min(a.format(), b.format());
    for (;;) {
        const Record *one = next_of(a, left_out), *other = next_of(b, left_out);
        if (!one || !other) return !one && !other;
        if (!are_same(*one, a.context(), *other, b.context(), format)) return false;
    }
}

TraceDifference first_difference(const std::string& a, const std::string& b, bool motion) {
    if (are_equal(a, b, motion ? KindMask{0} : kind_of<Moved>())) return {};
    const TraceInput::Lines lines{
        .format = Ns2Format::old_format, .mac = MacTrace::on, .motion = motion};
    return diff_ns2(TraceInput(a, lines).text(), TraceInput(b, lines).text(), Duration{0},
                    Ns2Strictness::tolerant, DiffExtent::first_difference);
}

}  // namespace

RunComparison compare_runs(const NamedTrace& a, const NamedTrace& b,
                           const ComparisonChoice& choice) {
    RecordedReader first(a.path), second(b.path);
    check_same_robots(first.run(), a.name, second.run(), b.name);
    const DeliveryDifference difference =
        difference_of(deliveries_of(first), deliveries_of(second));
    RunComparison result{.gained = difference.gained.size(),
                         .lost = difference.lost.size(),
                         .same = difference.same,
                         .changes = changes_of(difference, choice.most_changes),
                         .first = first_difference(a.path, b.path, !choice.is_replay)};
    if (result.changes.empty()) return result;
    RecordedReader(a.path).read(Sink(ChangeSink{result.changes, false}));
    RecordedReader(b.path).read(Sink(ChangeSink{result.changes, true}));
    std::stable_sort(result.changes.begin(), result.changes.end(),
                     [](const auto& x, const auto& y) { return x.time < y.time; });
    return result;
}

}  // namespace rovernet
