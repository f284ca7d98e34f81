// SPDX-License-Identifier: MIT
// Mistakes in what a scenario says about routing: errors and notices with their place, what is
// wrong, and a suggestion.
#include "experiment/run.hpp"
#include "experiment/session.hpp"
#include "network/network.hpp"
#include "scenario/scenario_file.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <string>
#include <vector>

namespace routing_input_test {
using namespace rovernet;
using test::TemporaryFolder;

namespace {

const std::string two_robots =
    "[[robot]]\nname = \"A\"\nat = [\"0 m\", \"0 m\"]\n"
    "[[robot]]\nname = \"B\"\nat = [\"5 m\", \"0 m\"]\n";

/// Error of a scenario of two robots with these lines, which begin in line 7; empty if it is valid.
std::string error_of(const std::string& lines, const std::string& robots = two_robots) {
    const TemporaryFolder folder;
    try {
        load_scenario(folder.write("s.toml", robots + lines), {});
    } catch (const InputError& error) {
        const std::string text = error.what();
        return text.substr(text.find("s.toml"));
    }
    return "";
}

std::string all_notices(const std::string& lines) {
    const TemporaryFolder folder;
    std::string all;
    for (const std::string& each :
         load_scenario(folder.write("s.toml", two_robots + lines), {}).notices) {
        all += each.substr(each.find("s.toml")) + "\n";
    }
    return all;
}

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

std::string unicast(const std::string& more) {
    return "[[traffic]]\nkind = \"unicast\"\nfrom = \"A\"\nto = \"B\"\n" + more + "\n";
}

}  // namespace

TEST_CASE("routing input: the error for an unknown protocol lists all protocols and suggests one") {
    const std::string error = error_of("[routing]\nprotocol = \"aovd\"\n");
    CHECK(has(error,
              "s.toml:8:12: unknown protocol \"aovd\"; expected one of \"flood\", \"aodv\", "
              "\"dsr\", \"suppression\", \"managed\"; did you mean \"aodv\"?"));
}

TEST_CASE("routing input: the error for an unknown key may suggest a key of another protocol") {
    const std::string chosen = "[routing]\nprotocol = \"flood\"\n";
    CHECK(
        has(error_of(chosen + "colour = 3\n"), "s.toml:9:1: unknown key \"colour\" in [routing]"));
    const std::string error = error_of(chosen + "hop_limt = 3\n");
    CHECK(has(error, "s.toml:9:1: unknown key \"hop_limt\""));
    CHECK(has(error, "did you mean \"hop_limit\"?"));
    CHECK(error_of(chosen + "hop_limit = 3\n").empty());
    CHECK(has(error_of(chosen + "hop_limit = 8\n"), "s.toml:9:13: hop_limit: found the number 8"));
}

TEST_CASE(
    "routing input: a key of another protocol may have any value that this other protocol allows") {
    for (const std::string protocol : {"flood", "aodv", "dsr", "managed", "suppression"}) {
        CAPTURE(protocol);
        const std::string chosen = "[routing]\nprotocol = \"" + protocol + "\"\n";
        CHECK(error_of(chosen + "hello = \"0 s\"\n").empty());  // no scheme but cluster has it
    }
    const std::string text =
        error_of("[routing]\nprotocol = \"suppression\"\nscheme = \"cluster\"\nhello = \"0 s\"\n");
    CHECK(has(text, "s.toml:10:9: "));
    CHECK(has(text, "hello must be > 0 s for scheme \"cluster\", got 0"));
    CHECK(has(error_of("[routing]\nhello = \"-1 s\"\n"), "s.toml:8:9: hello: found \"-1 s\""));
}

TEST_CASE(
    "routing input: a value that the scheme of `suppression` refuses is an error with line and "
    "column") {
    const std::string chosen = "[routing]\nprotocol = \"suppression\"\n";
    CHECK(has(error_of(chosen + "scheme = \"counter\"\nthreshold = 2.5\n"),
              "s.toml:10:13: suppression: threshold must be a whole number from 1 to 1e9"));
    CHECK(has(error_of(chosen + "scheme = \"location\"\n"),
              "s.toml:7:1: suppression: range must be given; expected a value > 0 m for scheme "
              "\"location\""));
    CHECK(has(error_of(chosen + "scheme = \"cluster\"\nthreshold = 2\n"),
              "s.toml:10:13: suppression: threshold must be left out for scheme \"cluster\""));
}

TEST_CASE(
    "routing input: an unknown role of a robot is an error with line, column and a suggestion") {
    const std::string robots = two_robots + "role = \"ruoter\"\n";
    const std::string error = error_of("[routing]\nprotocol = \"managed\"\n", robots);
    CHECK(has(error,
              "s.toml:7:8: unknown role \"ruoter\"; expected one of \"client\", \"router\", "
              "\"router_late\", \"mute\"; did you mean \"router\"?"));
    CHECK(error_of("", two_robots + "role = \"mute\"\n").empty());  // beside another protocol
}

TEST_CASE("routing input: sizes and payloads too large for a UDP packet are errors") {
    CHECK(error_of(unicast("size = \"65507 B\"")).empty());
    CHECK(has(error_of(unicast("size = \"65508 B\"")),
              "s.toml:11:8: size: found \"65508 B\"; expected a value from 0 to 65507 bytes, which "
              "fit into a UDP packet"));
    CHECK(error_of(unicast("payload = \"" + std::string(65'507, 'x') + "\"")).empty());
    CHECK(has(error_of(unicast("payload = \"" + std::string(65'508, 'x') + "\"")),
              "s.toml:11:11: payload: found a text of 65508 bytes; expected at most 65507"));
    CHECK(has(error_of("on_receive = { send = \"x\", size = \"1 MB\" }\n"),
              "s.toml:7:35: size: found \"1 MB\"; expected a value from 0 to 65507 bytes"));
}

TEST_CASE("routing input: a broadcast limited to one hop (hops = 1) gives a notice") {
    const std::string text = all_notices("[[traffic]]\nfrom = \"A\"\nsize = \"9 B\"\nhops = 1\n");
    CHECK(text ==
          "s.toml:10:8: hops: with hops = 1 the routing protocol does not forward these "
          "broadcasts, so only neighbours of \"A\" hear these broadcasts; without the key "
          "\"hops\", the protocol forwards these broadcasts\n");
    CHECK(all_notices("[[traffic]]\nfrom = \"A\"\nsize = \"9 B\"\n").empty());
    CHECK(has(error_of("[[traffic]]\nfrom = \"A\"\nsize = \"9 B\"\nhops = 2\n"),
              "s.toml:10:8: hops: found the number 2; expected a value of 1"));
}

TEST_CASE(
    "routing input: a unicast gives a notice if the protocol, such as `flood`, does not route "
    "unicasts") {
    for (const std::string protocol : {"flood", "suppression", "managed"}) {
        const std::string chosen = "[routing]\nprotocol = \"" + protocol + "\"\n";
        const std::string text = all_notices(unicast("size = \"9 B\"") + chosen);
        CHECK(has(text, "s.toml:10:6: to: the routing protocol does not route messages to a "));
        CHECK(has(text, "[routing] protocol = \"aodv\" to find routes"));
    }
    for (const std::string protocol : {"aodv", "dsr"}) {
        CHECK(
            all_notices(unicast("size = \"9 B\"") + "[routing]\nprotocol = \"" + protocol + "\"\n")
                .empty());
    }
}

TEST_CASE(
    "routing input: a broadcast gives a notice if the protocol, such as `aodv`, does not forward "
    "broadcasts") {
    const std::string broadcast = "[[traffic]]\nfrom = \"A\"\nsize = \"9 B\"\n";
    for (const std::string protocol : {"aodv", "dsr"}) {
        const std::string chosen = "[routing]\nprotocol = \"" + protocol + "\"\n";
        const std::string text = all_notices(broadcast + chosen);
        CHECK(text ==
              "s.toml:8:8: from: the routing protocol does not forward broadcasts, so broadcasts "
              "of \"A\" go over one hop only; write hops = 1 to confirm this, or [routing] "
              "protocol = \"flood\" to forward broadcasts\n");
        CHECK(all_notices(broadcast + "hops = 1\n" + chosen).empty());
        // No notice about forwarding: no message is sent.
        CHECK(all_notices(broadcast + "start = \"1 h\"\n" + chosen)
                  .starts_with("s.toml:10:9: start: 3600 s is after the end of the run"));
        CHECK(has(all_notices("on_time = { time = \"1 s\", send = \"x\" }\n" + chosen),
                  "s.toml:7:11: send: the routing protocol does not forward broadcasts, so "
                  "broadcasts of \"B\" go over one hop only"));
    }
    for (const std::string protocol : {"flood", "suppression", "managed"}) {
        CHECK(all_notices(broadcast + "[routing]\nprotocol = \"" + protocol + "\"\n").empty());
    }
}

TEST_CASE(
    "routing input: after the run, a notice says if `dsr` lost messages because routes would be "
    "too long") {
    const auto notice_with = [](int robots) {
        std::string text =
            "[scenario]\nduration = \"60 s\"\n[propagation]\nmodel = \"disc\"\nrange = \"9 m\"\n"
            "[access]\nmodel = \"csma\"\n[routing]\nprotocol = \"dsr\"\n";
        for (int i = 0; i < robots; ++i) {
            text +=
                fmt::format("[[robot]]\nname = \"r{0}\"\nat = [\"{1} m\", \"0 m\"]\n", i, 8 * i);
        }
        text += fmt::format(
            "[[traffic]]\nkind = \"unicast\"\nfrom = \"r0\"\nto = \"r{}\"\nsize = \"9 B\"\n",
            robots - 1);
        const TemporaryFolder folder;
        const Scenario scenario = load_scenario(folder.write("s.toml", text), {});
        ScenarioRun run(scenario);
        run.session().step(start_of_run + scenario.scenario.duration);
        return run.finish().network->routing_notice();
    };
    CHECK(notice_with(16).empty());
    CHECK(notice_with(18) ==
          "dsr: messages between 1 pair of robots were lost, because a route request passed 16 "
          "robots without finding the destination; a route of dsr has at most 16 robots");
}

}  // namespace routing_input_test
