// SPDX-License-Identifier: MIT
// Shadowing, fading and directional antennas in a running network.
#include "mobility/waypoints.hpp"
#include "network/network.hpp"
#include "test/network/reception_log.hpp"
#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace variation_test {
using namespace rovernet;
using namespace rovernet::test;
using namespace std::chrono_literals;

namespace {

/// Log of all receptions with their levels.
struct LevelLog {
    std::vector<std::tuple<Time, NodeId, Fate, double>> all{};
    KindMask kinds() const { return kind_of<Received>() | kind_levels; }
    void on(const Record& record, const RecordContext&) {
        const auto& received = std::get<Received>(record);
        for (std::size_t i = 0; i < received.receptions.size(); ++i) {
            const Reception& r = received.receptions[i];
            all.emplace_back(r.time, r.node, r.fate, received.levels[i].value);
        }
    }
};

struct Variation {
    Shadowing shadowing = {};
    Fading fading = {};
    bool directional = false;
};

constexpr std::uint32_t robots = 30;

/// A flood among robots that drive, turn before they drive, or rest.
/// @param slices  calls of run_until() that the run is cut into
std::shared_ptr<LevelLog> play(const Variation& v, const ReceptionModel& reception,
                               const AccessModel& access, bool reference, int slices = 1) {
    Network net({.seed = 3,
                 .propagation = Friis{},
                 .shadowing = v.shadowing,
                 .fading = v.fading,
                 .reception = reception,
                 .access = access,
                 .reference = reference,
                 .metrics = false});
    auto log = std::make_shared<LevelLog>();
    net.add_sink(Sink{log});
    net.route(Flood{.ttl = 3, .jitter = 2ms});
    Draw draw(5);
    for (std::uint32_t i = 0; i < robots; ++i) {
        const auto place = [&] { return Vec3{draw.uniform(0, 300), draw.uniform(0, 300), 0}; };
        Radio radio{.sensitivity = {-65}, .carrier_sense_threshold = {{-72}}};
        if (v.directional && i % 3 > 0) {
            radio.antenna = AntennaShape::cosine;
            radio.antenna_direction = Radians{draw.uniform(-3, 3)};
        }
        Movement move = Fixed{};
        if (i % 3 > 0) move = Waypoints{.path = {place(), place()}, .speed = {20}};
        net.add({.name = {},
                 .at = place(),
                 .radio = radio,
                 .move = move,
                 .turn_rate = i % 2 ? std::optional(RadiansPerSecond{1}) : std::nullopt});
    }
    for (std::uint32_t i = 0; i < robots; ++i) {
        for (int k = 0; k < 2; ++k) {
            const Time t = start_of_run + k * 3s + (i % 7) * 100us;
            net.at(t, [&net, i] { net.send(NodeId{i}, everyone, "x", {.size = 200}); });
        }
    }
    const Duration slice = Duration{6s} / slices;
    for (int i = 1; i <= slices; ++i) net.run_until(start_of_run + i * slice);
    return log;
}

const std::vector<Variation>& variations() {
    static const Shadowing field{.model = ShadowingModel::field, .sigma = Db{6}};
    static const std::vector<Variation> all = {
        {field},
        {{.model = ShadowingModel::link, .sigma = Db{6}}, {.model = FadingModel::rayleigh}},
        {{}, {.model = FadingModel::nakagami, .coherence = Coherence::place}},
        {field, {.model = FadingModel::rician}, true}};
    return all;
}

}  // namespace

TEST_CASE(
    "variation: with shadowing and fading, fast mode and reference mode give the same receptions") {
    const std::vector<ReceptionModel> receptions = {Sinr{}, Collision{.capture_ratio = Db{6}},
                                                    Threshold{}, Collision{.capture_ratio = Db{6}}};
    for (std::size_t i = 0; i < variations().size(); ++i) {
        CAPTURE(i);
        const auto fast = play(variations()[i], receptions[i], NoAccess{}, false);
        CHECK(fast->all.size() > 200);
        CHECK(fast->all == play(variations()[i], receptions[i], NoAccess{}, true)->all);
    }
}

TEST_CASE(
    "variation: with shadowing, fading and csma, fast mode and reference mode give the same "
    "receptions") {
    const auto fast = play(variations()[3], Sinr{}, Csma{}, false);
    CHECK(fast->all.size() > 200);
    CHECK(fast->all == play(variations()[3], Sinr{}, Csma{}, true)->all);
}

TEST_CASE(
    "variation: with shadowing and fading, a run in 1000 steps has the same levels as an undivided "
    "run") {
    for (const Variation& v : {variations()[2], variations()[3]}) {
        CHECK(play(v, Threshold{}, NoAccess{}, false)->all ==
              play(v, Threshold{}, NoAccess{}, false, 1000)->all);
    }
}

TEST_CASE(
    "variation: the level of a received frame, including its fading, is at least the sensitivity") {
    int strong = 0;
    const auto log = play(variations()[1], Threshold{}, NoAccess{}, false);
    for (const auto& [time, node, fate, level] : log->all) {
        CHECK(level >= -65);
        strong += level > -60;
    }
    CHECK(strong > 100);
}

}  // namespace variation_test
