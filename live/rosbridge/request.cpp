// SPDX-License-Identifier: MIT
#include "live/rosbridge/request.hpp"

#include "live/carriers/json_object.hpp"
#include "live/rosbridge/input.hpp"
#include "network/network.hpp"

#include <array>

namespace rovernet {
namespace {

constexpr std::size_t longest_text = 256;  // [bytes] of a name, a type, an id
constexpr std::uint64_t longest_queue = 1'000;
constexpr Range intervals{.low = 0, .high = 1e9, .text = "from 0 to 1e9 ms"};
constexpr Range step_lengths{
    .low = 0, .high = 1e6, .low_included = false, .text = "above 0 and up to 1e6 s"};

/// Member of an operation. Unknown keys are ignored, and null counts as missing.
std::optional<JsonElement> member(const JsonElement& in, std::string_view key) {
    simdjson::dom::element found;
    if (in.object().at_key(key).get(found) != simdjson::SUCCESS) return std::nullopt;
    if (found.is_null()) return std::nullopt;
    return JsonElement{found, {.above = &in.path, .key = key}};
}

std::string short_text(const JsonElement& element) {
    const std::string_view text = element.text();
    if (text.size() > longest_text) {
        element.fail("out_of_range", fmt::format("found a text of {} bytes; expected {} at most",
                                                 text.size(), longest_text));
    }
    return std::string(text);
}

std::string text_of(const JsonElement& in, std::string_view key, std::string_view example) {
    return short_text(needed(member(in, key), in, key, example));
}

[[noreturn]] void fail_unknown(const JsonElement& in, std::string_view key, std::string_view what) {
    const JsonElement name = *member(in, key);
    name.fail("unknown_name", fmt::format("there is no {} {}", what, name.text()));
}

/// Fails if a type that is given is not that of the topic.
void check_type(const JsonElement& operation, const RosTopic& topic) {
    const auto type = member(operation, "type");
    if (!type || is_type_of(*topic.type, type->text())) return;
    type->fail("bad_type", fmt::format("found {}; expected {}", type->text(), topic.type->type));
}

RosTopic topic_of(const JsonElement& operation, std::string_view name, Session& session) {
    const auto topic = find_topic(name, session);
    if (!topic) fail_unknown(operation, "topic", "topic");
    return *topic;
}

RosTopic input_of(const JsonElement& operation, Session& session) {
    const std::string name = text_of(operation, "topic", R"("topic":"/A/cmd_vel")");
    const RosTopic topic = topic_of(operation, name, session);
    if (!topic.type->is_input) {
        member(operation, "topic")->fail("bad_value", "only rovernet publishes this topic");
    }
    return topic;
}

RosEncoding encoding_of(const JsonElement& compression) {
    const std::string_view name = compression.text();
    if (name == "none") return RosEncoding::json;
    if (name == "cbor") return RosEncoding::cbor;
    compression.fail("bad_value", fmt::format("found \"{}\"; expected \"none\" or \"cbor\"", name));
}

RosSubscribe read_subscribe(const JsonElement& operation, Session& session) {
    RosSubscribe subscribe{text_of(operation, "topic", R"("topic":"/A/odom")"), {}, {}};
    subscribe.source = find_topic(subscribe.topic, session);
    if (subscribe.source && subscribe.source->type->is_input) subscribe.source.reset();
    if (subscribe.source) {
        check_type(operation, *subscribe.source);
    } else if (!member(operation, "type")) {
        topic_of(operation, subscribe.topic, session);
    }
    RosDelivery& delivery = subscribe.delivery;
    if (const auto interval = member(operation, "throttle_rate")) {
        delivery.interval = from_seconds(interval->number(intervals) / 1000);
    }
    if (const auto length = member(operation, "queue_length")) {
        delivery.queue_length = length->whole_number(0, longest_queue);
    }
    if (const auto compression = member(operation, "compression")) {
        delivery.encoding = encoding_of(*compression);
    }
    return subscribe;
}

RosPublish read_publish(const JsonElement& operation, Session& session) {
    const RosTopic topic = input_of(operation, session);
    const auto message = member(operation, "msg");
    auto [command, warning] =
        read_input(needed(message, operation, "msg", R"("msg":{...})"), topic, session.network());
    return {topic.robot, std::move(command), std::move(warning)};
}

RosArguments read_arguments(const JsonElement& operation, const RosService& service,
                            const Network& network) {
    const auto found = member(operation, "args");
    const auto args = [&]() -> const JsonElement& {
        return needed(found, operation, "args", R"("args":{...})");
    };
    RosArguments read;
    if (!service.type->argument.empty()) {
        read.text = text_of(args(), service.type->argument, R"("...")");
    }
    if (service.kind() == RosServiceKind::radio_send) {
        read.robot = service.robot;
        read.command = read_send(args(), service.robot, network);
    }
    if (service.kind() == RosServiceKind::step) {
        const auto length = member(args(), "seconds");
        read.time = from_seconds(
            needed(length, args(), "seconds", R"("seconds":0.1)").number(step_lengths));
    }
    if (service.kind() == RosServiceKind::set_pose) {
        const auto [name, pose] = members(args(), std::array<std::string_view, 2>{"name", "pose"});
        read.robot = read_robot(needed(name, args(), "name", R"("name":"A")"), network);
        const JsonElement& place = needed(pose, args(), "pose", R"("pose":{...})");
        read.command = read_place(place, *read.robot, network);
    }
    return read;
}

RosCall read_call(const JsonElement& operation, const Network& network) {
    const std::string name = text_of(operation, "service", R"("service":"/rosapi/topics")");
    const auto service = find_service(name, network);
    if (!service) fail_unknown(operation, "service", "service");
    return {*service, read_arguments(operation, *service, network)};
}

RosLevel read_level(const JsonElement& operation) {
    const auto level = member(operation, "level");
    const JsonElement& word = needed(level, operation, "level", R"("level":"error")");
    const std::array<std::string_view, 4> names = {"info", "warning", "error", "none"};
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (names[i] == word.text()) return static_cast<RosLevel>(i);
    }
    word.fail("bad_value",
              fmt::format("found \"{}\"; expected {}", word.text(), fmt::join(names, ", ")));
}

/// Reason why an operation of the protocol is not supported; empty if it is.
std::string_view refusal(std::string_view op) {
    if (op == "advertise_service" || op == "advertise_action")
        return "rovernet uses no services or actions that clients advertise";
    if (op == "auth") return "rovernet needs no password";
    if (op == "send_action_goal" || op == "cancel_action_goal") return "rovernet has no actions";
    return {};
}

}  // namespace

