// SPDX-License-Identifier: MIT
#include "experiment/replay/recorded_stats.hpp"

#include "experiment/replay/recorded_follow.hpp"
#include "experiment/run.hpp"
#include "models/access/wifi_frames.hpp"
#include "scenario/scenario_file.hpp"
#include "sim/error.hpp"
#include "test/traces/record_stream.hpp"
#include "traces/recorded/recorded_reader.hpp"
#include "traces/recorded/recorded_trace.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace recorded_stats_test {
using namespace rovernet;
using namespace rovernet::testing;

namespace {

std::string text_of(const TraceRow& r) {
    return fmt::format("{} {} {} {} {} {} {} {} {}", r.name, r.messages, r.expected, r.deliveries,
                       r.bytes, r.delay_ns, r.transmissions, r.receptions, r.drops);
}

std::string text_of(std::optional<double> value) { return value ? fmt::format("{}", *value) : "-"; }

std::string text_of(const Ns2Counts& counts) {
    std::string text =
        fmt::format("{} {} {} {}\n", counts.lines, counts.events, counts.refused, counts.format());
    for (const Ns2RefusedLine& line : counts.refused_lines) {
        text += fmt::format("{} {} {} {}\n", line.line, line.column, line.why, line.text);
    }
    for (const std::uint64_t skipped : counts.skipped) text += fmt::format("{} ", skipped);
    return text;
}

/// Everything that is counted, as text.
std::string text_of(const RecordedStats& told) {
    const TraceStats& s = told.stats;
    const MetricValues& m = s.metrics;
    std::string text =
        fmt::format("{} {} {} {} {} {}\n{} {} {} {} {} {} {}\n", m.messages, m.cut_off,
                    m.transmissions, m.receptions, m.deliveries, text_of(m.mean_hops),
                    s.routing_packets, s.routing_bytes, s.delivered_bytes, text_of(s.jitter_mean),
                    text_of(s.jitter_rfc3550), text_of(s.jitter_sd), text_of(s.throughput));
    text += text_of(s.counts) + '\n';
    for (const auto& [reason, count] : s.drops) text += fmt::format("{} {}\n", reason, count);
    for (const auto& [place, count] : s.drops_by_layer) {
        text += fmt::format("{}.{} {}\n", place.first, place.second, count);
    }
    for (const TraceRow& row : s.rows) text += text_of(row) + '\n';
    text += fmt::format("{} {}\n", told.receptions, told.file_bytes);
    for (const std::string& damage : told.damage) text += damage + '\n';
    return text;
}

std::string text_of(const RecordedWay& found) {
    const FollowedMessage& w = found.way;
    std::string text =
        fmt::format("{} {} {} {} {} {} {} {}\n", w.uid, w.type, w.origin.value, w.to.value_or(77),
                    w.sent.time_since_epoch().count(), w.size, w.ttl, w.counts.refused);
    for (const FollowedRobot& r : w.robots) {
        text += fmt::format("{} {} {} {} {} {}", r.robot.value, r.depth,
                            r.from.value_or(everyone).value, r.time.time_since_epoch().count(),
                            r.is_delivered, r.copies);
        for (const Time t : r.on_air) text += fmt::format(" {}", t.time_since_epoch().count());
        text += '\n';
    }
    for (const LostCopy& l : w.lost) {
        text += fmt::format("{} {} {} {} {}\n", l.time.time_since_epoch().count(), l.robot.value,
                            l.from.value_or(everyone).value, l.layer, l.reason);
    }
    for (const NodeId node : w.without) text += fmt::format("{} ", node.value);
    for (const std::string& name : found.robots) text += name + ' ';
    for (const std::string& damage : found.damage) text += damage + '\n';
    return text;
}

/// The text, or the error.
template <class Make>
std::string told(Make make) {
    try {
        return text_of(make());
    } catch (const InputError& error) {
        return std::string("error: ") + error.what();
    }
}

/// Checks that both ways of reading the trace tell the same. What the strictness decides is in how
/// lines are read, not in what is made of them: strict reading makes no rows and follows two
/// messages.
void check_both_ways(const std::string& path, std::uint64_t messages) {
    const auto check_stats = [&](Ns2Strictness strictness, TraceRows rows) {
        CHECK(told([&] { return recorded_stats(path, strictness, rows); }) ==
              told([&] { return recorded_stats_of_text(path, strictness, rows); }));
    };
    const auto check_path = [&](Ns2Strictness strictness, std::uint64_t uid) {
        CHECK(told([&] { return follow_recorded(path, uid, strictness); }) ==
              told([&] { return follow_recorded_text(path, uid, strictness); }));
    };
    for (const auto rows : {TraceRows::none, TraceRows::robot, TraceRows::flow, TraceRows::second})
        check_stats(Ns2Strictness::tolerant, rows);
    for (std::uint64_t uid = 0; uid <= messages; ++uid) check_path(Ns2Strictness::tolerant, uid);
    check_stats(Ns2Strictness::strict, TraceRows::none);
    for (const std::uint64_t uid : {std::uint64_t{0}, messages})
        check_path(Ns2Strictness::strict, uid);
}

/// Records of any kind with any values, for a trace that no run has written.
class OddRecords {
  public:
    OddRecords(Stream& stream, unsigned seed, int odds)
        : stream_(stream), draw_(seed), odds_(odds) {}

