// SPDX-License-Identifier: MIT
#include "experiment/replay/replay.hpp"

#include "cli/terminal/diagnostics.hpp"
#include "cli/terminal/options.hpp"
#include "cli/terminal/text_table.hpp"
#include "cli/terminal/waiting.hpp"
#include "cli/traces/assignments.hpp"
#include "cli/traces/replay_inputs.hpp"
#include "cli/traces/trace_commands.hpp"
#include "experiment/replay/ns2_day.hpp"
#include "experiment/replay/trace_input.hpp"
#include "experiment/replay/trace_play.hpp"
#include "experiment/run.hpp"
#include "experiment/summary.hpp"
#include "live/input_replay.hpp"
#include "scenario/document/json.hpp"
#include "study/command_words.hpp"
#include "study/day_store.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rovernet::cli {
namespace {

std::string or_nothing(const std::string& line) { return line.empty() ? "nothing more" : line; }

void print_verification(const ReplayArguments& a, const Verification& v) {
    const bool is_other_version = !v.recorded_by.empty() && v.recorded_by != v.version;
    if (a.json) {
        Table table;
        Array damage;
        for (const std::string& what : v.damage) damage.emplace_back(what);
        table.set("identical", v.is_identical());
        table.set(v.unit, v.same);
        if (!v.damage.empty()) table.set("damage", std::move(damage));
        if (v.difference) {
            table.set("recorded", v.difference->recorded);
            table.set("now", v.difference->now);
        }
        if (!v.recorded_by.empty()) table.set("recorded_by", v.recorded_by);
        table.set("version", v.version);
        fmt::print("{}", to_json(table));
        return;
    }
    if (v.is_identical()) {
        fmt::print("identical: {} {}\n", v.same, v.unit);
    } else if (!v.difference) {
        fmt::print(
            "incomplete: the first {} {} of the trace and of the new run are equal; the rest of "
            "the trace cannot be read\n",
            v.same, v.unit);
    } else {
        fmt::print("different after {} equal {}\nrecorded  {}\nnow       {}\n", v.same, v.unit,
                   or_nothing(v.difference->recorded), or_nothing(v.difference->now));
    }
    if (is_other_version) {
        fmt::print("recorded by {}; this is {}\n", v.recorded_by, v.version);
    } else if (v.difference && !v.recorded_by.empty()) {
        fmt::print("recorded by this version\n");
    }
}

void verify(const ReplayArguments& a) {
    const Verification v = [&] {
        Waiting waiting("replaying " + a.file);
        return verify_replay(a.file, [&](double share) {
            waiting.tell(share);
            return true;
        });
    }();
    for (const std::string& text : v.damage) notice(a.file + ": " + text);
    print_verification(a, v);
    if (v.difference)
        throw CommandEnd(failed, a.file + ": the new run differs from the recorded run");
    if (!v.is_identical()) {
        throw CommandEnd(failed, a.file +
                                     ": the trace is damaged or incomplete, so it is unknown "
                                     "whether the new run equals the recorded run");
    }
}

/// A day, and the radio that all rows of its table are compared with.
struct Radios {
    RecordedDay day;
    std::optional<std::string> as;  ///< assignments of that radio; none: the radio of the day
    /// Name of the row that differences are to: of an ns-2 trace the first that is played, of a
    /// recorded one what it holds.
    std::string first;
    bool plays_first = false;
};

void append(std::vector<std::string>& set, const std::optional<std::string>& with) {
    if (!with) return;
    for (std::string& each : assignments(*with)) set.push_back(std::move(each));
}

PlayedDay play_radio(const ReplayArguments& a, const RecordedDay& day,
                     const std::vector<std::string>& set, const std::string& name) {
    Waiting waiting("replaying " + a.file + " with " + name);
    return day.play(set, [&](double share) {
        waiting.tell(share);
        return true;
    });
}

Radios radios_of(const ReplayArguments& a) {
    if (is_recorded_trace(a.file)) {
        if (!a.as && !a.routing && !a.movements) {
            return {.day = RecordedDay(a.file), .as = {}, .first = "as recorded"};
        }
        throw CommandEnd(usage,
                         "replay: --as, --routing and --movements are for ns-2 traces; a recorded "
                         "trace contains its radio, protocol and positions");
    }
    const bool is_direct = a.routing == "direct";
    return {
        .day = read_ns2_day(a.file, {.routing = is_direct ? DayRouting::direct : DayRouting::flood,
                                     .movements = a.movements}),
        .as = a.as,
        .first = a.as.value_or("two_ray, 914 MHz, 250 m"),
        .plays_first = true};
}

/// A row to be played: its name and its assignments.
struct RadioRow {
    std::string name;
    std::vector<std::string> set;
};

/// Rows of the table but for what was recorded; the one that others are compared with comes first.
std::vector<RadioRow> rows_of(const ReplayArguments& a, const Radios& radios) {
    std::vector<RadioRow> rows;
    if (radios.plays_first) {
        rows.push_back({radios.first, {}});
        append(rows.back().set, radios.as);
    }
    std::vector<std::string> names = a.with;
    if (names.empty() && a.map) names.push_back("map " + *a.map);
    for (const std::string& name : names) {
        rows.push_back({name, {}});
        append(rows.back().set, radios.as);
        if (!a.with.empty()) append(rows.back().set, name);
        if (a.map)
            rows.back().set.push_back("scene.map=" + std::filesystem::absolute(*a.map).string());
    }
    return rows;
}

/// Notices what the rows cannot show: messages that collide since they begin together, and
/// receptions that the first radio cannot have had.
void note_doubts(const ReplayArguments& a, const Radios& radios,
                 const std::vector<RadioRow>& rows) {
    std::vector<std::string> told;
    const auto tell = [&](const std::string& text, const std::string& row) {
        if (text.empty() || std::ranges::find(told, text) != told.end()) return;
        told.push_back(text);
        notice(fmt::format("{}: row \"{}\": {}", a.file, row, text));
    };
    for (const RadioRow& row : rows) tell(radios.day.starts_together(row.set), row.name);
    if (radios.plays_first) tell(radios.day.hears_farther(rows[0].set), rows[0].name);
}

std::vector<DayRow> play_radios(const ReplayArguments& a, const Radios& radios,
                                const std::vector<RadioRow>& rows) {
    std::vector<DayRow> played;
    for (const RadioRow& row : rows) {
        PlayedDay day = play_radio(a, radios.day, row.set, row.name);
        if (played.empty() && radios.plays_first) {
            played.push_back({row.name, std::move(day), {}});
            continue;
        }
        const PlayedDay& first = radios.plays_first ? played[0].day : radios.day.recorded();
        DeliveryChange change = change_of(first, day, radios.day.robots().size());
        played.push_back({row.name, std::move(day), std::move(change)});
    }
    return played;
}

Table row_table(const std::string& name, const PlayedDay& day) {
    Table table;
    table.set("with", name);
    append_metrics(table, day.metrics);
    return table;
}

Table row_table(const RecordedDay& day, const DayRow& radio) {
    Table table = row_table(radio.radio, radio.day);
    if (!radio.change) return table;
    table.set("gained", radio.change->all_gained());
    table.set("lost", radio.change->all_lost());
    Array robots;
    for (std::size_t i = 0; i < day.robots().size(); ++i) {
        Table robot;
        robot.set("robot", day.robots()[i]);
        robot.set("gained", radio.change->gained[i]);
        robot.set("lost", radio.change->lost[i]);
        robots.emplace_back(std::move(robot));
    }
    table.set("robots", std::move(robots));
    return table;
}

void print_radios_json(const RecordedDay& day, const std::vector<DayRow>& radios) {
    Array rows;
    for (const DayRow& radio : radios) rows.emplace_back(row_table(day, radio));
    Table table;
    table.set("recorded", row_table("as recorded", day.recorded()));
    table.set("radios", std::move(rows));
    fmt::print("{}", to_json(table));
}

std::string ratio_text(const MetricValues& metrics) {
    return metrics.delivery_ratio ? fmt::format("{:.4f}", *metrics.delivery_ratio) : "-";
}

std::string difference_text(const MetricValues& now, const MetricValues& before) {
    if (!now.delivery_ratio || !before.delivery_ratio) return "-";
    return fmt::format("{:+.4f}", *now.delivery_ratio - *before.delivery_ratio);
}

void print_rows(const Radios& radios, const std::vector<DayRow>& rows) {
    TextTable table({"radio", "deliveries", "delivery_ratio", "difference", "gained", "lost"});
    const MetricValues& recorded = radios.day.recorded().metrics;
    const MetricValues& first = radios.plays_first ? rows[0].day.metrics : recorded;
    const auto add_first = [&](const std::string& name, const MetricValues& m) {
        table.add({name, std::to_string(m.deliveries), ratio_text(m), "-", "-", "-"});
    };
    add_first("as recorded", recorded);
    for (const DayRow& row : rows) {
        const MetricValues& m = row.day.metrics;
        if (!row.change) {
            add_first(row.radio, m);
            continue;
        }
        table.add({row.radio, std::to_string(m.deliveries), ratio_text(m),
                   difference_text(m, first), std::to_string(row.change->all_gained()),
                   std::to_string(row.change->all_lost())});
    }
    fmt::print("{}", table.text());
}

void print_robots(const RecordedDay& day, const std::vector<DayRow>& rows) {
    TextTable robots({"radio", "robot", "gained", "lost"});
    bool is_changed = false;
    for (const DayRow& row : rows) {
        for (std::size_t i = 0; row.change && i < day.robots().size(); ++i) {
            const std::uint64_t gained = row.change->gained[i], lost = row.change->lost[i];
            if (gained + lost == 0) continue;
            robots.add({row.radio, day.robots()[i], std::to_string(gained), std::to_string(lost)});
            is_changed = true;
        }
    }
    if (is_changed) fmt::print("\n{}", robots.text());
}

void print_radios(const ReplayArguments& a, const Radios& radios, const std::vector<DayRow>& rows) {
    print_rows(radios, rows);
    print_robots(radios.day, rows);
    fmt::print(
        "\nRobots move and send as in the trace, whatever the new radio receives.\nThe columns "
        "\"difference\", \"gained\" and \"lost\" compare each row with the row \"{}\".\n",
        radios.first);
    if (!radios.plays_first) return;
    fmt::print(
        "The protocol of the trace is not simulated: {}.\n",
        a.routing == "direct" ? "messages go directly to their destinations" : "messages flood");
}

/// The command of these rows, but for what makes each of them.
std::string command_of(const ReplayArguments& a) {
    std::vector<std::string> words = {"rovernet", "replay", a.file};
    const auto add = [&](const char* option, const std::optional<std::string>& value) {
        if (value) words.insert(words.end(), {option, *value});
    };
    add("--map", a.map);
    add("--as", a.as);
    add("--routing", a.routing);
    add("--movements", a.movements);
    return shell_command(words);
}

void keep_rows(const ReplayArguments& a, const Radios& radios, const std::vector<DayRow>& rows) {
    StoredReplay replay{.command = command_of(a),
                        .first = radios.first,
                        .robots = radios.day.robots(),
                        .rows = rows};
    replay.rows.insert(replay.rows.begin(), {"as recorded", radios.day.recorded(), {}});
    store_replay(*a.store, replay);
}

void play_with(const ReplayArguments& a) {
    const Radios radios = radios_of(a);
    for (const std::string& text : radios.day.notices()) notice(a.file + ": " + text);
    const std::vector<RadioRow> to_play = rows_of(a, radios);
    note_doubts(a, radios, to_play);
    const std::vector<DayRow> rows = play_radios(a, radios, to_play);
    if (a.store) keep_rows(a, radios, rows);
    if (a.json) {
        print_radios_json(radios.day, rows);
    } else {
        print_radios(a, radios, rows);
    }
}

void play_events(const ReplayArguments& a) {
    const TraceInput trace(a.file, {.format = Ns2Format::old_format, .mac = {}});
    play_trace(trace.text(), *a.speed,
               {.show = [](std::string_view line) { fmt::print("{}\n", line); },
                .goes_on =
                    [] {
                        std::fflush(stdout);
                        return true;
                    }});
    for (const std::string& text : trace.damage()) notice(a.file + ": " + text);
}

}  // namespace

