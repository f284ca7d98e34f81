// SPDX-License-Identifier: MIT
#include "mobility/files/movement_writer.hpp"

#include "test/mobility/files/playback.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace movement_writer_test {
using namespace rovernet;
using test::Playback;
using test::TemporaryFolder;

namespace {

Time at(double s) { return start_of_run + from_seconds(s); }

Leg leg(double start, double end, Vec3 from, Vec3 to) {
    return {.start = at(start),
            .end = at(end),
            .from = from,
            .velocity = (1 / (end - start)) * (to - from),
            .to = to};
}
Leg rest(double start, Vec3 where) {
    return {.start = at(start), .end = never, .from = where, .velocity = {}, .to = where};
}

Vec3 position(const Track& track, Time t) {
    const Leg* last = &track.legs.front();
    for (const Leg& l : track.legs) {
        if (l.start <= t) last = &l;
    }
    return t < last->start ? last->from : last->position(t);
}

/// Robots that go here and there until `end`, rest at times, and are now and then sent elsewhere.
std::vector<Track> wanderers(int count, double end, bool climb) {
    std::mt19937 draw(4);
    const auto uniform = [&](double low, double high) {
        return low + (high - low) * (static_cast<double>(draw()) / 4294967296.0);
    };
    std::vector<Track> tracks;
    for (int i = 0; i < count; ++i) {
        Track track{"r" + std::to_string(i), {}};
        const auto somewhere = [&] {
            return Vec3{uniform(1, 900), uniform(1, 400), climb ? uniform(0, 30) : 0};
        };
        Vec3 here = somewhere();
        for (Time now = start_of_run; now < at(end);) {
            const Vec3 to = somewhere();
            const double duration = uniform(1, 90);
            const Time start = now;
            if (draw() % 4 == 0) {
                track.legs.push_back({.start = now,
                                      .end = now + from_seconds(duration),
                                      .from = here,
                                      .velocity = {},
                                      .to = here});
                now = track.legs.back().end;
                continue;
            }
            track.legs.push_back({.start = start,
                                  .end = start + from_seconds(duration),
                                  .from = here,
                                  .velocity = (1 / seconds(from_seconds(duration))) * (to - here),
                                  .to = to});
            now = track.legs.back().end;
            if (draw() % 3 == 0) now = start + from_seconds(duration * uniform(0.1, 0.9));
            here = track.legs.back().position(now);
        }
        tracks.push_back(std::move(track));
    }
    return tracks;
}

/// The greatest distance [m] between the tracks and what is read from `text`, where the height
/// counts or not.
double error_of(const std::vector<Track>& tracks, const std::string& text, double end,
                bool height) {
    const TemporaryFolder folder;
    const Playback p(folder.write("file", text));
    double worst = 0;
    REQUIRE(p.file.robots().size() == tracks.size());
    for (std::size_t i = 0; i < tracks.size(); ++i) {
        for (double t = 0; t <= end; t += end / 997) {
            Vec3 a = position(tracks[i], at(t));
            Vec3 b = p.position("n" + std::to_string(i), seconds(at(t)));
            if (!height) a.z = b.z = 0;
            worst = std::max(worst, distance(a, b));
        }
    }
    return worst;
}

constexpr double duration = 1'000;  // [s]
/// Half the last digit of a speed, 5e-13 m/s, over 1000 s, places to 5e-10 m and rounding.
constexpr double setdest_tolerance = 1e-8;  // [m]
/// Half the last digit of a coordinate, twice, and rounding.
constexpr double bonnmotion_tolerance = 2e-9;  // [m]

}  // namespace

TEST_CASE("writer: tracks written as an ns-2 movement file are read back as the same motion") {
    const auto tracks = wanderers(20, duration, false);
    CHECK(error_of(tracks, setdest_text(tracks, at(duration)), duration, true) < setdest_tolerance);
}

TEST_CASE("writer: in an ns-2 movement file, climbing robots keep their horizontal motion") {
    const auto tracks = wanderers(20, duration, true);
    CHECK(error_of(tracks, setdest_text(tracks, at(duration)), duration, false) <
          setdest_tolerance);
}

TEST_CASE("writer: tracks written for BonnMotion are read back as the same motion") {
    for (const bool climb : {false, true}) {
        const auto tracks = wanderers(20, duration, climb);
        const auto text = bonnmotion_text(tracks, at(duration));
        CHECK(error_of(tracks, text, duration, true) < bonnmotion_tolerance);
    }
}

