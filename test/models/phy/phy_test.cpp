// SPDX-License-Identifier: MIT
#include "models/phy/phy.hpp"

#include "models/phy/error_rate.hpp"
#include "models/phy/wifi.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

namespace phy_test {
using namespace rovernet;

namespace {

/// Physical layers that there are: each has to pass the tests below.
using PhysicalLayers = std::tuple<Wifi>;

/// Time on air of a frame.
Duration airtime(const Phy& phy, Duration preamble, BitRate rate, std::uint32_t bytes) {
    Radio radio;
    radio.preamble = preamble;
    return phy.transmission(radio, rate, bytes).airtime();
}

/// Calls visit(phy) for every physical layer, with its defaults.
template <class Visit>
void for_each_phy(Visit visit) {
    std::apply([&](const auto&... each) { (visit(Phy(each)), ...); }, PhysicalLayers{});
}

}  // namespace

TEST_CASE(
    "every phy: an empty frame takes the time of its preamble; adding bytes never shortens the "
    "time") {
    for_each_phy([](const Phy& phy) {
        for (const BitRate rate : phy.rates()) {
            CHECK(airtime(phy, Duration{5'000}, rate, 0) == Duration{5'000});
            Duration before{0};
            for (std::uint32_t bytes = 0; bytes < 300; ++bytes) {
                const Duration now = airtime(phy, Duration{5'000}, rate, bytes);
                CHECK(now >= before);
                before = now;
            }
        }
    });
}

TEST_CASE(
    "every phy: the success probability grows with the SINR, and is 1 at the SINR `certain_sinr`") {
    for_each_phy([](const Phy& phy) {
        for (const BitRate rate : phy.rates()) {
            REQUIRE(phy.coding(rate));
            double before = -std::log(2.0) - 1e-12;
            for (double db = -30; db < 40; db += 0.5) {
                const double now = phy.log_success(*phy.coding(rate), std::pow(10, db / 10));
                CHECK(now >= before);
                CHECK(now <= 0);
                before = now;
            }
            const double enough = std::pow(10, phy.certain_sinr(*phy.coding(rate)).value / 10);
            CHECK(std::exp(8e4 * phy.log_success(*phy.coding(rate), enough)) == 1);
        }
    });
}

TEST_CASE("every phy: a bit rate that the phy does not list has no coding") {
    for_each_phy([](const Phy& phy) {
        CHECK(!phy.coding({3.25e6}));
        CHECK(!phy.coding({0}));
    });
}

TEST_CASE("wifi: there are twelve bit rates, with the error rates of their modulations") {
    const Phy phy = Wifi{};
    CHECK(phy.rates().size() == 12);
    CHECK(phy.log_success(*phy.coding(54_Mbps), 30) == log_success(Modulation::ofdm_54, 30));
    CHECK(phy.certain_sinr(*phy.coding(1_Mbps)) == certain_sinr(Modulation::dsss_1));
}

TEST_CASE("wifi: 802.11a data takes whole symbols, 802.11b data takes whole microseconds") {
    // 802.11-2020, 17.4.3: 16 + 8 n + 6 bits in symbols of 216 bits, 4 us each; 106 bytes and the
    // tail just do not fit into four.
    for (const auto& [bytes, symbols] : {std::pair{105U, 4}, {106U, 5}}) {
        CHECK(airtime(Wifi{WifiStandard::a}, Duration{20'000}, 54_Mbps, bytes) ==
              Duration{20'000 + symbols * 4'000});
    }
    CHECK(airtime(Wifi{WifiStandard::b}, Duration{192'000}, 11_Mbps, 64) ==
          Duration{192'000 + 47'000});
}

TEST_CASE("wifi: 64 bytes at 11 Mb/s after a long preamble take 238,545 ns") {
    CHECK(airtime(Wifi{}, Duration{192'000}, 11_Mbps, 64) ==
          Duration{192'000 + 46'545});  // 512 / 11 us = 46.5454 us
}

TEST_CASE(
    "wifi: airtime is rounded to the nearest nanosecond; an empty frame takes the time of the "
    "preamble") {
    CHECK(airtime(Wifi{}, Duration{192'000}, 11_Mbps, 0) == Duration{192'000});
    CHECK(airtime(Wifi{}, Duration{0}, 11_Mbps, 1) == Duration{727});
    CHECK(airtime(Wifi{}, Duration{0}, 3_Mbps, 1) == Duration{2667});
    CHECK(airtime(Wifi{}, Duration{0}, 1_Mbps, 0xffffffff) == Duration{34'359'738'360'000});
}

}  // namespace phy_test
