// SPDX-License-Identifier: MIT
#include "experiment/replay.hpp"

#include "cli/commands.hpp"
#include "cli/diagnostics.hpp"
#include "cli/options.hpp"
#include "cli/stop.hpp"
#include "cli/text_table.hpp"
#include "cli/waiting.hpp"
#include "experiment/run.hpp"
#include "scenario/json.hpp"
#include "study/recorded_day.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rovernet::cli {
namespace {

std::string or_nothing(const std::string& line) { return line.empty() ? "nothing more" : line; }

void print_verification(const ReplayArguments& a, const Verification& v) {
    const bool is_other_version = v.recorded_by != v.version;
    if (a.json) {
        Table table;
        table.set("identical", !v.difference.has_value());
        table.set("records", v.records);
        if (v.difference) {
            table.set("recorded", v.difference->recorded);
            table.set("now", v.difference->now);
        }
        table.set("recorded_by", v.recorded_by);
        table.set("version", v.version);
        fmt::print("{}", to_json(table));
        return;
    }
    if (!v.difference) {
        fmt::print("identical: {} records\n", v.records);
    } else {
        fmt::print("different after {} records\nrecorded  {}\nnow       {}\n", v.records,
                   or_nothing(v.difference->recorded), or_nothing(v.difference->now));
    }
    if (is_other_version) {
        fmt::print("recorded by {}; this is {}\n", v.recorded_by, v.version);
    } else if (v.difference) {
        fmt::print("recorded by this version\n");
    }
}

void verify(const ReplayArguments& a) {
    const Verification v = [&] {
        Waiting waiting("replaying " + a.file);
        const HeldStop replaying;
        return verify_replay(a.file, [&](double share) {
            waiting.tell(share);
            return stops_asked() == 0;
        });
    }();
    for (const std::string& text : v.damage) notice(a.file + ": " + text);
    print_verification(a, v);
    if (v.difference) throw CommandEnd(failed, a.file + ": the run differs from its trace");
}

/// The day under one radio, and how it differs from the recorded one.
struct OtherRadio {
    std::string name;
    PlayedDay day;
    DeliveryChange change;
};

/// Assignments of one --with: "a=1;b=2".
std::vector<std::string> assignments(const std::string& with) {
    std::vector<std::string> each;
    for (std::size_t begin = 0; begin <= with.size();) {
        const std::size_t end = std::min(with.find(';', begin), with.size());
        each.push_back(with.substr(begin, end - begin));
        begin = end + 1;
    }
    return each;
}

std::vector<OtherRadio> play_radios(const ReplayArguments& a, const RecordedDay& day) {
    std::vector<std::string> radios = a.with;
    if (radios.empty()) radios.emplace_back();  // --map alone
    std::vector<OtherRadio> played;
    const HeldStop replaying;
    for (const std::string& radio : radios) {
        std::vector<std::string> set;
        if (!radio.empty()) set = assignments(radio);
        if (a.map) set.push_back("scene.map=" + std::filesystem::absolute(*a.map).string());
        Waiting waiting("replaying " + a.file + " with " + radio);
        OtherRadio row{radio.empty() ? "map " + *a.map : radio, {}, {}};
        row.day = day.play(set, [&](double share) {
            waiting.tell(share);
            return stops_asked() == 0;
        });
        row.change = change_of(day.recorded(), row.day, day.robots().size());
        played.push_back(std::move(row));
    }
    return played;
}

Table row_table(const std::string& name, const PlayedDay& day) {
    Table table;
    table.set("with", name);
    append_metrics(table, day.metrics);
    return table;
}

void print_radios_json(const RecordedDay& day, const std::vector<OtherRadio>& radios) {
    Array rows;
    for (const OtherRadio& radio : radios) {
        Table table = row_table(radio.name, radio.day);
        table.set("gained", radio.change.all_gained());
        table.set("lost", radio.change.all_lost());
        Array robots;
        for (std::size_t i = 0; i < day.robots().size(); ++i) {
            Table robot;
            robot.set("robot", day.robots()[i]);
            robot.set("gained", radio.change.gained[i]);
            robot.set("lost", radio.change.lost[i]);
            robots.emplace_back(std::move(robot));
        }
        table.set("robots", std::move(robots));
        rows.emplace_back(std::move(table));
    }
    Table table;
    table.set("recorded", row_table("as recorded", day.recorded()));
    table.set("radios", std::move(rows));
    fmt::print("{}", to_json(table));
}

std::string ratio_text(const PlayedDay& day) {
    const auto& ratio = day.metrics.delivery_ratio;
    return ratio ? fmt::format("{:.4f}", *ratio) : "-";
}

void print_radios(const RecordedDay& day, const std::vector<OtherRadio>& radios) {
    TextTable table({"radio", "deliveries", "delivery_ratio", "difference", "gained", "lost"});
    const MetricValues& before = day.recorded().metrics;
    table.add({"as recorded", std::to_string(before.deliveries), ratio_text(day.recorded()), "-",
               "-", "-"});
    for (const OtherRadio& radio : radios) {
        const MetricValues& now = radio.day.metrics;
        const bool is_known = now.delivery_ratio && before.delivery_ratio;
        table.add(
            {radio.name, std::to_string(now.deliveries), ratio_text(radio.day),
             is_known ? fmt::format("{:+.4f}", *now.delivery_ratio - *before.delivery_ratio) : "-",
             std::to_string(radio.change.all_gained()), std::to_string(radio.change.all_lost())});
    }
    fmt::print("{}", table.text());
    TextTable robots({"radio", "robot", "gained", "lost"});
    bool is_changed = false;
    for (const OtherRadio& radio : radios) {
        for (std::size_t i = 0; i < day.robots().size(); ++i) {
            const std::uint64_t gained = radio.change.gained[i], lost = radio.change.lost[i];
            if (gained + lost == 0) continue;
            robots.add({radio.name, day.robots()[i], std::to_string(gained), std::to_string(lost)});
            is_changed = true;
        }
    }
    if (is_changed) fmt::print("\n{}", robots.text());
    fmt::print(
        "\nRobots move and speak as they did; what they would decide otherwise is not "
        "decided anew.\n");
}

void play_with(const ReplayArguments& a) {
    const RecordedDay day(a.file);
    for (const std::string& text : day.damage()) notice(a.file + ": " + text);
    const std::vector<OtherRadio> radios = play_radios(a, day);
    if (a.json) {
        print_radios_json(day, radios);
    } else {
        print_radios(day, radios);
    }
}

}  // namespace

void replay(const ReplayArguments& a) {
    if (a.verify) return verify(a);
    if (a.with.empty() && !a.map) {
        throw CommandEnd(usage, "replay: expected --verify, --with or --map");
    }
    play_with(a);
}

void add_replay(Command app) {
    const auto [replay, a] =
        add_command(app, "replay", "Play a recorded trace again, as it was or under another radio",
                    cli::replay);
    replay.add_examples(
        {"rovernet run examples/patrol/patrol.toml --record",
         "rovernet replay runs/patrol-s3/trace.mcap --verify",
         "rovernet replay runs/patrol-s3/trace.mcap --with propagation.model=friis --with "
         "\"radio.power=20 dBm\""});
    replay.add_option("TRACE", a.file, "recorded trace (.mcap)").required();
    const Option verify = replay.add_flag("--verify", a.verify,
                                          "compare every record; exit 1 at the first that differs");
    replay
        .add_option("--with", a.with,
                    "key=value of another radio, or several between \";\": the robots move and "
                    "speak as they did")
        .one_word()
        .excludes(verify);
    replay.add_option("--map", a.map, "map (.yaml, .png) in place of the recorded one")
        .excludes(verify);
    add_json(replay, a.json);
}

}  // namespace rovernet::cli
