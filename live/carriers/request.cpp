// SPDX-License-Identifier: MIT
#include "live/carriers/request.hpp"

#include "live/carriers/command_reader.hpp"
#include "network/network.hpp"
#include "scenario/document/quantity.hpp"

#include <algorithm>

namespace rovernet {
namespace {

namespace dom = simdjson::dom;

constexpr std::size_t longest_name = 64;                          // [bytes]
constexpr std::uint64_t largest_count = std::uint64_t{1} << 53U;  // whole in every program

/// A message with advice behind it, if there is some.
std::string advised(std::string message, const std::string& advice) {
    return advice.empty() ? message : message + "; " + advice;
}

/// Robots as the lines of one controller may name them.
class Robots : public CommandReader {
  public:
    /// @param sender_of  robot that sends the message that is read, if it is one
    Robots(const Network& in, std::span<const NodeId> of, std::optional<NodeId> sender_of = {})
        : network(in), own(of), sender(sender_of) {}

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
            advice =
                fmt::format("the robots are {}{}", fmt::join(names, ", "), is_cut ? " ..." : "");
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
        if (own.empty()) {
            at.fail("hello_first",
                    fmt::format("first send a message of type \"hello\" that lists robot {}",
                                network.name(robot)));
        }
        if (!std::binary_search(own.begin(), own.end(), robot)) {
            at.fail("not_yours",
                    fmt::format("robot {} is not among the robots in your message of type "
                                "\"hello\"",
                                network.name(robot)));
        }
        return robot;
    }

    using CommandReader::time;

    const Network& network;
    const std::span<const NodeId> own;

  protected:
    NodeId robot(const JsonElement& name) const override {
        const NodeId found = named(name, name.text());
        if (found == sender) name.fail("bad_value", "expected another robot, or \"*\" for all");
        return found;
    }

  private:
    const std::optional<NodeId> sender;
};

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
            advised(fmt::format("found \"{}\"; expected \"pose\", \"heard\", \"neighbors\" or "
                                "\"scan\"",
                                what),
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
        version.fail("bad_protocol",
                     "expected \"protocol\":1, the only protocol version of this server");
    }
    if (name) {
        hello.name = name->text();
        if (hello.name.empty() || hello.name.size() > longest_name) {
            name->fail("out_of_range",
                       fmt::format("found a name of {} bytes; expected 1 to {} bytes",
                                   hello.name.size(), longest_name));
        }
    }
    const JsonElement& list = needed(listed, line, "robots", "\"robots\":[\"A\"]");
    for_each_item(list, [&](const JsonElement& item) {
        hello.robots.push_back(robots.named(item, item.text()));
    });
    if (hello.robots.empty()) list.fail("out_of_range", "expected at least one robot");
    auto sorted = hello.robots;
    std::sort(sorted.begin(), sorted.end());
    const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
    if (twice != sorted.end()) {
        list.fail("repeated_robot",
                  fmt::format("robot {} is listed twice", robots.network.name(*twice)));
    }
    const JsonElement& length = needed(step, line, "step", "\"step\":\"100 ms\"");
    hello.step = from_seconds(length.seconds());
    if (hello.step < shortest_step) {
        length.fail("out_of_range", "expected a step of 1 us or more");
    }
    if (observe) read_observed(*observe, hello);
    if (columns) hello.columns = columns->truth();
    hello.seed = seed_in(seed);
    return hello;
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
                   fmt::format("found {} numbers for {} robots; expected one number for each robot",
                               numbers.size(), size));
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
    std::optional<Duration> same;
    if (timeout) same = robots.time(*timeout);
    for (std::size_t i = 0; i < driven.size(); ++i) {
        commands.emplace_back(driven[i], DriveCommand{{speed[i]}, {turn[i]}, same});
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
            auto command = read_one_of(CommandsInPlace{}, robots, one, robots.network, robot);
            if (command) commands.emplace_back(robot, std::move(*command));
        }
    }
    sort_by_robot(commands);
    const auto twice =
        std::adjacent_find(commands.begin(), commands.end(),
                           [](const auto& a, const auto& b) { return a.first == b.first; });
    if (twice != commands.end()) {
        element.fail("repeated_robot",
                     fmt::format("robot {} is listed twice", robots.network.name(twice->first)));
    }
}

std::pair<NodeId, RobotCommand> message_in(const JsonElement& element, const Robots& robots) {
    static constexpr auto keys = [] {
        constexpr auto own = keys_of<SendCommand>();
        std::array<std::string_view, own.size() + 1> all = {"from"};
        std::copy(own.begin(), own.end(), all.begin() + 1);
        return all;
    }();
    const auto found = members(element, keys);
    const JsonElement& sender = needed(found[0], element, "from", "\"from\":\"A\"");
    const NodeId robot = robots.own_robot(sender, robots.named(sender, sender.text()));
    SendCommand send;
    Robots(robots.network, robots.own, robot)
        .read(send, element, std::span(keys).subspan(1), std::span(found).subspan(1));
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
    const Robots robots(network, own);
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
              advised(fmt::format("found \"{}\"; expected \"hello\", \"step\", \"reset\" or "
                                  "\"bye\"",
                                  what),
                      did_you_mean(what, {"hello", "step", "reset", "bye"})));
}

}  // namespace rovernet
