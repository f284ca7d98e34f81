// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/replay/capture.hpp"
#include "experiment/run.hpp"
#include "scenario/scenario.hpp"
#include "scenario/scenario_file.hpp"
#include "test/traces/record_stream.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <string>
#include <vector>

namespace rovernet::testing {

/// Run with a recorded trace, and the paths of files made from the trace.
struct CapturedRun {
    TempFolder folder;
    std::string trace = folder / "trace.mcap", capture = folder / "run.pcapng";

    explicit CapturedRun(const std::string& text, std::vector<std::string> set = {}) {
        write_file(folder / "s.toml", text);
        RunOptions to;
        to.folder = folder / ".";
        set.emplace_back("trace.record=true");
        run_scenario(load_scenario(folder / "s.toml", {.set = set}), to);
    }
    /// Output of tshark for the capture, with these options.
    std::string tshark(const std::string& options) const {
        const std::string printed = folder / "printed", errors = folder / "errors";
        const std::string line = "HOME=" + (folder / ".") + " tshark -n -r " + capture + " " +
                                 options + " > " + printed + " 2> " + errors;
        REQUIRE(std::system(line.c_str()) == 0);
        return content(printed);
    }
};

/// Whether tshark is installed; prints a message if not.
inline bool has_tshark() {
    if (std::system("tshark --version > /dev/null 2>&1") == 0) return true;
    MESSAGE("tshark is missing: not checked");
    return false;
}

}  // namespace rovernet::testing
