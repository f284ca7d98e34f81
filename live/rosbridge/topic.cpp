// SPDX-License-Identifier: MIT
#include "live/rosbridge/topic.hpp"

namespace rovernet {
namespace {

bool has_topic(const RosTopicType& type, NodeId robot, Session& session) {
    return type.kind != RosTopicKind::scan || session.range_finder(robot);
}

}  // namespace

std::string plain_type(std::string_view type) {
    constexpr std::string_view middle = "/msg/";
    std::string plain(type);
    if (const auto at = plain.find(middle); at != plain.npos) {
        plain.replace(at, middle.size(), "/");
    }
    return plain;
}

bool is_type_of(const RosTopicType& topic, std::string_view type) {
    const std::string plain = plain_type(type);
    return plain == topic.type ||
           (topic.kind == RosTopicKind::velocity && plain == stamped_velocity);
}

std::string_view plain_name(std::string_view name) {
    if (name.starts_with('/')) name.remove_prefix(1);
    return name;
}

std::optional<NodeId> robot_before(std::string_view name, std::string_view rest,
                                   const Network& network) {
    if (name.size() <= rest.size() || !name.ends_with(rest)) return std::nullopt;
    name.remove_suffix(rest.size());
    if (!name.ends_with('/')) return std::nullopt;
    name.remove_suffix(1);
    return network.find(name);
}

std::optional<RosTopic> find_topic(std::string_view name, Session& session) {
    name = plain_name(name);
    for (const RosTopicType& type : ros_topics) {
        if (!type.is_of_robot && name == type.name) return RosTopic{&type};
        if (!type.is_of_robot) continue;
        const auto robot = robot_before(name, type.name, session.network());
        if (robot && has_topic(type, *robot, session)) return RosTopic{&type, *robot};
    }
    return std::nullopt;
}

std::vector<RosTopic> all_topics(Session& session) {
    std::vector<RosTopic> topics;
    for (const RosTopicType& type : ros_topics) {
        if (!type.is_of_robot) {
            topics.push_back({&type});
            continue;
        }
        for (NodeId robot{0}; robot.index() < session.network().size(); ++robot.value) {
            if (has_topic(type, robot, session)) topics.push_back({&type, robot});
        }
    }
    return topics;
}

std::string name_of(const RosTopic& topic, const Network& network) {
    std::string name = "/";
    if (topic.type->is_of_robot) name += network.name(topic.robot) + "/";
    return name += topic.type->name;
}

}  // namespace rovernet
