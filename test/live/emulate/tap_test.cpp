// SPDX-License-Identifier: MIT
// The commands `emulate` and `in`: the kernel's own network as the programs of robots. Where
// network namespaces or TAP devices are forbidden, the tests say so and pass.
#include "test/live/emulate/tap_run.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace tap_test {
using namespace rovernet::test;
using namespace std::chrono_literals;

namespace {

/// Sends pings by the kernel. @return round trips [ms] of those that came back
std::vector<double> ping(const Emulation& run, const std::string& robot, const std::string& to,
                         int number, const std::string& every = "0.02") {
    const TemporaryFolder folder;
    const std::string count = std::to_string(number);
    const Ended ended =
        in(folder, run, robot, {"ping", "-n", "-c", count, "-i", every, "-W", "5", to}).wait();
    CAPTURE(ended.err);
    CHECK(ended.out.find(count + " packets transmitted") != std::string::npos);
    std::vector<double> times;
    const std::string mark = "time=";
    for (std::size_t at = ended.out.find(mark); at != std::string::npos;
         at = ended.out.find(mark, at + 1)) {
        times.push_back(std::stod(ended.out.substr(at + mark.size())));
    }
    return times;
}

bool has_ping() {
    const bool has =
        std::filesystem::exists("/bin/ping") || std::filesystem::exists("/usr/bin/ping");
    if (!has) MESSAGE("skipped: there is no ping (package iputils-ping)");
    return has;
}

}  // namespace

TEST_CASE(
    "emulate: pings of the kernel use the simulated radio, and the run is replayed without pings") {
    const auto run = has_ping() ? emulated_by_tap() : nullptr;
    if (!run) return;
    const std::vector<double> times = ping(*run, "A", "10.0.0.2", 20);
    CHECK(times.size() == 20);
    for (const double ms : times) CHECK(ms >= 4.0);  // the radio's own time
    CHECK(ping(*run, "A", "10.0.0.3", 2).empty());   // W
    CHECK(ping(*run, "B", "10.0.0.9", 2).empty());   // nobody
    CHECK(ping(*run, "B", "127.0.0.1", 1).size() == 1);
    const Ended ended = run->stop();
    CHECK(ended.exit == 0);
    const std::string fingerprint = run->summary().at("fingerprint");
    CHECK(run->summary().at("live").at("packets_sent") > 40);
    CHECK(run->replay().out.find(", fingerprint " + fingerprint) != std::string::npos);
    CHECK(run->replay().out.starts_with("identical: "));
    CHECK_FALSE(has_listeners(run->pid()));
}

TEST_CASE(
    "emulate: a radio that loses 20 % of the frames in each direction loses 36 % of the pings") {
    std::string lossy = tap_scenario;
    lossy.insert(lossy.find("preamble"), "success_rate = 0.8\n");
    const auto run = has_ping() ? emulated_by_tap(lossy) : nullptr;
    if (!run) return;
    // Each knows the other's address beforehand: asking for it could be lost, too.
    const TemporaryFolder folder;
    ping(*run, "A", "10.0.0.2", 40);
    constexpr int trials = 400;
    const double received = static_cast<double>(ping(*run, "A", "10.0.0.2", trials, "0.01").size());
    const double expected = 0.8 * 0.8 * trials, sigma = std::sqrt(trials * 0.64 * 0.36);
    CHECK(std::abs(received - expected) <= 4 * sigma);
    CHECK(run->stop().exit == 0);
}

TEST_CASE("emulate: a megabyte by TCP arrives complete") {
    std::string fast = tap_scenario;
    fast.replace(fast.find("1.94 ms"), 7, "20 us");
    const auto run = emulated_by_tap(fast);
    if (!run) return;
    const TemporaryFolder at_b, at_a;
    const Process server = in(at_b, *run, "B", {"python3", "-c", R"(
import hashlib, socket
door = socket.create_server(("10.0.0.2", 5001))
print("ready", flush=True)
client, _ = door.accept()
digest, size = hashlib.sha256(), 0
while data := client.recv(65536):
    digest.update(data)
    size += len(data)
client.sendall(f"{size} {digest.hexdigest()}".encode())
)"});
    for (int i = 0; i < 2000 && content(at_b.path("stdout")).empty(); ++i) {
        std::this_thread::sleep_for(10ms);
    }
    const Ended client = in(at_a, *run, "A", {"python3", "-c", R"(
import hashlib, socket
sent = bytes(range(256)) * 4096
server = socket.create_connection(("10.0.0.2", 5001), 40)
server.sendall(sent)
server.shutdown(socket.SHUT_WR)
got = server.recv(200).decode()
print(got == f"{len(sent)} {hashlib.sha256(sent).hexdigest()}", len(sent))
)"})
                             .wait();
    CHECK(client.out == "True 1048576\n");
    CHECK(server.wait().exit == 0);
    CHECK(run->stop().exit == 0);
    CHECK(run->replay().exit == 0);
}

TEST_CASE("emulate: a killed run leaves no listener of a robot behind") {
    const auto run = emulated_by_tap();
    if (!run) return;
    CHECK(has_listeners(run->pid()));
    CHECK(content("/proc/net/dev").find("wlan0") == std::string::npos);  // not among the machine's
    run->end_by_force();
    for (int i = 0; i < 1000 && has_listeners(run->pid()); ++i) std::this_thread::sleep_for(5ms);
    CHECK_FALSE(has_listeners(run->pid()));
}

TEST_CASE("`rovernet in`: a run, a robot or a program that does not exist is refused") {
    const TemporaryFolder folder;
    const auto try_in = [&](std::vector<std::string> words) {
        words.insert(words.begin(), "in");
        return command(folder, words);
    };
    CHECK(try_in({"A"}).exit == 2);
    CHECK(try_in({"A", "--run", "4194300", "--", "true"}).exit != 0);
    const auto run = emulated_by_tap();
    if (!run) return;
    const std::string pid = std::to_string(run->pid());
    const Ended unknown = try_in({"X", "--run", pid, "--", "true"});
    CHECK(unknown.exit != 0);
    CHECK(unknown.err.find("there is no robot \"X\"; the robots are ") != std::string::npos);
    CHECK(try_in({"A", "--run", pid, "--", "/no/such/program"}).err.find("/no/such/program: No ") !=
          std::string::npos);
    CHECK(try_in({"A", "--run", pid, "--", "sh", "-c", "exit 7"}).exit == 7);
    const Ended device = try_in({"B", "--run", pid, "--", "cat", "/proc/self/net/dev"});
    CHECK(device.out.find("wlan0") != std::string::npos);
    CHECK(device.out.find("lo:") != std::string::npos);
}

}  // namespace tap_test
