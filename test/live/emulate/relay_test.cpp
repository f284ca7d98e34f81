// SPDX-License-Identifier: MIT
#include "live/emulate/relay.hpp"

#include "test/live/emulate/programs.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

namespace relay_test {
using namespace rovernet;
using namespace rovernet::test;
using namespace std::chrono_literals;
using namespace std::string_literals;

namespace {

const std::string to_all = "RN\x01\x00\xff\xff\xff\xff"s;
const std::string to_a = "RN\x01\x00\x00\x00\x00\x00"s;
const std::string to_b = "RN\x01\x00\x01\x00\x00\x00"s;

Programs relay(const std::string& more = {}) {
    return {std::make_unique<RelayFormat>(), three_in_a_row(more)};
}

/// Number of two bytes in a datagram, the lower one first.
int short_at(const std::string& bytes, std::size_t place) {
    return static_cast<std::int16_t>(static_cast<unsigned char>(bytes[place]) |
                                     static_cast<unsigned char>(bytes[place + 1]) << 8);
}

/// Time on air at 11 Mb/s behind a long preamble of 192 us.
Duration airtime(std::size_t bytes) {
    return 192us + std::chrono::nanoseconds(std::lround(8e9 * static_cast<double>(bytes) / 11e6));
}

}  // namespace

TEST_CASE(
    "UDP relay: a datagram to everyone reaches robots in range, with source, level and hops") {
    Programs programs = relay();
    programs.run_to(start_of_run + 100ms);
    programs.send(1, to_all + "F");
    programs.run_to(start_of_run + 200ms);
    REQUIRE(programs.got.size() == 2);  // A and C, at 150 m each
    // Free space (Friis): 45 mW, 2450 MHz, 150 m.
    const double wavelength = 299'792'458 / 2450e6;
    const double level =
        10 * std::log10(45.0) + 20 * std::log10(wavelength / (4 * std::numbers::pi * 150));
    constexpr double half_a_digit = 0.05;  // [dB]
    for (const auto& packet : programs.got) {
        CHECK(packet.bytes.substr(0, 8) == "RN\x01\x01\x01\x00\x00\x00"s);
        CHECK(std::abs(short_at(packet.bytes, 8) / 10.0 - level) <= half_a_digit + 1e-9);
        CHECK(short_at(packet.bytes, 10) == 1);
        CHECK(packet.bytes.substr(12) == "F");
        // 150 m of way take 0.5 us, and a robot reacts 1 us later.
        const Duration took = packet.time - (start_of_run + 100ms);
        CHECK(took >= airtime(1) + 1us);
        CHECK(took <= airtime(1) + 2us);
    }
    CHECK(programs.got[0].robot == NodeId{0});
    CHECK(programs.got[1].robot == NodeId{2});
}

TEST_CASE("UDP relay: a datagram to one robot is received by this robot alone, over one hop") {
    Programs programs = relay();
    programs.send(0, to_b + "for B");
    programs.send(2, to_b + "for B, too");
    programs.send(2, to_a + "out of range");
    programs.run_to(start_of_run + 100ms);
    REQUIRE(programs.got.size() == 2);
    CHECK(programs.got[0].robot == NodeId{1});
    CHECK(programs.got[0].bytes.substr(12) == "for B");
    CHECK(programs.got[1].bytes.substr(12) == "for B, too");
    CHECK(programs.got[1].bytes[4] == 2);
    CHECK(programs.count("packets_sent") == 3);
    CHECK(programs.count("packets_received") == 2);
}

TEST_CASE("UDP relay: programs also get the messages of the scenario's own traffic") {
    Programs programs = relay();
    programs.run_to(start_of_run + 1s);  // A says "tick" at 0.5 s, which is flooded to C
    std::vector<std::string> at_c;
    for (const auto& packet : programs.got) {
        if (packet.robot == NodeId{2}) at_c.push_back(packet.bytes);
    }
    REQUIRE(at_c.size() == 1);
    CHECK(at_c[0].substr(12) == "tick");
    CHECK(at_c[0][4] == 0);
    CHECK(short_at(at_c[0], 10) == 2);
}

TEST_CASE("UDP relay: invalid datagrams, unknown addresses and robots that are off are counted") {
    Programs programs = relay();
    for (const std::string& bad :
         {""s, "R"s, "RN\x01\x00\xff\xff\xff"s, "RN\x01\x01\xff\xff\xff\xff"s,
          "RN\x02\x00\xff\xff\xff\xff"s, "nonsense"s}) {
        programs.send(0, bad);
    }
    CHECK(programs.count("malformed") == 6);
    programs.send(0, "RN\x01\x00\x03\x00\x00\x00x"s);
    programs.send(0, "RN\x01\x00\xfe\xff\xff\xffx"s);
    programs.send(0, to_a + "to itself");
    CHECK(programs.count("unknown_destination") == 3);
    programs.session().network().switch_off(NodeId{0});
    programs.send(0, to_all + "x");
    CHECK(programs.count("robot_off") == 1);
    programs.run_to(start_of_run + 100ms);
    CHECK(programs.got.empty());
    CHECK(programs.count("packets_sent") == 10);
}

TEST_CASE("UDP relay: a level out of range is clamped, and an unknown level is sent as -32768") {
    const RelayFormat format;
    HeardMessage heard{start_of_run, NodeId{0}, NodeId{7}, 3, "x"};
    CHECK(short_at(*format.write(heard), 8) == -32'768);
    heard.level = Dbm{-61.24};
    CHECK(short_at(*format.write(heard), 8) == -612);
    heard.level = Dbm{-1e9};
    CHECK(short_at(*format.write(heard), 8) == -32'767);
    CHECK(short_at(*format.write(heard), 10) == 3);
    CHECK((*format.write(heard))[4] == 7);
}

}  // namespace relay_test
