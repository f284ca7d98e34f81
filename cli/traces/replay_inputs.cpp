// SPDX-License-Identifier: MIT
#include "cli/traces/replay_inputs.hpp"

#include "cli/terminal/diagnostics.hpp"
#include "cli/terminal/waiting.hpp"
#include "experiment/version.hpp"
#include "live/input_replay.hpp"
#include "scenario/document/json.hpp"

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
        fmt::print(
            "the log ends after {} inputs, without the fingerprint of the run; the replay up to "
            "the last input has the fingerprint {}\n",
            replay.inputs, replay.now);
    } else {
        fmt::print(
            "the fingerprints differ\nrecorded  {}\nnow       {}\nrecorded by {}; this is {}\n",
            replay.recorded, replay.now, replay.recorded_by, code_version());
    }
}

void tell_of_log(const InputReplay& replay) {
    if (replay.is_other_scenario) {
        notice(fmt::format(
            "{}: {}", replay.log,
            replay.has_own_scenario
                ? "scenario.toml in the folder of the log differs from the scenario that was run; "
                  "the scenario in the log is used"
                : "scenario.toml in the folder of the log differs from the scenario that was run"));
    }
    if (replay.torn) {
        notice(fmt::format("{}:{}: the last line is incomplete and is ignored", replay.log,
                           *replay.torn));
    }
    if (replay.recorded.empty()) {
        notice(replay.log +
               ": the run of this log did not end; the log is replayed up to the last input");
    }
    for (const std::string& other : replay.others) {
        notice(
            other +
            ": this is the log of a different run that did not end; to replay this log, give the "
            "name of this file instead of the folder");
    }
}

}  // namespace

void verify_inputs(const ReplayArguments& a) {
    const InputReplay replay = [&] {
        Waiting waiting("replaying " + a.file);
        return replay_inputs(a.file, [&](double share) {
            waiting.tell(share);
            return true;
        });
    }();
    tell_of_log(replay);
    print_inputs(a, replay);
    if (!replay.recorded.empty() && replay.recorded != replay.now) {
        throw CommandEnd(
            failed,
            a.file + ": the replayed run has a different fingerprint than the recorded run");
    }
}

}  // namespace rovernet::cli