TEST_CASE("writer: an ns-2 movement file has the expected lines") {
    const std::vector<Track> tracks = {
        {"a", {leg(0, 10, {1, 2, 3}, {11, 2, 3}), rest(10, {11, 2, 3})}},
        {"b", {rest(0, {50, 60, 0})}},
        {"c", {rest(0, {7, 7, 0}), leg(2.5, 6.5, {7, 7, 0}, {7, 9, 0})}}};
    CHECK(setdest_text(tracks, at(100)) ==
          "# nodes: 3, max x: 50.00, max y: 60.00\n"
          "# ns-2 ends with an error if a target is outside of the field; write load_flatgrid 51 "
          "61, or larger numbers\n"
          "# a -> $node_(0)\n"
          "# b -> $node_(1)\n"
          "# c -> $node_(2)\n"
          "$node_(0) set X_ 1.000000000\n"
          "$node_(0) set Y_ 2.000000000\n"
          "$node_(0) set Z_ 3.000000000\n"
          "$node_(1) set X_ 50.000000000\n"
          "$node_(1) set Y_ 60.000000000\n"
          "$node_(1) set Z_ 0.000000000\n"
          "$node_(2) set X_ 7.000000000\n"
          "$node_(2) set Y_ 7.000000000\n"
          "$node_(2) set Z_ 0.000000000\n"
          "$ns_ at 0.000000000 \"$node_(0) setdest 11.000000000 2.000000000 "
          "1.000000000000\"\n"
          "$ns_ at 2.500000000 \"$node_(2) setdest 7.000000000 9.000000000 "
          "0.500000000000\"\n");
}

TEST_CASE(
    "writer: a comment in an ns-2 file warns if a position has an x or y that is not above 0") {
    const std::vector<Track> tracks = {{"a", {leg(0, 10, {0, 2, 0}, {-3.5, 2, 0})}}};
    CHECK(setdest_text(tracks, at(100))
              .find("# ns-2 also ends with an error if x or y of a target is not above 0; the "
                    "smallest x in this file is -3.50, the smallest y is 2.00\n") !=
          std::string::npos);
}

TEST_CASE(
    "writer: the robot n5 becomes node 5 of an ns-2 file; names of another form are in comments") {
    const auto numbers = [](const std::vector<std::string>& names) {
        std::vector<Track> tracks;
        for (const std::string& each : names) tracks.push_back({each, {rest(0, {1, 1, 0})}});
        return node_numbers(tracks);
    };
    using Numbers = std::vector<std::uint32_t>;
    CHECK(numbers({"n5", "n0", "n9999999"}) == Numbers{5, 0, 9999999});
    for (const std::string other : {"flow.0", "n", "n05", "n10000000", "m1", "n1 "}) {
        CAPTURE(other);
        CHECK(numbers({"n5", other}) == Numbers{0, 1});
    }
    const std::vector<Track> kept = {{"n5", {leg(0, 1, {1, 1, 0}, {2, 1, 0})}}};
    const std::string text = setdest_text(kept, at(1));
    CHECK(text.find("$node_(5) set X_ 1.000000000\n") != text.npos);
    CHECK(text.find("\"$node_(5) setdest 2.000000000") != text.npos);
    CHECK(text.find("$node_(0)") == text.npos);
    CHECK(text.find("->") == text.npos);
    const std::vector<Track> mixed = {{"n0", {rest(0, {1, 1, 0})}}, {"a\nb", {rest(0, {1, 1, 0})}}};
    const std::string renamed = setdest_text(mixed, at(1));
    CHECK(renamed.find("# a b -> $node_(1)\n") != renamed.npos);
    CHECK(renamed.find("# n0") == renamed.npos);
}

TEST_CASE("writer: a BonnMotion file has the expected positions and parameters") {
    const std::vector<Track> flat = {
        {"a", {leg(0, 10, {1, 2, 0}, {11, 2, 0}), rest(10, {11, 2, 0})}},
        {"b", {rest(0, {5, 6, 0})}}};
    CHECK(bonnmotion_text(flat, at(20)) ==
          "0.000000000 1.000000000 2.000000000 10.000000000 11.000000000 2.000000000 20.000000000 "
          "11.000000000 2.000000000\n"
          "0.000000000 5.000000000 6.000000000 20.000000000 5.000000000 6.000000000\n");
    CHECK(bonnmotion_params(flat, at(20)) ==
          "model=rovernet\nignore=0.0\nrandomSeed=0\nx=11.000000000\ny=6.000000000\n"
          "duration=20.000000000\nnn=2\ncircular=false\n");
    const std::vector<Track> high = {{"a", {rest(0, {5, 6, -7})}}};
    CHECK(bonnmotion_text(high, at(20)).starts_with("0.000000000 5.000000000 6.000000000 -7.0"));
    CHECK(bonnmotion_params(high, at(20)).find("J=3D\n") != std::string::npos);
}

