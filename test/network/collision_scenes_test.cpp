// SPDX-License-Identifier: MIT
// Reception model "collision" with CaptureOrder::first against the receiver of ns-2, frame by frame
// in the order of their beginnings, over random scenes.
#include "models/propagation/list.hpp"
#include "models/reception/collision.hpp"
#include "network/network.hpp"
#include "routing/flood.hpp"
#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

namespace collision_scenes_test {
using namespace rovernet;

namespace {

using namespace std::chrono_literals;

constexpr int levels = 16, robots_of_a_level = 3;
constexpr double highest_level = -40.2;                                      // [dBm]
constexpr double capture_ratio = 10, level_step = 3, large_level_step = 11;  // [dB]
// Between levels that are level_step apart, so that no comparison depends on rounding.
constexpr double sensitivity = -69, carrier_sense = -81;  // [dBm]
constexpr double everything = -250;                       // [dBm] below all levels

/// Frame as it arrives at the receiver; `own`: frame that the receiver's robot sends.
struct Heard {
    Time begin, end;
    double level;
    bool own, is_sensed, is_decodable;

    bool overlaps(const Heard& other) const { return begin < other.end && other.begin < end; }
    bool hides(const Heard& other) const { return level >= other.level + capture_ratio; }
};
using Scene = std::vector<Heard>;

bool is_sent_over(const Scene& scene, const Heard& frame) {
    return std::any_of(scene.begin(), scene.end(),
                       [&](const Heard& each) { return each.own && each.overlaps(frame); });
}

/// Frames that are received, by the receiver of ns-2.35 (Mac802_11::recv, capture, collision and
/// recv_timer). Of frames that begin together, the stronger one comes first.
std::vector<bool> received_by_ns2(const Scene& scene) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < scene.size(); ++i) {
        if (scene[i].is_sensed) order.push_back(i);
    }
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return std::pair(scene[a].begin, -scene[a].level) <
               std::pair(scene[b].begin, -scene[b].level);
    });
    std::vector<bool> received(scene.size());
    enum class State { idle, receiving, collided } state = State::idle;
    std::size_t current = 0;
    const auto run_timer = [&](Time now) {
        if (state == State::idle || scene[current].end > now) return;
        received[current] = state == State::receiving && scene[current].is_decodable &&
                            !is_sent_over(scene, scene[current]);
        state = State::idle;
    };
    for (const std::size_t next : order) {
        run_timer(scene[next].begin);
        if (state == State::idle) {
            state = State::receiving;
            current = next;
        } else if (!scene[current].hides(scene[next])) {
            state = State::collided;
            if (scene[next].end > scene[current].end) current = next;
        }
    }
    run_timer(never);
    return received;
}

/// Frames that are received by the rule of version 1.0.0, which compared a new frame with all
/// frames on air, also with frames that the receiver had ignored.
std::vector<bool> received_by_old_rule(const Scene& scene) {
    const auto is_ignored = [&](const Heard& frame) {
        return std::any_of(scene.begin(), scene.end(), [&](const Heard& each) {
            const bool on_air = each.begin <= frame.begin && frame.begin < each.end;
            return each.is_sensed && on_air && each.hides(frame);
        });
    };
    std::vector<bool> received;
    for (const Heard& frame : scene) {
        const bool is_lost = std::any_of(scene.begin(), scene.end(), [&](const Heard& each) {
            if (&each == &frame || !each.overlaps(frame)) return false;
            if (!each.is_sensed) return each.own;
            return each.begin < frame.begin ? !is_ignored(each) : !frame.hides(each);
        });
        received.push_back(frame.is_decodable && !is_lost);
    }
    return received;
}

/// Receiver, robot 0, and robots around it that hear nothing and send when they are told.
struct Surroundings {
    Network net;
    std::map<std::pair<NodeId, Time>, Fate> fates{};  // by sender and end at the receiver
    bool far;
    double step;
    Radio ear;

    struct Log {
        Surroundings* to;
        KindMask kinds() const { return kind_of<Received>(); }
        void on(const Record& record, const RecordContext&) {
            const auto& received = std::get<Received>(record);
            for (const Reception& r : received.receptions) {
                to->fates[{received.frame.sender, r.time}] = r.fate;
            }
        }
    };

