// SPDX-License-Identifier: MIT
#include "live/rosbridge/input.hpp"

#include "live/carriers/command_reader.hpp"
#include "network/network.hpp"
#include "sim/math.hpp"

#include <algorithm>
#include <vector>

namespace rovernet {
namespace {

constexpr Range unit{.low = -1, .high = 1, .text = "from -1 to 1"};

double number_in(const std::optional<JsonElement>& member, const Range& range) {
    return member ? member->number(range) : 0;
}

/// A geometry_msgs/Vector3.
Vec3 vector_in(const std::optional<JsonElement>& element, const Range& range) {
    if (!element) return {};
    const auto [x, y, z] = members(*element, std::array<std::string_view, 3>{"x", "y", "z"});
    return {number_in(x, range), number_in(y, range), number_in(z, range)};
}

/// A geometry_msgs/Point; without z, at the height given [m].
Vec3 place_in(const JsonElement& point, double height) {
    const auto [x, y, z] = members(point, std::array<std::string_view, 3>{"x", "y", "z"});
    return {number_in(x, goal_places), number_in(y, goal_places),
            z ? z->number(goal_places) : height};
}

/// Heading that a geometry_msgs/Quaternion gives; none for one that is all 0.
std::optional<Radians> heading_in(const std::optional<JsonElement>& element) {
    if (!element) return std::nullopt;
    constexpr std::array<std::string_view, 4> keys = {"x", "y", "z", "w"};
    const auto found = members(*element, keys);
    double q[4];
    for (std::size_t i = 0; i < keys.size(); ++i) q[i] = number_in(found[i], unit);
    const auto [x, y, z, w] = q;
    if (x == 0 && y == 0 && z == 0 && w == 0) return std::nullopt;
    return Radians{math::atan2(2 * (w * z + x * y), w * w + x * x - y * y - z * z)};
}

std::pair<RobotCommand, std::string> read_velocity(const JsonElement& message) {
    JsonElement twist = message;
    if (simdjson::dom::element inner;
        message.object().at_key("twist").get(inner) == simdjson::SUCCESS) {
        members(message, std::array<std::string_view, 2>{"header", "twist"});
        twist = {inner, {.above = &message.path, .key = "twist"}};
    }
    const auto [linear, angular] =
        members(twist, std::array<std::string_view, 2>{"linear", "angular"});
    const Vec3 v = vector_in(linear, drive_speeds), w = vector_in(angular, drive_turns);
    const bool is_plain = v.y == 0 && v.z == 0 && w.x == 0 && w.y == 0;
    return {DriveCommand{{v.x}, {w.z}}, is_plain ? ""
                                                 : "only linear.x and angular.z are used, because "
                                                   "the robot can only drive ahead and turn"};
}

/// Checks that a pose is told in the world's frame.
void check_frame(const std::optional<JsonElement>& header, const std::string& odometry) {
    if (!header) return;
    const auto [stamp, frame, number] =
        members(*header, std::array<std::string_view, 3>{"stamp", "frame_id", "seq"});
    if (!frame) return;
    const std::string_view name = plain_name(frame->text());
    if (name.empty() || name == "map" || name == odometry) return;
    frame->fail("bad_value",
                fmt::format("found the frame \"{}\"; expected \"map\" or \"{}\"", name, odometry));
}

std::pair<RobotCommand, std::string> read_goal(const JsonElement& message, NodeId robot,
                                               const Network& network) {
    const auto [header, pose] = members(message, std::array<std::string_view, 2>{"header", "pose"});
    check_frame(header, network.name(robot) + "/odom");
    const JsonElement& goal = needed(pose, message, "pose", R"("pose":{"position":{"x":1,"y":2}})");
    return {GoalCommand{read_place(goal, robot, network).at}, ""};
}

/// Reader of a message to send.
class RosSend : public CommandReader {
  public:
    RosSend(NodeId sender, const Network& network) : sender_(sender), network_(network) {}

  protected:
    NodeId robot(const JsonElement& name) const override {
        const NodeId found = read_robot(name, network_);
        if (found == sender_) {
            name.fail("bad_value",
                      "found the sender itself; expected a different robot, or \"*\" for all");
        }
        return found;
    }
    /// Data of a uint8[]: base64, or a list of numbers.
    std::string bytes(const JsonElement& element) const override {
        if (!element.value.is_array()) return CommandReader::bytes(element);
        std::string bytes;
        std::size_t index = 0;
        for (const simdjson::dom::element& item : element.array()) {
            const JsonElement number{item, {.above = &element.path, .index = index++}};
            bytes += static_cast<char>(number.whole_number(0, 255));
        }
        return bytes;
    }

  private:
    NodeId sender_;
    const Network& network_;
};

}  // namespace

NodeId read_robot(const JsonElement& name, const Network& network) {
    const std::string_view text = name.text();
    if (const auto robot = network.find(text)) return *robot;
    constexpr std::size_t most_names = 1'000;
    std::vector<std::string> names;
    for (NodeId n{0}; n.index() < std::min(network.size(), most_names); ++n.value) {
        names.push_back(network.name(n));
    }
    const std::string meant = did_you_mean(text, names);
    name.fail("unknown_robot",
              fmt::format("no robot {}{}{}", text, meant.empty() ? "" : "; ", meant));
}

SendCommand read_send(const JsonElement& message, NodeId robot, const Network& network) {
    constexpr std::array<std::string_view, 4> keys = {"dst_address", "dst_port", "data", "size"};
    // These are the keys of its fields in their order; "one_hop" is in no message.
    static_assert(keys_of<SendCommand>() ==
                  std::array<std::string_view, 5>{"to", "port", "data", "size", "one_hop"});
    SendCommand send;
    RosSend(robot, network).read(send, message, keys, members(message, keys));
    return send;
}

PlaceCommand read_place(const JsonElement& pose, NodeId robot, const Network& network) {
    const auto [position, orientation] =
        members(pose, std::array<std::string_view, 2>{"position", "orientation"});
    const JsonElement& point = needed(position, pose, "position", R"("position":{"x":1,"y":2})");
    const auto heading = heading_in(orientation);
    return {place_in(point, network.position(robot).z), heading.value_or(network.heading(robot))};
}

std::pair<RobotCommand, std::string> read_input(const JsonElement& message, const RosTopic& topic,
                                                const Network& network) {
    switch (topic.kind()) {
        case RosTopicKind::velocity: return read_velocity(message);
        case RosTopicKind::goal: return read_goal(message, topic.robot, network);
        default: return {read_send(message, topic.robot, network), ""};
    }
}

}  // namespace rovernet
