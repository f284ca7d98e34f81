// SPDX-License-Identifier: MIT
// Notices about keys that have no effect.
#include "scenario/idle_keys.hpp"

#include "scenario/document/toml.hpp"
#include "scenario/scenario_file.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace idle_keys_test {
using namespace rovernet;
using test::TemporaryFolder;

namespace {

const std::string robot_a = "[[robot]]\nname = \"A\"\nat = [\"2 m\", \"2 m\"]\n";

std::vector<std::string> notices_of(const std::string& text,
                                    const std::vector<std::string>& set = {}) {
    const TemporaryFolder folder;
    return load_scenario(folder.write("s.toml", text + robot_a), {.set = set}).notices;
}

/// One notice, which ends with these words behind the folder's path.
void check_notice(const std::string& text, const std::string& words) {
    CAPTURE(text);
    const auto notices = notices_of(text);
    REQUIRE(notices.size() == 1);
    CAPTURE(notices[0]);
    CHECK(notices[0].ends_with("/s.toml:" + words));
}

}  // namespace

TEST_CASE("idle keys: a parameter of a model that is not chosen gives a notice") {
    const std::string routing = "[routing]\nprotocol = ";
    check_notice(routing + "\"dsr\"\nttl = 5\n",
                 "3:1: the key \"ttl\" has no effect with [routing] protocol = \"dsr\": only "
                 "flood, aodv and suppression use this key");
    check_notice("[access]\nstandard = \"802.11g\"\n",
                 "2:1: the key \"standard\" has no effect with [access] model = \"none\": only "
                 "csma uses this key");
    check_notice("[reception]\ncapture_ratio = \"6 dB\"\n",
                 "2:1: the key \"capture_ratio\" has no effect with [reception] model = "
                 "\"threshold\": only collision uses this key");
    check_notice("[propagation]\nexponent = 4\n",
                 "2:1: the key \"exponent\" has no effect with [propagation] model = \"friis\": "
                 "only log_distance and multi_wall use this key");
    CHECK(notices_of(routing + "\"aodv\"\nttl = 5\n").empty());
    CHECK(notices_of("[access]\nstandard = \"802.11b\"\n").empty());  // the default
}

TEST_CASE(
    "idle keys: if a study or the command line changes the model, keys of other models in the file "
    "give no notice") {
    const std::string ttl = "[routing]\nprotocol = \"dsr\"\nttl = 5\n";
    const std::string vary = "[study]\nvary.routing.protocol = [\"flood\", \"dsr\"]\n";
    CHECK(notices_of(ttl + vary).empty());
    const std::string flood = "[routing]\nttl = 5\n";
    CHECK(notices_of(flood, {"routing.protocol=dsr"}).empty());
    CHECK(notices_of(flood, {"routing.protocol=dsr", "routing.ttl=5"}).size() == 1);
}

TEST_CASE(
    "idle keys: a key of the protocol `suppression` that the chosen scheme does not use gives a "
    "notice") {
    const std::string counter = "[routing]\nprotocol = \"suppression\"\n";
    check_notice(counter + "range = \"60 m\"\n",
                 "3:1: the key \"range\" has no effect without [routing] scheme = \"location\"");
    check_notice(counter + "hello = \"2 s\"\n",
                 "3:1: the key \"hello\" has no effect without [routing] scheme = \"cluster\"");
    CHECK(notices_of(counter + "scheme = \"location\"\nrange = \"60 m\"\n").empty());
    CHECK(notices_of(counter + "scheme = \"cluster\"\nhello = \"2 s\"\n").empty());
    CHECK(notices_of(counter + "hello = \"2 s\"\n[study]\n" +
                     "vary.routing.scheme = [\"counter\", \"cluster\"]\n")
              .empty());
}

