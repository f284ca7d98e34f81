// SPDX-License-Identifier: MIT
#include "experiment/build.hpp"
#include "scenario/document/toml.hpp"
#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace file_order_test {
using namespace rovernet;

namespace {

/// A small random scenario in whole metres and milliseconds, so that turning and shifting it rounds
/// nothing, and full of ties: places on a grid, sendings and movements at the same time.
struct Small {
    struct Robot {
        std::string name, rest;
        int x, y;
        std::vector<std::pair<int, int>> way;  ///< waypoints; none: it stays
    };
    struct Traffic {
        std::string from, rest;
        int start_ms;
    };

    std::string head;
    std::vector<Robot> robots{};
    std::vector<Traffic> traffic{};
    int side_m = 0;
    bool moves = false;

    explicit Small(std::uint32_t seed);
    std::string text() const;
};

Small::Small(std::uint32_t seed) {
    test::Draw draw(seed);
    const auto one_of = [&](std::vector<std::string> words) {
        return words[static_cast<std::size_t>(draw.below(static_cast<int>(words.size())))];
    };
    const std::string reception = one_of({"threshold", "collision", "sinr"});
    std::string model = one_of({"disc\"\nrange = \"45 m", "friis", "log_distance", "two_ray"});
    if (reception == "sinr" && model.starts_with("disc")) model = "friis";
    head = fmt::format(
        "[scenario]\nduration = \"20 s\"\nseed = {}\n[propagation]\nmodel = \"{}\"\n[reception]\n"
        "model = \"{}\"\n{}[access]\nmodel = \"{}\"\n[medium]\npropagation_delay = {}\n"
        "[radio]\nsensitivity = \"-70 dBm\"\n[routing]\nttl = 3\nduplicates = \"{}\"\n"
        "upgrade = {}\njitter = \"{}\"\n",
        seed, model, reception,
        reception == "collision" ? fmt::format("capture = \"{}\"\n", one_of({"first", "later"}))
                                 : "",
        one_of({"none", "aloha", "csma"}), one_of({"true", "false"}),
        one_of({"suppress", "forward"}), one_of({"true", "false"}), one_of({"0 s", "10 ms"}));
    const int grid = 10 + 10 * draw.below(3);
    side_m = 5 * grid;
    moves = draw.below(2) == 0;
    const int count = 3 + draw.below(6);
    for (int i = 0; i < count; ++i) {
        Robot robot{fmt::format("{}{}", one_of({"q", "b", "z", "k"}), i),
                    "",
                    grid * draw.below(5),
                    grid * draw.below(5),
                    {}};
        if (moves && draw.below(2)) robot.way = {{grid * draw.below(5), grid * draw.below(5)}};
        if (draw.below(4) == 0) robot.rest += "on_receive = { send = \"heard\" }\n";
        if (moves && draw.below(4) == 0) robot.rest += "on_arrival = { send = \"there\" }\n";
        if (moves && draw.below(3) == 0) robot.rest += "on_link_lost = { send = \"lost\" }\n";
        if (draw.below(5) == 0) robot.rest += "off = [\"5 s\"]\non = [\"7 s\"]\n";
        if (draw.below(5) == 0) robot.rest += "on_time = { time = \"5 s\", send = \"five\" }\n";
        robots.push_back(robot);
    }
    for (const Robot& robot : robots) {
        if (draw.below(3) == 0) continue;
        const Robot& other = robots[static_cast<std::size_t>(draw.below(count))];
        const bool to_one = draw.below(4) == 0 && other.name != robot.name;
        traffic.push_back(
            {robot.name,
             fmt::format(
                 "every = \"{}\"\ncount = 3\nsize = \"{} B\"\n{}", one_of({"1 s", "500 ms"}),
                 one_of({"20", "200"}),
                 to_one ? fmt::format("kind = \"unicast\"\nto = \"{}\"\n", other.name) : ""),
             1000 * draw.below(3)});
    }
}

std::string Small::text() const {
    std::string all = head;
    for (const Robot& r : robots) {
        all += fmt::format("[[robot]]\nname = \"{}\"\nat = [\"{} m\", \"{} m\"]\n{}", r.name, r.x,
                           r.y, r.rest);
        for (const auto& [x, y] : r.way) {
            all += fmt::format(
                "move = {{ model = \"waypoints\", path = [[\"{} m\", \"{} m\"]], speed = \"5 m/s\" "
                "}}\n",
                x, y);
        }
    }
    for (const Traffic& t : traffic) {
        all += fmt::format("[[traffic]]\nfrom = \"{}\"\nstart = \"{} ms\"\n{}", t.from, t.start_ms,
                           t.rest);
    }
    return all;
}

/// What happened, by names: nothing in it depends on a robot's number.
struct Story {
    using Event = std::tuple<Time, int, std::string, std::string, std::uint64_t, std::uint64_t, int,
                             int, int>;

    const Network* net;
    Duration shift{0};
    std::vector<Event> events{};

