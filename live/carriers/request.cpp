// SPDX-License-Identifier: MIT
#include "live/carriers/request.hpp"

#include "files/base64.hpp"
#include "live/carriers/json_object.hpp"
#include "network/network.hpp"
#include "scenario/document/quantity.hpp"

#include <algorithm>

namespace rovernet {
namespace {

namespace dom = simdjson::dom;

constexpr std::size_t most_items = 100'000;                       // of a list
constexpr std::size_t longest_name = 64;                          // [bytes]
constexpr std::uint64_t largest_count = std::uint64_t{1} << 53U;  // whole in every program

/// A message with advice behind it, if there is some.
std::string advised(std::string message, const std::string& advice) {
    return advice.empty() ? message : message + "; " + advice;
}

/// Robots as the lines of one controller may name them.
struct Robots {
    const Network& network;
    std::span<const NodeId> own;

    [[noreturn]] void fail_unknown(const JsonElement& at, std::string_view name) const {
        constexpr std::size_t listed = 8;
        std::vector<std::string> names;
        for (NodeId n{0}; n.index() < std::min(network.size(), most_items); ++n.value) {
            names.push_back(network.name(n));
        }
        std::string advice = did_you_mean(name, names);
        if (advice.empty()) {
            const bool is_cut = names.size() > listed;
            names.resize(std::min(names.size(), listed));
            advice = fmt::format("there are {}{}", fmt::join(names, ", "), is_cut ? " ..." : "");
        }
        at.fail("unknown_robot", fmt::format("no robot {}; {}", name, advice));
    }
    NodeId named(const JsonElement& at, std::string_view name) const {
        if (name.size() > longest_name) {
            at.fail("out_of_range", fmt::format("found a name of {} bytes; expected {} at most",
                                                name.size(), longest_name));
        }
        const auto robot = network.find(name);
        if (!robot) fail_unknown(at, name);
        return *robot;
    }
    NodeId own_robot(const JsonElement& at, NodeId robot) const {
        if (!std::binary_search(own.begin(), own.end(), robot)) {
            at.fail("not_yours",
                    fmt::format("robot {} is not among those of your hello", network.name(robot)));
        }
        return robot;
    }
};

/// Calls use(element) for each item of a list.
template <class Use>
void for_each_item(const JsonElement& list, Use use) {
    const dom::array items = list.array();
    if (items.size() > most_items) {
        list.fail("too_many", fmt::format("found more than {} items", most_items));
    }
    std::size_t index = 0;
    for (const dom::element& item : items) {
        use(JsonElement{item, {.above = &list.path, .index = index++}});
    }
}

/// A time such as "100 ms".
double time_in(const JsonElement& element) {
    const std::string text(element.text());
    try {
        return read_quantity(Value(text), element.path.key, Dimension::time);
    } catch (const InputError& fault) {
        element.fail("bad_value", fault.message());
    }
}

std::optional<std::uint64_t> seed_in(const std::optional<JsonElement>& element) {
    constexpr std::uint64_t largest_seed = (std::uint64_t{1} << 63U) - 1;
    if (!element || element->value.is_null()) return std::nullopt;
    return element->whole_number(0, largest_seed);
}

void read_observed(const JsonElement& list, HelloRequest& hello) {
    const std::array<std::pair<std::string_view, bool*>, 4> all = {
        {{"pose", &hello.observes_pose},
         {"heard", &hello.observes_heard},
         {"neighbors", &hello.observes_neighbors},
         {"scan", &hello.observes_scan}}};
    for (const auto& [word, observes] : all) *observes = false;
    for_each_item(list, [&](const JsonElement& item) {
        const std::string_view what = item.text();
        const auto found =
            std::ranges::find(all, what, [](const auto& each) { return each.first; });
        if (found != all.end()) {
            *found->second = true;
            return;
        }
        item.fail(
            "bad_value",
            advised(fmt::format("found \"{}\"; expected pose, heard, neighbors or scan", what),
                    did_you_mean(what, {"pose", "heard", "neighbors", "scan"})));
    });
}

HelloRequest read_hello(const JsonElement& line, const Robots& robots) {
    constexpr std::array<std::string_view, 8> keys = {"type", "protocol", "name",    "robots",
                                                      "step", "observe",  "columns", "seed"};
    const auto [type, protocol, name, listed, step, observe, columns, seed] = members(line, keys);
    HelloRequest hello;
    const JsonElement& version = needed(protocol, line, "protocol", "\"protocol\":1");
    if (version.whole_number(0, largest_count) != 1) {
        version.fail("bad_protocol", "this is protocol 1");
    }
    if (name) {
        hello.name = name->text();
        if (hello.name.empty() || hello.name.size() > longest_name) {
            name->fail("out_of_range",
                       fmt::format("expected a name of 1 to {} bytes", longest_name));
        }
    }
    const JsonElement& list = needed(listed, line, "robots", "\"robots\":[\"A\"]");
    for_each_item(list, [&](const JsonElement& item) {
        hello.robots.push_back(robots.named(item, item.text()));
    });
    if (hello.robots.empty()) list.fail("out_of_range", "expected one robot at least");
    auto sorted = hello.robots;
    std::sort(sorted.begin(), sorted.end());
    const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
    if (twice != sorted.end()) {
        list.fail("repeated_robot",
                  fmt::format("robot {} stands there twice", robots.network.name(*twice)));
    }
    const JsonElement& length = needed(step, line, "step", "\"step\":\"100 ms\"");
    hello.step = from_seconds(time_in(length));
    if (hello.step < shortest_step) {
        length.fail("out_of_range", "expected a step of 1 us or more");
    }
    if (observe) read_observed(*observe, hello);
    if (columns) hello.columns = columns->truth();
    hello.seed = seed_in(seed);
    return hello;
}

DriveCommand drive_of(const std::optional<JsonElement>& v, const std::optional<JsonElement>& w,
                      const std::optional<JsonElement>& timeout) {
    DriveCommand drive;
    if (v) drive.speed.value = v->number(drive_speeds);
    if (w) drive.turn_rate.value = w->number(drive_turns);
    if (timeout) {
        const double s = time_in(*timeout);
        if (!(s > 0)) timeout->fail("out_of_range", "expected a time above 0 s");
        drive.timeout = std::max(from_seconds(s), Duration{1});
    }
    return drive;
}

/// A place [x, y, z], or [x, y] at the height given [m].
Vec3 place_in(const JsonElement& list, double height) {
    std::vector<double> at;
    for_each_item(list, [&](const JsonElement& item) { at.push_back(item.number(goal_places)); });
    if (at.size() != 2 && at.size() != 3) {
        list.fail(
            "bad_value",
            fmt::format("found {} numbers; expected [x, y] or [x, y, z] in metres", at.size()));
    }
    return {at[0], at[1], at.size() == 3 ? at[2] : height};
}

/// The command of one robot; nothing for {}, which changes nothing.
std::optional<RobotCommand> command_in(const JsonElement& element, const Network& network,
                                       NodeId robot) {
    constexpr std::array<std::string_view, 8> keys = {"v",     "w",    "timeout", "goal",
                                                      "speed", "stop", "place",   "heading"};
    const auto [v, w, timeout, goal, speed, stop, place, heading] = members(element, keys);
    const bool drives = v || w || timeout, goes = goal || speed, is_put = place || heading;
    if (drives + goes + is_put + stop.has_value() > 1) {
        element.fail("bad_value",
                     "expected one command only: v and w, or goal and speed, or place and heading, "
                     "or stop");
    }
    if (drives) return drive_of(v, w, timeout);
    if (stop) {
        if (!stop->truth()) stop->fail("bad_value", "expected \"stop\":true");
        return StopCommand{};
    }
    if (is_put) {
        const JsonElement& there = needed(place, element, "place", "\"place\":[1,12]");
        return PlaceCommand{place_in(there, network.position(robot).z),
                            heading ? Radians{heading->number(any)} : network.heading(robot)};
    }
    if (!goes) return std::nullopt;
    GoalCommand way{
        place_in(needed(goal, element, "goal", "\"goal\":[1,12]"), network.position(robot).z)};
    if (speed) way.speed.value = speed->number(goal_speeds);
    return way;
}

using Commands = std::vector<std::pair<NodeId, RobotCommand>>;

void sort_by_robot(Commands& commands) {
    const auto before = [](const auto& a, const auto& b) { return a.first < b.first; };
    if (std::is_sorted(commands.begin(), commands.end(), before)) return;  // as they mostly come
    std::stable_sort(commands.begin(), commands.end(), before);
}

std::vector<double> numbers_in(const std::optional<JsonElement>& list, std::size_t size,
                               const Range& range) {
    std::vector<double> numbers;
    if (!list) return std::vector<double>(size, 0.0);
    for_each_item(*list, [&](const JsonElement& item) { numbers.push_back(item.number(range)); });
    if (numbers.size() != size) {
        list->fail("bad_value",
                   fmt::format("found {} numbers for {} robots", numbers.size(), size));
    }
    return numbers;
}

/// "do" as lists: robots by their ids.
void read_columns(const JsonElement& element, const Robots& robots, Commands& commands) {
    constexpr std::array<std::string_view, 4> keys = {"robots", "v", "w", "timeout"};
    const auto [ids, v, w, timeout] = members(element, keys);
    std::vector<NodeId> driven;
    for_each_item(*ids, [&](const JsonElement& item) {
        const auto id = item.whole_number(0, robots.network.size() - 1);
        driven.push_back(robots.own_robot(item, NodeId{static_cast<std::uint32_t>(id)}));
    });
    const auto speed = numbers_in(v, driven.size(), drive_speeds);
    const auto turn = numbers_in(w, driven.size(), drive_turns);
    const DriveCommand same = drive_of({}, {}, timeout);
    for (std::size_t i = 0; i < driven.size(); ++i) {
        commands.emplace_back(driven[i], DriveCommand{{speed[i]}, {turn[i]}, same.timeout});
    }
}

void read_do(const JsonElement& element, const Robots& robots, Commands& commands) {
    dom::element ids;
    if (element.object().at_key("robots").get(ids) == simdjson::SUCCESS && ids.is_array()) {
        read_columns(element, robots, commands);
    } else {
        for (const auto& [name, value] : element.object()) {
            const JsonElement one{value, {.above = &element.path, .key = name}};
            const NodeId robot = robots.own_robot(one, robots.named(one, name));
            const auto command = command_in(one, robots.network, robot);
            if (command) commands.emplace_back(robot, *command);
        }
    }
    sort_by_robot(commands);
    const auto twice =
        std::adjacent_find(commands.begin(), commands.end(),
                           [](const auto& a, const auto& b) { return a.first == b.first; });
    if (twice != commands.end()) {
        element.fail("repeated_robot",
                     fmt::format("robot {} stands there twice", robots.network.name(twice->first)));
    }
}

std::pair<NodeId, RobotCommand> message_in(const JsonElement& element, const Robots& robots) {
    constexpr std::array<std::string_view, 5> keys = {"from", "to", "port", "data", "size"};
    const auto [from, to, port, data, size] = members(element, keys);
    const JsonElement& sender = needed(from, element, "from", "\"from\":\"A\"");
    const NodeId robot = robots.own_robot(sender, robots.named(sender, sender.text()));
    SendCommand send;
    if (to && to->text() != "*") {
        send.to = robots.named(*to, to->text());
        if (send.to == robot) to->fail("bad_value", "expected another robot, or \"*\" for all");
    }
    if (port) send.port = static_cast<std::uint16_t>(port->whole_number(0, 65'535));
    const JsonElement& bytes = needed(data, element, "data", "\"data\":\"Rg==\"");
    auto decoded = from_base64(bytes.text());
    if (!decoded) bytes.fail("bad_base64", "expected base64 with its padding, such as \"Rg==\"");
    if (decoded->size() > longest_message) {
        bytes.fail("out_of_range", fmt::format("found {} bytes; expected {} at most",
                                               decoded->size(), longest_message));
    }
    send.payload = std::move(*decoded);
    if (size) send.size = static_cast<std::uint32_t>(size->whole_number(0, longest_message));
    return {robot, std::move(send)};
}

StepRequest read_step(const JsonElement& line, const Robots& robots) {
    constexpr std::array<std::string_view, 4> keys = {"type", "n", "do", "send"};
    const auto [type, n, orders, send] = members(line, keys);
    StepRequest step;
    step.number = needed(n, line, "n", "\"n\":1").whole_number(0, largest_count);
    if (orders) read_do(*orders, robots, step.commands);
    if (send) {
        for_each_item(*send, [&](const JsonElement& item) {
            step.commands.push_back(message_in(item, robots));
        });
    }
    return step;
}

}  // namespace

struct RequestReader::Parser : JsonParser {};

RequestReader::RequestReader() : parser_(std::make_unique<Parser>()) {}
RequestReader::RequestReader(RequestReader&&) noexcept = default;
RequestReader::~RequestReader() = default;

Request RequestReader::read(std::string_view line, const Network& network,
                            std::span<const NodeId> own) {
    number_.reset();
    const JsonElement document{parser_->parse(line), {}};
    const dom::object object = document.object();
    std::uint64_t number = 0;
    if (object.at_key("n").get_uint64().get(number) == simdjson::SUCCESS) number_ = number;
    dom::element found;
    if (object.at_key("type").get(found) != simdjson::SUCCESS) {
        fail_missing_key(document.path, "type", "\"type\":\"hello\"");
    }
    const JsonElement type{found, {.above = &document.path, .key = "type"}};
    const Robots robots{network, own};
    const std::string_view what = type.text();
    if (what == "hello") return read_hello(document, robots);
    if (what == "step") return read_step(document, robots);
    if (what == "reset") {
        const auto [kind, seed] =
            members(document, std::array<std::string_view, 2>{"type", "seed"});
        return ResetRequest{seed_in(seed)};
    }
    if (what == "bye") {
        members(document, std::array<std::string_view, 1>{"type"});
        return ByeRequest{};
    }
    type.fail("unknown_type",
              advised(fmt::format("found \"{}\"; expected hello, step, reset or bye", what),
                      did_you_mean(what, {"hello", "step", "reset", "bye"})));
}

}  // namespace rovernet
