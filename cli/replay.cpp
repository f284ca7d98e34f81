// SPDX-License-Identifier: MIT
#include "experiment/replay.hpp"

#include "cli/commands.hpp"
#include "cli/diagnostics.hpp"
#include "cli/options.hpp"
#include "cli/stop.hpp"
#include "cli/waiting.hpp"
#include "scenario/json.hpp"

#include <fmt/format.h>

#include <optional>

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

}  // namespace

void replay(const ReplayArguments& a) {
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

void add_replay(Command app) {
    const auto [replay, a] =
        add_command(app, "replay", "Run the scenario inside a recorded trace again", cli::replay);
    replay.add_examples({"rovernet run examples/patrol/patrol.toml --record",
                         "rovernet replay runs/patrol-s3/trace.mcap --verify"});
    replay.add_option("TRACE", a.file, "recorded trace (.mcap)").required();
    replay.add_flag("--verify", a.verify, "compare every record; exit 1 at the first that differs")
        .required();
    add_json(replay, a.json);
}

}  // namespace rovernet::cli
