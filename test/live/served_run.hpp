// SPDX-License-Identifier: MIT
#pragma once

#include "live/input_replay.hpp"
#include "live/paced_run.hpp"
#include "test/cli/process.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <cstddef>
#include <future>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rovernet::test {

/// Paced run in a separate thread, which serves the given fronts.
class ServedRun {
  public:
    /// Starts the run, and waits until it listens at `addresses` addresses.
    ServedRun(const Scenario& scenario, std::vector<FrontListeners> fronts, std::size_t addresses) {
        PacedOptions options;
        options.folder = folder_.path("out");
        options.fronts = std::move(fronts);
        options.say = [this, addresses](std::string_view text) {
            if (!text.starts_with("listening on ") || said_.size() == addresses) return;
            said_.emplace_back(text);
            if (said_.size() == addresses) opened_.set_value();
        };
        run_ = std::async(std::launch::async,
                          [options, scenario] { return run_paced(scenario, options); });
        opened_.get_future().wait();
    }

    /// Port of the address for the protocol `what`, such as "(rosbridge)".
    int port(std::string_view what) const {
        const std::string host = "127.0.0.1:";
        for (const std::string& line : said_) {
            if (line.ends_with(what)) return std::stoi(line.substr(line.find(host) + host.size()));
        }
        FAIL("it listens nowhere for " << what);
        return 0;
    }
    LiveResult end() { return run_.get(); }
    InputReplay replay() const { return replay_inputs(folder_.path("out"), {}); }
    /// Log of inputs written so far.
    std::string log() const { return content(folder_.path("out/inputs.jsonl")); }

  private:
    TemporaryFolder folder_;
    std::vector<std::string> said_;
    std::promise<void> opened_;
    std::future<LiveResult> run_;
};

}  // namespace rovernet::test