    KindMask kinds() const {
        return kind_of<Transmitted>() | kind_of<Received>() | kind_of<Dropped>() | kind_of<Sent>() |
               kind_of<Switched>() | kind_of<Arrived>();
    }
    void on(const Record& record, const RecordContext& context) {
        const auto add = [&](Time time, int what, NodeId node, const Frame* f, int fate, int more) {
            events.emplace_back(time - shift, what, net->name(node),
                                f ? net->name(f->sender) : std::string(),
                                f ? context.messages[f->message].key : 0, f ? f->path : 0,
                                f ? f->ttl : 0, fate, more);
        };
        if (const auto* sent = std::get_if<Transmitted>(&record))
            add(sent->time, 1, sent->frame.sender, &sent->frame, 0, 0);
        if (const auto* drop = std::get_if<Dropped>(&record))
            add(drop->time, 2, drop->node, &drop->frame, static_cast<int>(drop->reason), 0);
        if (const auto* said = std::get_if<Sent>(&record)) add(said->time, 3, said->node, {}, 0, 0);
        if (const auto* there = std::get_if<Arrived>(&record))
            add(there->time, 4, there->node, {}, 0, 0);
        const auto* received = std::get_if<Received>(&record);
        if (!received) return;
        for (const Reception& r : received->receptions)
            add(r.time, 5, r.node, &received->frame, static_cast<int>(r.fate), r.delivered);
    }
};

/// The events of a scenario but for those of the robot "far", in an order of their own.
std::vector<Story::Event> story_of(const Small& small, Duration shift = Duration{0}) {
    const Scenario scenario = read_scenario(parse_toml(small.text(), "s.toml"), "s.toml");
    Network network(network_settings(scenario));
    const auto story = std::make_shared<Story>(Story{&network, shift});
    network.add_sink(Sink{story});
    populate(network, scenario);
    network.run_until(start_of_run + scenario.scenario.duration + shift);
    std::erase_if(story->events, [](const auto& e) { return std::get<2>(e) == "far"; });
    std::sort(story->events.begin(), story->events.end());
    return story->events;
}

template <class Change>
Small changed(Small small, Change change) {
    const auto place = [&](int& x, int& y) { std::tie(x, y) = change(x, y); };
    for (auto& r : small.robots) {
        place(r.x, r.y);
        for (auto& [x, y] : r.way) place(x, y);
    }
    return small;
}

constexpr std::uint32_t scenarios = 100;

}  // namespace

TEST_CASE("the order of robots and traffic in the file does not change the results") {
    std::size_t events = 0;
    for (std::uint32_t seed = 1; seed <= scenarios; ++seed) {
        CAPTURE(seed);
        const Small small(seed);
        const auto story = story_of(small);
        events += story.size();
        Small other = small;
        std::reverse(other.robots.begin(), other.robots.end());
        CHECK(story_of(other) == story);
        std::reverse(other.traffic.begin(), other.traffic.end());
        CHECK(story_of(other) == story);
        std::sort(other.robots.begin(), other.robots.end(),
                  [](const auto& a, const auto& b) { return a.name < b.name; });
        CHECK(story_of(other) == story);
    }
    CHECK(events > 5000);
}

TEST_CASE("a rotated, mirrored or shifted scenario gives the same results") {
    for (std::uint32_t seed = 1; seed <= scenarios; seed += 2) {
        CAPTURE(seed);
        const Small small(seed);
        const auto story = story_of(small);
        CHECK(story_of(changed(small, [](int x, int y) { return std::pair(-y, x); })) == story);
        CHECK(story_of(changed(small, [](int x, int y) { return std::pair(-x, y); })) == story);
        CHECK(story_of(changed(
                  small, [](int x, int y) { return std::pair(x + 1024, y - 4096); })) == story);
    }
}

TEST_CASE("robots at rest have the same links a second later") {
    int stood = 0;
    for (std::uint32_t seed = 1; seed <= scenarios; ++seed) {
        CAPTURE(seed);
        Small small(seed);
        if (small.moves) continue;
        for (auto& robot : small.robots) robot.rest.clear();  // they tell times of the run
        ++stood;
        Small later = small;
        for (auto& t : later.traffic) t.start_ms += 1000;
        const auto story = story_of(small), shifted = story_of(later, std::chrono::seconds{1});
        const auto is_arrival = [](const auto& e) { return std::get<1>(e) == 4; };
        std::vector<Story::Event> a, b;
        std::remove_copy_if(story.begin(), story.end(), std::back_inserter(a), is_arrival);
        std::remove_copy_if(shifted.begin(), shifted.end(), std::back_inserter(b), is_arrival);
        CHECK(a == b);
    }
    CHECK(stood > 20);
}

TEST_CASE("a robot far away does not change the results") {
    for (std::uint32_t seed = 1; seed <= scenarios; seed += 2) {
        CAPTURE(seed);
        Small small(seed);
        const auto story = story_of(small);
        small.robots.insert(small.robots.begin(), {"far", "", 100'000'000, 0, {}});
        CHECK(story_of(small) == story);
    }
}

}  // namespace file_order_test
