// SPDX-License-Identifier: MIT
#include "live/emulate/device_addresses.hpp"

#include "scenario/scenario_file.hpp"
#include "test/cli/process.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <vector>

namespace device_addresses_test {
using namespace rovernet;
using namespace rovernet::test;

namespace {

/// Robots A and B with these radios.
std::string two(const std::string& a, const std::string& b, const std::string& all = {}) {
    return fmt::format(R"([scenario]
duration = "1 s"
[radio]
{}
[[robot]]
name = "A"
at = ["0 m", "0 m"]
radio = {{ {} }}
[[robot]]
name = "B"
at = ["9 m", "0 m"]
radio = {{ {} }}
)",
                       all, a, b);
}

std::vector<std::string> notices(const std::string& text) {
    const TemporaryFolder folder;
    return check_device_addresses(load_scenario(folder.write("s.toml", text), {}));
}

/// The error that a file gets, without its folder.
std::string fault(const std::string& text) {
    try {
        notices(text);
    } catch (const InputError& error) {
        const std::string what = error.what();
        return what.substr(what.find("s.toml"));
    }
    return {};
}

}  // namespace

TEST_CASE(
    "device addresses: an address that no network device can have is refused, with line and "
    "column") {
    const std::vector<std::string> macs = {"hello",
                                           "",
                                           "02:00:00:00:00",
                                           "02:00:00:00:00:01:02",
                                           "02:00:00:00:00:0g",
                                           "02-00-00-00-00-01",
                                           "2:0:0:0:0:1",
                                           "02:00:00:00:00:100",
                                           "01:00:5e:00:00:01",
                                           "33:33:00:00:00:01",
                                           "ff:ff:ff:ff:ff:ff",
                                           "00:00:00:00:00:00"};
    for (const std::string& mac : macs) {
        CAPTURE(mac);
        const std::string what = fault(two("", "mac = \"" + mac + "\""));
        CHECK(what.starts_with("s.toml:12:17: robot B: found the mac \"" + mac + "\"; expected "));
    }
    for (const std::string ip : {"hello", "", "10.0.0", "10.0.0.256", "10.0.0.1.1", "10.0.0.-1",
                                 "10.0.0.1/24", "010.0.0.1", "::1", "0.0.0.0", "0.1.2.3",
                                 "127.0.0.1", "224.0.0.1", "255.255.255.255", "240.0.0.1"}) {
        CAPTURE(ip);
        const std::string what = fault(two("", "ip = \"" + ip + "\""));
        CHECK(what.starts_with("s.toml:12:16: robot B: found the ip \"" + ip + "\"; expected "));
    }
    for (const std::string mask : {"hello", "", "24", "/24", "255.255.255", "255.0.255.0",
                                   "255.255.255.1", "0.0.0.255", "0.0.0.0", "255.255.255.256"}) {
        CAPTURE(mask);
        const std::string what = fault(two("", "netmask = \"" + mask + "\""));
        CHECK(what.starts_with("s.toml:12:21: robot B: found the netmask \"" + mask + "\"; expec"));
    }
    CHECK(fault(two("", "", "netmask = \"255.0.255.0\"")).starts_with("s.toml:4:11: robot A: "));
}

TEST_CASE("device addresses: network and broadcast addresses are refused for hosts") {
    CHECK(fault(two("", "ip = \"10.0.0.0\""))
              .starts_with("s.toml:12:16: robot B: the ip 10.0.0.0 is the address of the network "
                           "10.0.0.0/24, not of a host; "));
    CHECK(fault(two("", "ip = \"10.0.0.255\"")).find("is the broadcast address of") !=
          std::string::npos);
    // The address is made, the netmask is not.
    CHECK(fault(two("", "", "netmask = \"255.255.255.254\"")).empty());
    CHECK(fault(two("netmask = \"255.255.255.254\"", "netmask = \"255.255.255.252\"")).empty());
    CHECK(fault(two("ip = \"10.0.0.3\", netmask = \"255.255.255.252\"", ""))
              .starts_with("s.toml:8:16: robot A: the ip 10.0.0.3 is the broadcast address"));
    CHECK(fault(two("", "ip = \"10.0.1.0\"", "netmask = \"255.255.0.0\"")).empty());
    CHECK(fault(two("", "ip = \"10.0.255.255\"", "netmask = \"255.255.0.0\"")).find("broadcast") !=
          std::string::npos);
    CHECK(fault(two("", "ip = \"10.0.0.0\", netmask = \"255.255.255.255\"")).empty());
}

