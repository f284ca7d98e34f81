// SPDX-License-Identifier: MIT
#include "live/rosbridge/topic.hpp"

#include "scene/scanner.hpp"

#include <algorithm>

namespace rovernet {
namespace {

/// Range finder of a robot's main scan: its first laser, or else the first that is no ring; none if
/// it has only rings.
std::optional<std::size_t> main_scanner(NodeId robot, const Session& session) {
    const auto scanners = session.range_finders(robot);
    const auto first = [&](auto is_wanted) {
        const auto found = std::find_if(scanners.begin(), scanners.end(), is_wanted);
        return found == scanners.end() ? std::nullopt
                                       : std::optional(std::size_t(found - scanners.begin()));
    };
    const auto laser =
        first([](const Scanner& each) { return each.finder.kind == RangeFinderKind::laser; });
    return laser ? laser : first([](const Scanner& each) { return !each.is_ring(); });
}

/// Topic "NAME/SCANNER/scan"; none if the robot has no such scanner, or if it is a ring or the main
/// one.
std::optional<RosTopic> find_other_scan(std::string_view name, const RosTopicType& type,
                                        const Session& session) {
    if (!name.ends_with(type.name)) return std::nullopt;
    name.remove_suffix(std::min(type.name.size() + 1, name.size()));
    const auto slash = name.rfind('/');
    if (slash == name.npos) return std::nullopt;
    const auto robot = session.network().find(name.substr(0, slash));
    if (!robot) return std::nullopt;
    const auto scanners = session.range_finders(*robot);
    for (std::size_t i = 0; i < scanners.size(); ++i) {
        const bool is_other = !scanners[i].is_ring() && i != main_scanner(*robot, session);
        if (is_other && scanners[i].label() == name.substr(slash + 1)) {
            return RosTopic{&type, *robot, i};
        }
    }
    return std::nullopt;
}

/// Appends a robot's topics of one type.
void append(std::vector<RosTopic>& topics, const RosTopicType& type, NodeId robot,
            const Session& session) {
    if (type.kind != RosTopicKind::scan) {
        topics.push_back({&type, robot});
        return;
    }
    const auto scanners = session.range_finders(robot);
    for (std::size_t i = 0; i < scanners.size(); ++i) {
        if (!scanners[i].is_ring()) topics.push_back({&type, robot, i});
    }
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

std::optional<RosTopic> find_topic(std::string_view name, const Session& session) {
    name = plain_name(name);
    for (const RosTopicType& type : ros_topics) {
        if (!type.is_of_robot && name == type.name) return RosTopic{&type};
        if (!type.is_of_robot) continue;
        const auto robot = robot_before(name, type.name, session.network());
        if (type.kind != RosTopicKind::scan) {
            if (robot) return RosTopic{&type, *robot};
            continue;
        }
        const auto scanner = robot ? main_scanner(*robot, session) : std::nullopt;
        if (scanner) return RosTopic{&type, *robot, *scanner};
        if (const auto other = find_other_scan(name, type, session)) return other;
    }
    return std::nullopt;
}

std::vector<RosTopic> all_topics(const Session& session) {
    std::vector<RosTopic> topics;
    for (const RosTopicType& type : ros_topics) {
        if (!type.is_of_robot) {
            topics.push_back({&type});
            continue;
        }
        for (NodeId robot{0}; robot.index() < session.network().size(); ++robot.value) {
            append(topics, type, robot, session);
        }
    }
    return topics;
}

std::string name_of(const RosTopic& topic, const Session& session) {
    std::string name = "/";
    if (topic.type->is_of_robot) name += session.network().name(topic.robot) + "/";
    const bool is_other_scan =
        topic.kind() == RosTopicKind::scan && topic.scanner != main_scanner(topic.robot, session);
    if (is_other_scan) name += session.range_finders(topic.robot)[topic.scanner].label() + "/";
    return name += topic.type->name;
}

}  // namespace rovernet