TEST_CASE("writer: the .params file states that BonnMotion positions have a z coordinate") {
    const TemporaryFolder folder;
    // A single node, three places in space: twelve numbers.
    const std::vector<Track> tracks = {
        {"a", {leg(0, 1, {0, 0, 0.5}, {2, 0, 2}), leg(1, 2, {2, 0, 2}, {2, 9, 9})}}};
    folder.write("out.params", bonnmotion_params(tracks, at(2)));
    const Playback p(folder.write("out.movements", bonnmotion_text(tracks, at(2))));
    CHECK(p.file.robots()[0].start == Vec3{0, 0, 0.5});
    CHECK(distance(p.position("n0", 1.5), {2, 4.5, 5.5}) < bonnmotion_tolerance);
}

TEST_CASE("writer: a motion that is cut off by the end time is written up to that time") {
    const std::vector<Track> tracks = {
        {"a", {leg(0, 10, {1, 1, 0}, {11, 1, 0}), leg(10, 20, {11, 1, 0}, {1, 1, 0})}}};
    const auto text = setdest_text(tracks, at(4));
    CHECK(text.ends_with(
        "$ns_ at 0.000000000 \"$node_(0) setdest 5.000000000 1.000000000 1.000000000000\"\n"));
    CHECK(bonnmotion_text(tracks, at(4)).ends_with(" 4.000000000 5.000000000 1.000000000\n"));
}

TEST_CASE("writer: an endless motion without an end time is refused") {
    Track track{"a", {rest(0, {1, 1, 0})}};
    track.legs[0].velocity = {2, 0, 0};
    const std::vector<Track> tracks = {track};
    CHECK(setdest_text(tracks, at(3)).find("setdest 7.000000000 1.0") != std::string::npos);
    CHECK_THROWS_AS(setdest_text(tracks, never), std::invalid_argument);
    CHECK_THROWS_AS(bonnmotion_text(tracks, never), std::invalid_argument);
    const std::vector<Track> nothing = {{"a", {}}};
    CHECK_THROWS_AS(setdest_text(nothing, at(3)), std::invalid_argument);
    CHECK_THROWS_AS(bonnmotion_params(nothing, at(3)), std::invalid_argument);
    const std::vector<Track> still = {{"a", {rest(0, {1, 1, 0})}}};
    CHECK(bonnmotion_text(still, never) == "0.000000000 1.000000000 1.000000000\n");
    CHECK(setdest_text({}, at(3)).starts_with("# nodes: 0"));
}

TEST_CASE("writer: a robot rests between two legs (pieces of movement), and after the last leg") {
    const std::vector<Track> tracks = {
        {"a", {leg(1, 3, {1, 1, 0}, {5, 1, 0}), leg(7, 9, {5, 1, 0}, {5, 9, 0})}}};
    CHECK(bonnmotion_text(tracks, at(10)) ==
          "1.000000000 1.000000000 1.000000000 3.000000000 5.000000000 1.000000000 "
          "7.000000000 5.000000000 1.000000000 9.000000000 5.000000000 9.000000000 "
          "10.000000000 5.000000000 9.000000000\n");
    const TemporaryFolder folder;
    const Playback p(folder.write("file", setdest_text(tracks, at(10))));
    CHECK(p.commands.size() == 2);
    CHECK(distance(p.position("n0", 5), {5, 1, 0}) < setdest_tolerance);
    CHECK(distance(p.position("n0", 8), {5, 5, 0}) < setdest_tolerance);
}

TEST_CASE("writer: a robot's jump is written as a jump in ns-2 and in BonnMotion files") {
    const std::vector<Track> tracks = {
        {"a",
         {leg(0, 10, {1, 1, 0}, {11, 1, 0}), leg(5, 10, {50, 60, 7}, {55, 60, 7}),
          rest(10, {55, 60, 7}), rest(20, {5, 5, 7})}},
    };
    const std::string setdest = setdest_text(tracks, never);
    CHECK(setdest.find("$ns_ at 20.000000000 \"$node_(0) setdest 5.000000000 5.000000000 0\"\n"
                       "$ns_ at 20.000000000 \"$node_(0) set X_ 5.000000000\"\n") !=
          std::string::npos);
    CHECK(setdest.starts_with("# nodes: 1, max x: 55.00, max y: 60.00\n"));
    const TemporaryFolder folder;
    for (const auto& text : {setdest, bonnmotion_text(tracks, never)}) {
        const Playback p(folder.write("file", text));
        CHECK(distance(p.position("n0", 4.999), {5.999, 1, 0}) < setdest_tolerance);
        CHECK(distance(p.position("n0", 6), {51, 60, 7}) < setdest_tolerance);
        CHECK(distance(p.position("n0", 15), {55, 60, 7}) < setdest_tolerance);
        CHECK(distance(p.position("n0", 21), {5, 5, 7}) < setdest_tolerance);
    }
}

}  // namespace movement_writer_test
