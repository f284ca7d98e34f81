// SPDX-License-Identifier: MIT
#include "scenario/equal_starts.hpp"

#include "scenario/affected.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <vector>

namespace rovernet {
namespace {

/// Instants at which a flow sends: `count` of them from `first` on.
struct Instants {
    Duration first, every;
    std::int64_t count;

    bool has(Duration t, Duration apart) const {
        const std::int64_t before = (t - first) / std::max(every, Duration{1});
        for (const std::int64_t i : {before, before + 1}) {
            const std::int64_t n = std::clamp<std::int64_t>(i, 0, count - 1);
            if (std::chrono::abs(first + n * every - t) <= apart) return true;
        }
        return false;
    }
};

Instants instants_of(const Scenario& scenario, const TrafficTable& flow) {
    const Duration first = *flow.start, every = flow.every.value_or(Duration{0});
    const Duration end =
        std::min(scenario.scenario.duration, flow.stop.value_or(scenario.scenario.duration));
    if (every == Duration{0}) return {first, every, 1};
    const std::int64_t most = end > first ? (end - first - Duration{1}) / every + 1 : 1;
    return {first, every, std::min<std::int64_t>(most, flow.count.value_or(most))};
}

/// Whether a quarter of the messages of the shorter flow (of its first 1,000) start together with a
/// message of the other flow.
bool are_together(const Instants& a, const Instants& b, Duration apart) {
    const Instants &few = a.count < b.count ? a : b, &many = a.count < b.count ? b : a;
    const std::int64_t messages = std::min<std::int64_t>(few.count, 1000);
    std::int64_t met = 0;
    for (std::int64_t i = 0; i < messages; ++i) met += many.has(few.first + i * few.every, apart);
    return 4 * met >= messages;
}

std::uint32_t bytes_of(const TrafficTable& flow) {
    return flow.size ? flow.size->value : static_cast<std::uint32_t>(flow.payload.size());
}

}  // namespace

Duration collision_free_gap(const Scenario& scenario, std::uint32_t bytes) {
    if (scenario.reception.as<Threshold>()) return Duration{0};
    const Radio& radio = scenario.radio;
    const Csma* csma = scenario.access.as<Csma>();
    if (!csma) return radio.preamble + from_seconds(8.0 * bytes / radio.rate.value);
    if (!csma->sends_at_once()) return Duration{0};
    const WifiTiming timing = csma->timing();
    return timing.cca_time + timing.turnaround + Duration{1};
}

void note_equal_starts(Scenario& out) {
    constexpr std::size_t most_flows = 100;
    const bool repeats = out.access.as<Csma>();
    std::vector<const TrafficTable*> flows;
    for (const TrafficTable& flow : out.traffic)
        if (!flow.saturate && flow.start && flows.size() < most_flows) flows.push_back(&flow);
    Affected together;
    for (std::size_t i = 0; i < flows.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            const TrafficTable &a = *flows[k], &b = *flows[i];
            const bool one_sender = a.from == b.from && a.from != "random";
            // csma repeats unicasts after a backoff, but not a broadcast.
            const bool all_repeated = repeats && a.kind == TrafficKind::unicast && b.kind == a.kind;
            if (one_sender || all_repeated) continue;
            const std::uint32_t bytes = std::max(bytes_of(a), bytes_of(b));
            const Duration apart = collision_free_gap(out, bytes);
            if (apart == Duration{0}) return;
            if (!are_together(instants_of(out, a), instants_of(out, b), apart - Duration{1}))
                continue;
            together.add([&] {
                return fmt::format(
                    "{}: the flows from \"{}\" and \"{}\" send messages at the same times, or at "
                    "most {:g} s apart; [access] model = \"{}\" does not keep the frames of these "
                    "flows apart, so robots in range of both senders lose both frames; expected "
                    "different start times{}",
                    b.from_where.text(), a.from, b.from, seconds(apart), out.access.name(),
                    repeats ? ", or [access] immediate_access = false, with which each sender "
                              "first waits for a random backoff"
                            : "");
            });
            break;
        }
    }
    together.note(out.notices);
}

}  // namespace rovernet