struct RosRequestReader::Parser : JsonParser {};

RosRequestReader::RosRequestReader() : parser_(std::make_unique<Parser>()) {}
RosRequestReader::~RosRequestReader() = default;

RosRequest RosRequestReader::read(std::string_view text, Session& session) {
    operation_ = {};
    const JsonElement operation{parser_->parse(text), {}};
    operation.object();
    if (const auto id = member(operation, "id")) operation_.id = short_text(*id);
    operation_.name = text_of(operation, "op", R"("op":"publish")");
    for (const char* key : {"topic", "service", "action"}) {
        if (const auto target = member(operation, key)) operation_.target = short_text(*target);
    }
    const std::string& op = operation_.name;
    if (op == "publish") return read_publish(operation, session);
    if (op == "subscribe") return read_subscribe(operation, session);
    if (op == "call_service") return read_call(operation, session.network());
    if (op == "unsubscribe") {
        return RosUnsubscribe{text_of(operation, "topic", R"("topic":"/A/odom")")};
    }
    if (op == "advertise") check_type(operation, input_of(operation, session));
    if (op == "advertise" || op == "unadvertise") return RosNothing{};
    if (op == "set_level") return read_level(operation);
    const std::string_view why = refusal(op);
    const JsonElement name = *member(operation, "op");
    if (!why.empty()) name.fail("refused", fmt::format("{} is refused: {}", op, why));
    name.fail("unknown_op", fmt::format("unknown operation \"{}\"", op));
}

}  // namespace rovernet