    void run(int records) {
        for (int i = 0; i < 6; ++i) {
            stream_.place(Vec3{1.0 * i, 2, 0});
            add_message();
        }
        for (int i = 0; i < records; ++i) step();
    }

  private:
    std::uint32_t below(std::size_t n) { return static_cast<std::uint32_t>(draw_() % n); }
    bool is_odd() { return odds_ > 0 && below(static_cast<std::size_t>(odds_)) == 0; }
    NodeId robot() { return NodeId{is_odd() ? (1U << 20) + below(9) : below(6)}; }
    NodeId robot_or_everyone() { return below(3) == 0 ? everyone : robot(); }
    Time time() {
        if (is_odd()) return Time{Duration{9'210'000'000'000'000'000}};
        return now_ += Duration{below(400'000'000)};
    }
    void add_message() {
        // The last three kinds are such as no run has.
        static constexpr std::array<std::string_view, 9> kinds{
            "", "", "", "AODV", "error", "ack", "message", "a b", "ARP"};
        const std::string_view kind = kinds[below(is_odd() ? 9 : 6)];
        NodeId origin{below(6)}, to{below(6)};
        if (kind.empty() && origin == to) to = everyone;
        messages_.push_back(stream_.messages.add({.origin = origin,
                                                  .uid = messages_.size() - (is_odd() ? 1 : 0),
                                                  .number = 0,
                                                  .to = to,
                                                  .key = 0,
                                                  .size = below(2000),
                                                  .created = now_,
                                                  .payload = {},
                                                  .kind = kind}));
    }
    Frame frame() {
        return {.message = messages_[below(messages_.size())],
                .sender = NodeId{below(6)},
                .ttl = static_cast<Hops>(below(5)),
                .hops = static_cast<Hops>(below(5)),
                .next_hop = robot_or_everyone()};
    }
    AirFrame air() {
        return {.frame = frame(),
                .heard_from = below(2) == 0 ? std::nullopt : std::optional(NodeId{below(6)}),
                .control = std::array<const ControlFrame*, 4>{nullptr, &wifi_rts, &wifi_cts,
                                                              &wifi_ack}[below(4)],
                .reserved = Duration{below(3'000'000)}};
    }
    Reception reception() { return {time(), robot(), static_cast<Fate>(below(8)), below(2) == 0}; }
    void send() {
        add_message();
        const MessageId id = is_odd() ? messages_[below(messages_.size())] : messages_.back();
        if (!stream_.messages[id].kind.empty() && !is_odd()) return;
        std::optional<std::uint32_t> reachable;
        if (below(2) == 0) reachable = is_odd() ? 1U << 20 : below(6);
        stream_.emit(Sent{time(), robot(), id, 9, 6, reachable});
    }
    void step() {
        switch (below(9)) {
            case 0: return send();
            case 1:
                return stream_.emit(
                    Transmitted{time(), frame(),
                                below(2) == 0 ? std::nullopt : std::optional(NodeId{below(6)})});
            case 2:
                return stream_.emit(
                    Dropped{time(), robot(), frame(), static_cast<DropReason>(below(6))});
            case 3: return stream_.emit(AirSent{time(), air(), 2000 + below(100)});
            case 4: return stream_.emit(ControlReceived{air(), reception(), below(100)});
            case 5: return stream_.emit(Switched{time(), NodeId{below(6)}, below(2) == 0});
            case 6: return stream_.emit(Moved{time(), NodeId{below(6)}, Leg{.start = now_}});
            default: break;
        }
        const Frame of = frame();
        std::vector<Reception> receptions(below(6));
        for (Reception& rx : receptions) rx = reception();
        stream_.emit(Received{of, receptions, Duration{below(3'000'000)}, below(60)});
    }