    /// @param is_far  whether levels are lower by distance, or by power in one place
    /// @param steps   difference of levels [dB]; if it is large, the receiver decodes everything
    Surroundings(bool is_far, double steps)
        : net({.propagation = LogDistance{.exponent = 2, .sigma = Db{0}},
               .reception = Collision{.capture_ratio = Db{capture_ratio}},
               .metrics = false}),
          far(is_far),
          step(steps) {
        net.add_sink(Sink{Log{this}});
        net.route(Flood{.ttl = 1});
        const bool all = step == large_level_step;
        ear = {.power = {0},
               .sensitivity = {all ? everything : sensitivity},
               .carrier_sense_threshold = {{all ? everything : carrier_sense}},
               .rate = {1e6},
               .preamble = 0ns};
        net.add({.name = {}, .at = {}, .radio = ear});
        Radio radio = ear;
        radio.sensitivity = Dbm{200};
        radio.carrier_sense_threshold = {};
        for (std::uint32_t node = 1; node <= levels * robots_of_a_level; ++node) {
            if (!far) radio.power = {level_of(node) - highest_level};
            net.add({.name = {}, .at = {distance_of(node), 0}, .radio = radio});
        }
    }
    Surroundings(const Surroundings&) = delete;
    Surroundings& operator=(const Surroundings&) = delete;

    double level_of(std::uint32_t node) const {
        return highest_level - step * ((node - 1) / robots_of_a_level);
    }
    double distance_of(std::uint32_t node) const {
        return far ? std::pow(10, (highest_level - level_of(node)) / 20) : 1;
    }
    /// Sends a frame, and returns it as it arrives at the receiver.
    Heard send(std::uint32_t node, Time begin, std::uint32_t bytes) {
        net.at(begin,
               [this, node, bytes] { net.send(NodeId{node}, everyone, "", {.size = bytes}); });
        const Time end = begin + bytes * 8us;
        if (node == 0) return {begin, end, 0, true, false, false};
        const Duration delay = from_seconds(distance_of(node) / speed_of_light);
        const double level = level_of(node);
        return {begin + delay,
                end + delay,
                level,
                false,
                level >= ear.carrier_sense_threshold->value,
                level >= ear.sensitivity.value};
    }
};

/// Random scene: 3 to 8 frames of different robots, and perhaps one of the receiver's robot. Many
/// begin or end together.
std::vector<std::uint32_t> random_senders(test::Draw& draw) {
    std::vector<std::uint32_t> senders;
    if (draw.below(4) == 0) senders.push_back(0);
    const auto count = senders.size() + 3 + static_cast<std::size_t>(draw.below(6));
    while (senders.size() < count) {
        const auto node = 1 + static_cast<std::uint32_t>(draw.below(levels * robots_of_a_level));
        if (std::find(senders.begin(), senders.end(), node) == senders.end()) {
            senders.push_back(node);
        }
    }
    return senders;
}

struct Counts {
    int received = 0, lost = 0, scenes_that_differ_by_the_old_rule = 0;
};

Counts compare(bool far, int scenes) {
    constexpr Duration apart = 100ms, unit = 80us;  // 10 bytes
    Surroundings around(far, level_step);
    test::Draw draw(far ? 1 : 2);
    std::vector<std::pair<std::vector<std::uint32_t>, Scene>> all;
    for (int i = 0; i < scenes; ++i) {
        const std::vector<std::uint32_t> senders = random_senders(draw);
        const int latest = 5 + draw.below(80), longest = 2 + draw.below(40);
        Scene scene;
        for (const std::uint32_t sender : senders) {
            const Time begin = start_of_run + i * apart + draw.below(latest) * unit;
            const auto bytes = 10 * (1 + static_cast<std::uint32_t>(draw.below(longest)));
            scene.push_back(around.send(sender, begin, bytes));
        }
        all.emplace_back(senders, scene);
    }
    around.net.run_until(start_of_run + scenes * apart);
    Counts counts;
    for (const auto& [senders, scene] : all) {
        const std::vector<bool> expected = received_by_ns2(scene);
        std::vector<bool> received;
        for (std::size_t i = 0; i < scene.size(); ++i) {
            const auto found = around.fates.find({NodeId{senders[i]}, scene[i].end});
            const bool may_decode = scene[i].is_decodable;
            REQUIRE((found != around.fates.end()) == may_decode);
            received.push_back(may_decode && is_decoded(found->second));
            if (may_decode) ++(received.back() ? counts.received : counts.lost);
        }
        REQUIRE(received == expected);
        counts.scenes_that_differ_by_the_old_rule += received_by_old_rule(scene) != expected;
    }
    return counts;
}

}  // namespace

