// SPDX-License-Identifier: MIT
#include "live/emulate/ethernet.hpp"

#include "test/live/emulate/programs.hpp"

#include <doctest/doctest.h>

#include <stdexcept>

namespace ethernet_test {
using namespace rovernet;
using namespace rovernet::test;
using namespace std::chrono_literals;
using namespace std::string_literals;

namespace {

const std::string a = "\x02\x00\x00\x00\x00\x01"s, b = "\x02\x00\x00\x00\x00\x02"s,
                  c = "\x02\x00\x00\x00\x00\x03"s, broadcast = "\xff\xff\xff\xff\xff\xff"s;

/// Request for the address of 10.0.0.2, as a kernel sends it (RFC 826): 14 + 28 bytes.
const std::string arp_request = broadcast + a + "\x08\x06\x00\x01\x08\x00\x06\x04\x00\x01"s + a +
                                "\x0a\x00\x00\x01"s + "\x00\x00\x00\x00\x00\x00\x0a\x00\x00\x02"s;

std::string frame(const std::string& to, const std::string& from, std::size_t payload) {
    return to + from + "\x08\x00"s + std::string(payload, 'p');
}

Programs programs_of(const std::string& more = {}) {
    return {std::make_unique<EthernetFormat>(), three_in_a_row(more)};
}

}  // namespace

TEST_CASE(
    "ethernet: a frame arrives unchanged, after the airtime of the frame without its header") {
    Programs programs = programs_of();
    programs.send(0, arp_request);
    programs.run_to(start_of_run + 100ms);
    REQUIRE(programs.got.size() == 1);  // C is out of range
    CHECK(programs.got[0].robot == NodeId{1});
    CHECK(programs.got[0].bytes == arp_request);
    // 28 bytes at 11 Mb/s behind the preamble, 150 m of way, and 1 us until the robot reacts.
    constexpr Duration on_air = 192us + 20'364ns;
    const Duration took = programs.got[0].time - start_of_run;
    CHECK(took >= on_air + 1us);
    CHECK(took <= on_air + 2us);
}

TEST_CASE(
    "ethernet: a frame to a robot's MAC address is sent as a unicast, to a group address as a "
    "broadcast") {
    Programs programs = programs_of();
    programs.send(1, frame(c, b, 100));
    programs.run_to(start_of_run + 10ms);
    REQUIRE(programs.got.size() == 1);
    CHECK(programs.got[0].robot == NodeId{2});
    for (const std::string& group :
         {broadcast, "\x33\x33\x00\x00\x00\x01"s, "\x01\x00\x5e\x00\x00\x01"s}) {
        programs.got.clear();
        programs.send(1, frame(group, b, 100));
        programs.run_to(programs.session().network().now() + 10ms);
        CHECK(programs.got.size() == 2);
    }
}

TEST_CASE(
    "ethernet: with the model `csma`, a unicast is acknowledged and repeated, a broadcast is not") {
    const std::string lossy =
        "[access]\nmodel = \"csma\"\n[[robot]]\nname = \"D\"\n"
        "at = [\"0 m\", \"150 m\"]\nradio = { success_rate = 0.5 }\n";
    Programs programs = programs_of(lossy);
    const std::string d = "\x02\x00\x00\x00\x00\x04"s;
    constexpr int trials = 200;
    for (int i = 0; i < trials; ++i) {
        programs.send(3, frame(i % 2 == 0 ? a : broadcast, d, 50));
        programs.run_to(programs.session().network().now() + 9ms);
    }
    int unicasts = 0, broadcasts = 0;
    for (const auto& packet : programs.got) {
        if (packet.robot == NodeId{0}) ++(packet.bytes.starts_with(a) ? unicasts : broadcasts);
    }
    // Half of D's frames get through; a frame is sent up to 7 times, and 0.5^7 < 1 %.
    CHECK(unicasts >= 97);
    constexpr int four_sigma = 20;  // of the binomial distribution of 100 draws at 0.5
    CHECK(std::abs(broadcasts - 50) <= four_sigma);
}

TEST_CASE("ethernet: frames to unknown addresses, or without a header, are dropped and counted") {
    Programs programs = programs_of();
    programs.send(0, frame("\x02\x00\x00\x00\x00\x09"s, a, 100));
    programs.send(0, frame(a, a, 100));
    CHECK(programs.count("unknown_destination") == 2);
    programs.send(0, "");
    programs.send(0, frame(b, a, 0).substr(0, 13));
    programs.send(0, frame(b, a, longest_message));
    CHECK(programs.count("malformed") == 3);
    programs.send(0, frame(b, a, 0));
    programs.run_to(start_of_run + 100ms);
    CHECK(programs.got.size() == 1);
}

TEST_CASE("ethernet: programs get only messages that are Ethernet frames for their robot") {
    Programs programs =
        programs_of("[[traffic]]\nfrom = \"B\"\npayload = \"not to your address\"\n");
    programs.run_to(start_of_run + 1s);
    CHECK(programs.got.empty());
}

TEST_CASE("ethernet: the text of a MAC address is read as bytes, and invalid text is refused") {
    CHECK(mac_bytes("02:00:00:00:00:01") == a);
    CHECK(mac_bytes("AA:bb:0c:d0:00:ff") == "\xaa\xbb\x0c\xd0\x00\xff"s);
    for (const char* bad :
         {"", "02:00:00:00:00", "02:00:00:00:00:01:02", "02-00-00-00-00-01", "02:00:00:00:00:0g",
          "01:00:5e:00:00:01", "ff:ff:ff:ff:ff:ff", "02:00:00:00:00:+1", "0 2:00:00:00:00:1"}) {
        CAPTURE(bad);
        CHECK_FALSE(mac_bytes(bad));
    }
    CHECK_THROWS_AS(programs_of("[[robot]]\nname = \"D\"\nat = [\"0 m\", \"0 m\"]\n"
                                "radio = { mac = \"mine\" }\n"),
                    std::invalid_argument);
}

}  // namespace ethernet_test