    Stream& stream_;
    std::mt19937 draw_;
    int odds_;
    Time now_{};
    std::vector<MessageId> messages_;
};

/// Writes a trace of a network that was made in code.
void record(const std::string& path, const std::function<void(Stream&)>& run) {
    Stream stream;
    const auto trace = std::make_shared<RecordedTrace>(
        path, RecordedTrace::Contents{.version = "1", .chunk = 3'000});
    trace->begin({.scenario = {},
                  .robots = 6,
                  .name = [](NodeId) -> std::string_view { return "r"; },
                  .seed = 1,
                  .replication = 0});
    stream.sinks = {Sink(trace)};
    run(stream);
    trace->finish();
    trace->close();
}

/// Robots that flood, send unicasts behind requests to send, and lose frames.
const char* const crowd = R"(
[scenario]
duration = "4 s"
[study]
warmup = "1 s"
[access]
model = "ACCESS"
[[robot]]
count = 12
name = "r"
place = { model = "uniform", area = [["0 m", "0 m"], ["90 m", "90 m"]] }
move = { model = "random_waypoint", area = [["0 m", "0 m"], ["90 m", "90 m"]], min_speed = "1 m/s", max_speed = "3 m/s" }
[[traffic]]
from = "random"
every = "20 ms"
size = "200 B"
[[traffic]]
from = "r0"
kind = "unicast"
to = "r1"
every = "150 ms"
size = "900 B"
)";

}  // namespace

TEST_CASE(
    "recorded trace: counts and message paths of a run equal those of the same trace in text") {
    for (const std::string access : {"csma\"\nrts_threshold = \"300 B", "csma", "aloha"}) {
        CAPTURE(access);
        const TempFolder folder;
        std::string text = crowd;
        text.replace(text.find("ACCESS"), 6, access);
        write_file(folder / "crowd.toml", text);
        run_scenario(load_scenario(folder / "crowd.toml", {.set = {"trace.record=true"}}),
                     {.folder = folder / "out", .speed = {}});
        check_both_ways(folder / "out/trace.mcap", 5);
        CHECK(recorded_stats(folder / "out/trace.mcap").stats.counts.refused == 0);
    }
}

TEST_CASE(
    "recorded trace: counts and paths of random records equal those of the same trace in text") {
    const TempFolder folder;
    for (unsigned seed = 0; seed < 6; ++seed) {
        CAPTURE(seed);
        record(folder / "plain.mcap",
               [&](Stream& stream) { OddRecords(stream, seed, 0).run(400); });
        check_both_ways(folder / "plain.mcap", 8);
        record(folder / "odd.mcap",
               [&](Stream& stream) { OddRecords(stream, seed, 300).run(400); });
        check_both_ways(folder / "odd.mcap", 8);
        record(folder / "random.mcap",
               [&](Stream& stream) { RandomRecords(stream, seed).run(6, 300); });
        check_both_ways(folder / "random.mcap", 4);
    }
}

TEST_CASE(
    "recorded trace: a second record that sends the same message is refused, as in a trace in "
    "text") {
    const TempFolder folder;
    record(folder / "trace.mcap", [](Stream& stream) {
        const NodeId a = stream.place(Vec3{}), b = stream.place(Vec3{1, 0, 0});
        const MessageId id = stream.send(at(5), a, 3);
        stream.receive(frame(id, a, 3, 1), {{at(9), b, Fate::waiting, true}});
        stream.emit(Sent{at(20), b, id, 3, 2, {}});
    });
    check_both_ways(folder / "trace.mcap", 1);
    CHECK(recorded_stats(folder / "trace.mcap").stats.counts.refused == 1);
}

TEST_CASE(
    "recorded trace: if chunks are damaged, counts and paths still equal those of the same trace "
    "in text") {
    const TempFolder folder;
    const std::string path = folder / "trace.mcap";
    record(path, [](Stream& stream) { OddRecords(stream, 1, 0).run(900); });
    const std::string whole = content(path);
    for (std::size_t i = 1; i < 12; ++i) {
        CAPTURE(i);
        std::string broken = whole;
        const std::size_t at = broken.size() * i / 12;
        broken[at] = static_cast<char>(broken[at] ^ 0x41);
        write_file(path, broken);
        check_both_ways(path, 3);
        write_file(path, whole.substr(0, at));
        check_both_ways(path, 3);
    }
}

TEST_CASE(
    "recorded trace: the table by robot has a row also for a robot at which nothing happened") {
    const TempFolder folder;
    testing::write_file(folder / "s.toml", R"([scenario]
name = "far"
duration = "3 s"
[propagation]
model = "disc"
range = "50 m"
[trace]
record = true
ns2 = "old"
[[robot]]
name = "A"
at = ["0 m", "0 m"]
[[robot]]
name = "C"
at = ["900 m", "0 m"]
[[traffic]]
from = "A"
payload = "F"
)");
    run_scenario(load_scenario(folder / "s.toml", {}), {.folder = folder / "out", .speed = {}});
    const auto rows_of = [](const TraceStats& stats) {
        std::vector<std::string> names;
        for (const TraceRow& row : stats.rows) names.push_back(row.name);
        return names;
    };
    const std::vector<std::string> both{"0", "1"};
    const auto tolerant = Ns2Strictness::tolerant;
    const std::string recorded = folder / "out/trace.mcap", text = folder / "out/trace.tr";
    CHECK(rows_of(recorded_stats(recorded, tolerant, TraceRows::robot).stats) == both);
    CHECK(rows_of(ns2_stats(text, tolerant, TraceRows::robot)) == both);
    check_both_ways(recorded, 1);
}

}  // namespace recorded_stats_test