TEST_CASE("device addresses: equal addresses of two robots are refused, in any notation") {
    CHECK(fault(two("mac = \"02:00:00:00:00:aA\"", "mac = \"02:00:00:00:00:Aa\""))
              .starts_with("s.toml:12:17: robot B: found the mac 02:00:00:00:00:Aa, but robot A "
                           "has the same address; "));
    // One that is made is not one that was given.
    CHECK(fault(two("ip = \"10.0.0.2\"", "")).empty());
    std::string many =
        "[scenario]\nduration = \"1 s\"\n[[robot]]\nname = \"X\"\ncount = 12\nplace "
        "= { model = \"uniform\", area = [[\"0 m\", \"0 m\"], [\"9 m\", \"9 m\"]] }\n"
        "[[robot]]\nname = \"Y\"\nat = [\"0 m\", \"0 m\"]\n"
        "radio = { mac = \"02:00:00:00:00:0A\" }\n";
    CHECK(fault(many).empty());
}

TEST_CASE("device addresses: robots in different IP networks give a notice") {
    CHECK(notices(two("", "")).empty());
    CHECK(notices(two("ip = \"10.0.0.77\"", "")).empty());
    CHECK(notices(two("ip = \"192.168.1.1\"", "ip = \"192.168.1.2\"")).empty());
    const auto first = notices(two("ip = \"192.168.1.1\"", ""));
    REQUIRE(first.size() == 1);
    CHECK(first[0].ends_with(
        "s.toml:8:16: the network 192.168.1.0/24 of robot A does not contain robot B (10.0.0.2): "
        "packets between these robots need routes that you set (ip route)"));
    const auto second = notices(two("", "ip = \"10.0.1.2\""));
    REQUIRE(second.size() == 1);
    CHECK(second[0].find(
              "s.toml:12:16: the network 10.0.0.0/24 of robot A does not contain robot B") !=
          std::string::npos);
    // A's network has B in it, and B's has not A.
    const auto narrow = notices(two("", "netmask = \"255.255.255.255\""));
    REQUIRE(narrow.size() == 1);
    CHECK(narrow[0].find(
              "s.toml:12:21: the network 10.0.0.2/32 of robot B does not contain robot A") !=
          std::string::npos);
    CHECK(notices(two("netmask = \"255.0.0.0\"", "netmask = \"255.255.0.0\"")).empty());
}

TEST_CASE("device addresses: a network with fewer addresses than robots gives a notice") {
    const auto robots = [](int count, const std::string& radio) {
        return notices(
            fmt::format("[scenario]\nduration = \"1 s\"\n[radio]\n{}\n[[robot]]\nname = "
                        "\"X\"\ncount = {}\nplace = {{ model = \"uniform\", area = "
                        "[[\"0 m\", \"0 m\"], [\"9 m\", \"9 m\"]] }}\n",
                        radio, count));
    };
    CHECK(robots(254, "").empty());
    const auto told = robots(260, "");
    REQUIRE(told.size() == 2);
    CHECK(told[0].starts_with("robot X254: the ip 10.0.0.255 is the broadcast address of the "));
    CHECK(told[1].starts_with("the network 10.0.0.0/24 of robot X0 does not contain robot X255 ("));
    CHECK(robots(260, "netmask = \"255.255.0.0\"").empty());
}

TEST_CASE("emulate: an invalid address ends the command with code 3 before anything is created") {
    const TemporaryFolder folder;
    const std::string file = folder.write("s.toml", two("", "mac = \"01:00:00:00:00:01\""));
    const Ended ended = command(folder, {"emulate", file, "--out", folder.path("out")});
    CHECK(ended.exit == 3);
    CHECK(ended.err.find("s.toml:12:17: robot B: found the mac") != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(folder.path("out")));
    // It is a label for those who have no device.
    CHECK(command(folder, {"run", file, "--out", folder.path("run")}).exit == 0);
    CHECK(command(folder, {"emulate", file, "--udp", "127.0.0.1:0", "--speed", "100", "--out",
                           folder.path("udp")})
              .exit == 0);
    CHECK(command(folder, {"emulate", folder.write("t.toml", two("", "")), "--set",
                           "radio.netmask=255.0.255.0", "--out", folder.path("out")})
              .exit == 2);
}

}  // namespace device_addresses_test