TEST_CASE("collision scenes: the same frames are received as by the receiver of ns-2") {
    for (const bool far : {true, false}) {
        CAPTURE(far);
        const Counts counts = compare(far, 20'000);
        CHECK(counts.received > 10'000);
        CHECK(counts.lost > 20'000);
        CHECK(counts.scenes_that_differ_by_the_old_rule > 50);
    }
}

namespace {

/// Frame of a robot at a level: the number of steps below the highest level.
struct Sent {
    std::uint32_t level_number;
    Duration begin, lasts;
};

/// Whether each frame of a scene is received, which the receiver of ns-2 confirms.
std::vector<bool> received(const std::vector<Sent>& frames, double step = level_step) {
    Surroundings around(false, step);
    Scene scene;
    std::vector<NodeId> senders;
    for (std::uint32_t i = 0; i < frames.size(); ++i) {
        const std::uint32_t first_of_level = 1 + frames[i].level_number * robots_of_a_level;
        senders.emplace_back(first_of_level + i % robots_of_a_level);
        const auto bytes = static_cast<std::uint32_t>(frames[i].lasts / 8us);
        const Time begin = start_of_run + frames[i].begin;
        scene.push_back(
            around.send(static_cast<std::uint32_t>(senders.back().index()), begin, bytes));
    }
    around.net.run_for(1s);
    std::vector<bool> result;
    for (std::size_t i = 0; i < scene.size(); ++i) {
        result.push_back(is_decoded(around.fates.at({senders[i], scene[i].end})));
    }
    CHECK(result == received_by_ns2(scene));
    return result;
}

}  // namespace

TEST_CASE(
    "collision scenes: during an ignored frame, at most one of two overlapping frames is "
    "received") {
    // The first frame hides the second, which lasts longer. While the second is on air, the
    // receiver is free for the third, and then not free for the fourth.
    std::vector<Sent> frames = {{0, 0ms, 1ms}, {1, 500us, 10ms}, {2, 2ms, 3ms}, {3, 3ms, 3ms}};
    CHECK(received(frames, large_level_step) == std::vector{true, false, true, false});
    frames[3].level_number = 2;
    CHECK(received(frames, large_level_step) == std::vector{true, false, false, false});
    frames.pop_back();
    CHECK(received(frames, large_level_step) == std::vector{true, false, true});
}

TEST_CASE(
    "collision scenes: in a chain of overlapping frames, the first frame decides the fate of the "
    "last") {
    // Each frame begins during the one before, and is weaker by the capture ratio. So each second
    // frame is ignored, and the next one finds the receiver free.
    std::vector<Sent> row;
    for (std::uint32_t i = 0; i < 9; ++i) row.push_back({i, i * 800us, 1ms});
    const std::vector<Sent> rest(row.begin() + 1, row.end());
    const std::vector<bool> of_row = received(row, large_level_step);
    for (std::size_t i = 0; i < row.size(); ++i) CHECK(of_row[i] == (i % 2 == 0));
    CHECK_FALSE(received(rest, large_level_step).back());
    // Short frames collide with the others, so that only the last one can be received.
    const auto with_short_frames = [](std::vector<Sent> frames) {
        const std::size_t count = frames.size() - 1;
        for (std::size_t i = 0; i < count; ++i) {
            frames.push_back({frames[i].level_number, frames[i].begin + 80us, 80us});
        }
        return frames;
    };
    CHECK(received(with_short_frames(row), large_level_step)[row.size() - 1]);
    CHECK_FALSE(received(with_short_frames(rest), large_level_step)[rest.size() - 1]);
}

}  // namespace collision_scenes_test
