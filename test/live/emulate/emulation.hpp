// SPDX-License-Identifier: MIT
#pragma once

#include "test/cli/process.hpp"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

namespace rovernet::test {

/// Process of `rovernet emulate` in the background.
class Emulation {
  public:
    Emulation(const std::string& scenario, std::vector<std::string> options)
        : process_(folder, arguments(scenario, std::move(options))) {}
    ~Emulation() {
        if (!has_ended_) stop();
    }
    Emulation(const Emulation&) = delete;
    Emulation& operator=(const Emulation&) = delete;

    /// Waits until the process listens at `ports` ports. @return its lines about the ports; fewer
    /// if it has ended
    std::vector<std::string> listening(std::size_t ports) const {
        using namespace std::chrono_literals;
        std::vector<std::string> said;
        for (int i = 0; i < 4000 && said.size() < ports; ++i, std::this_thread::sleep_for(5ms)) {
            const std::string told = said_to_person();
            std::ifstream out(folder.path("stdout"));
            said.clear();
            for (std::string line; std::getline(out, line) && !out.eof();) {
                if (line.starts_with("listening on ")) said.push_back(line);
            }
            // the process has printed an error
            if (!told.empty() && told.find("for a page: ") == told.npos) break;
        }
        return said;
    }
    /// Port in the line that ends with `what`, such as "(rosbridge)", among `ports` lines.
    int port(std::size_t ports, const std::string& what) const {
        for (const std::string& line : listening(ports)) {
            if (line.ends_with(what)) return std::stoi(line.substr(line.find("127.0.0.1:") + 10));
        }
        FAIL("it does not listen for " << what);
        return 0;
    }
    /// UDP ports of the robots.
    std::vector<int> ports(std::size_t robots) const {
        std::vector<int> ports;
        for (const std::string& line : listening(robots)) {
            ports.push_back(std::stoi(line.substr(line.find("127.0.0.1:") + 10)));
        }
        REQUIRE(ports.size() == robots);
        return ports;
    }

    Ended wait() {
        has_ended_ = true;
        return process_.wait();
    }
    Ended stop() {
        process_.interrupt();
        return wait();
    }
    void end_by_force() {
        kill(process_.pid(), SIGKILL);
        wait();
    }
    pid_t pid() const { return process_.pid(); }
    std::string said_to_person() const { return content(folder.path("stderr")); }
    Json summary() const { return Json::parse(content(folder.path("out/summary.json"))); }
    Ended replay() const { return command(folder, {"replay", folder.path("out"), "--verify"}); }

    TemporaryFolder folder;

  private:
    std::vector<std::string> arguments(const std::string& scenario,
                                       std::vector<std::string> options) {
        options.insert(options.begin(),
                       {"emulate", folder.write("s.toml", scenario), "--out", folder.path("out")});
        return options;
    }

    Process process_;
    bool has_ended_ = false;
};

}  // namespace rovernet::test
