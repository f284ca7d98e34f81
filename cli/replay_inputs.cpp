// SPDX-License-Identifier: MIT
#include "cli/replay_inputs.hpp"

#include "cli/diagnostics.hpp"
#include "cli/stop.hpp"
#include "cli/waiting.hpp"
#include "experiment/version.hpp"
#include "live/input_log.hpp"
#include "scenario/json.hpp"

#include <fmt/format.h>

namespace rovernet::cli {
namespace {

void print_inputs(const ReplayArguments& a, const InputReplay& replay) {
    const bool is_identical = replay.recorded == replay.now;
    if (a.json) {
        Table table;
        table.set("identical", replay.recorded.empty() ? Value() : Value(is_identical));
        table.set("inputs", replay.inputs);
        table.set("recorded", replay.recorded.empty() ? Value() : Value(replay.recorded));
        table.set("now", replay.now);
        table.set("recorded_by", replay.recorded_by);
        table.set("version", code_version());
        fmt::print("{}", to_json(Value(std::move(table))));
    } else if (is_identical) {
        fmt::print("identical: {} inputs, fingerprint {}\n", replay.inputs, replay.now);
    } else if (replay.recorded.empty()) {
        fmt::print("the log is cut after {} inputs; fingerprint up to there {}\n", replay.inputs,
                   replay.now);
    } else {
        fmt::print("different\nrecorded  {}\nnow       {}\nrecorded by {}; this is {}\n",
                   replay.recorded, replay.now, replay.recorded_by, code_version());
    }
}

}  // namespace

void verify_inputs(const ReplayArguments& a) {
    const InputReplay replay = [&] {
        Waiting waiting("replaying " + a.file);
        const HeldStop replaying;
        return replay_inputs(a.file, [&](double share) {
            waiting.tell(share);
            return stops_asked() == 0;
        });
    }();
    if (replay.is_other_scenario) notice(a.file + ": scenario.toml is not as it was run");
    print_inputs(a, replay);
    if (!replay.recorded.empty() && replay.recorded != replay.now) {
        throw CommandEnd(failed, a.file + ": the run differs from its fingerprint");
    }
}

}  // namespace rovernet::cli