TEST_CASE("idle keys: a key that has no effect because of another key gives a notice") {
    struct Idle {
        std::string head, key, needed;
    };
    for (const Idle& each : std::vector<Idle>{
             {"[shadowing]\nmodel = \"link\"\n", "decorrelation_distance = \"3 m\"",
              "[shadowing] model = \"field\""},
             {"[fading]\nmodel = \"rayleigh\"\n", "k_factor = \"3 dB\"",
              "[fading] model = \"rician\""},
             {"[fading]\nmodel = \"rician\"\n", "m = 3.0", "[fading] model = \"nakagami\""},
             {"[propagation]\nmodel = \"two_ray\"\n", "polarization = \"horizontal\"",
              "[propagation] form = \"exact\""},
             {"[propagation]\nmodel = \"two_ray\"\n", "ground_permittivity = 5",
              "[propagation] form = \"exact\""}}) {
        const std::string name = each.key.substr(0, each.key.find(' '));
        check_notice(each.head + each.key + "\n",
                     "3:1: the key \"" + name + "\" has no effect without " + each.needed);
    }
    check_notice("[routing]\nprotocol = \"aodv\"\ngratuitous = true\ndestination_only = true\n",
                 "3:1: the key \"gratuitous\" has no effect without [routing] destination_only = "
                 "false");
    const std::string two_ray = "[propagation]\nmodel = \"two_ray\"\n";
    CHECK(notices_of(two_ray + "form = \"exact\"\nground_permittivity = 5\n").empty());
    CHECK(notices_of(two_ray + "ground_permittivity = 15\n").empty());  // the default
    CHECK(notices_of("[fading]\nmodel = \"rician\"\nk_factor = \"3 dB\"\n").empty());
    CHECK(notices_of("[shadowing]\nmodel = \"link\"\nsigma = \"3 dB\"\n").empty());
    CHECK(notices_of(two_ray + "ground_permittivity = 5\n" +
                     "[study]\nvary.propagation.form = [\"ns2\", \"exact\"]\n")
              .empty());
}

TEST_CASE(
    "idle keys: `arp_timeout` without `arp` gives a notice, and so do trace options without a "
    "trace") {
    check_notice("[access]\narp_timeout = \"1 s\"\n",
                 "2:1: the key \"arp_timeout\" has no effect without [access] arp = true");
    CHECK(notices_of("[access]\narp_timeout = \"1 s\"\narp = true\n").empty());
    check_notice("[trace]\nlinks = true\n",
                 "2:1: the key \"links\" has no effect: without [trace] record = true, no recorded "
                 "trace is written");
    check_notice("[trace]\nmac = true\n",
                 "2:1: the key \"mac\" has no effect: without [trace] ns2 = \"new\" or \"old\", no "
                 "ns-2 trace is written");
    CHECK(notices_of("[trace]\nlinks = false\nmac = false\n").empty());
    // A recorded trace converts to an ns-2 trace with these lines.
    CHECK(notices_of("[trace]\nmac = true\nlinks = true\nrecord = true\n").empty());
    CHECK(notices_of("[trace]\nmac = true\nns2 = \"new\"\n").empty());
}

TEST_CASE("idle keys: materials and heights of walls on an open field give notices") {
    check_notice("[scene.materials]\nm = { grey = 3, per_crossing = \"1 dB\" }\n",
                 "2:1: material \"m\" has no effect: the scene is an open field without walls");
    check_notice("[scene]\nwall_height = \"2 m\"\n",
                 "2:1: the key \"wall_height\" has no effect: the scene is an open field without "
                 "walls");
}

TEST_CASE("idle keys: a scenario that is printed and read again gives no new notices") {
    const TemporaryFolder folder;
    for (const std::string head :
         {"", "[access]\nmodel = \"csma\"\n[reception]\nmodel = \"sinr\"\n",
          "[routing]\nprotocol = \"suppression\"\n", "[routing]\nprotocol = \"managed\"\n",
          "[routing]\nprotocol = \"dsr\"\n", "[routing]\nprotocol = \"aodv\"\n"}) {
        const Scenario scenario = load_scenario(folder.write("s.toml", head + robot_a), {});
        CAPTURE(head);
        CHECK(scenario.notices.empty());
        const std::string printed = to_toml(to_document(scenario));
        CHECK(load_scenario(folder.write("t.toml", printed), {}).notices.empty());
    }
}
}  // namespace idle_keys_test