std::vector<std::string> assignments(const std::string& with) {
    std::vector<std::string> each;
    for (std::size_t begin = 0; begin <= with.size();) {
        const std::size_t end = std::min(with.find(';', begin), with.size());
        each.push_back(with.substr(begin, end - begin));
        begin = end + 1;
    }
    return each;
}

void replay(const ReplayArguments& a) {
    if (a.verify && has_input_log(a.file)) return verify_inputs(a);
    if (a.verify) return verify(a);
    if (a.speed) return play_events(a);
    if (a.with.empty() && !a.map && !a.as) {
        throw CommandEnd(usage, "replay: expected --verify, --speed, --with, --map or --as");
    }
    play_with(a);
}

void add_replay(Command app) {
    const auto [replay, a] = add_command(
        app, "replay", "Play a trace again, unchanged or with a different radio", cli::replay);
    replay.add_examples(
        {"rovernet run examples/patrol/patrol.toml --record",
         "rovernet replay runs/patrol-s3/trace.mcap --verify",
         "rovernet replay runs/patrol-s3/trace.mcap --with propagation.model=friis --with "
         "\"radio.power=20 dBm\"",
         "rovernet replay runs/patrol-s3/trace.mcap --speed x100",
         "rovernet run examples/rescue/rescue.toml --set trace.ns2=old --out rescue",
         "rovernet replay rescue/trace.tr --verify",
         "rovernet replay rescue/trace.tr --with \"radio.power=10 dBm\""});
    replay
        .add_option("TRACE", a.file,
                    "recorded trace (.mcap), ns-2 trace, or (with --verify) folder of a live run")
        .required();
    const Option verify = replay.add_flag("--verify", a.verify,
                                          "run the scenario of the trace again and compare the "
                                          "records; exit code 1 at the first difference");
    const Option speed =
        replay
            .add_option(
                "--speed", a.speed,
                "print the events at this speed: 1 is real time, 2 (or x2) is twice as fast")
            .transform([](const std::string& text) {
                return text.starts_with('x') ? text.substr(1) : text;
            })
            .check(speed_of_time())
            .excludes(verify);
    replay
        .add_option("--with", a.with,
                    "KEY=VALUE of a different radio or model (several are separated by \";\"); "
                    "robots move and send messages as in the trace")
        .one_word()
        .excludes(verify)
        .excludes(speed);
    const auto add = [&, command = replay](const char* name, std::optional<std::string>& value,
                                           const char* what) {
        return command.add_option(name, value, what).excludes(verify).excludes(speed);
    };
    add("--map", a.map, "map (.yaml, .png) to use instead of the recorded map");
    add("--as", a.as,
        "for an ns-2 trace: radio with which the radios of --with are compared, given as KEY=VALUE "
        "like --with");
    add("--routing", a.routing,
        "for an ns-2 trace: way in which the replay forwards messages, flood or direct (one hop to "
        "the destination; default: flood)")
        .one_of({"flood", "direct"});
    add("--movements", a.movements, "for an ns-2 trace: movement file of its robots");
    add("--store", a.store,
        "also write the results to this file, which rovernet results and rovernet plot read");
    add_json(replay, a.json);
}

}  // namespace rovernet::cli
