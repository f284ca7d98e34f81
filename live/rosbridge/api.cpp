// SPDX-License-Identifier: MIT
#include "live/rosbridge/api.hpp"

#include "live/rosbridge/messages.hpp"
#include "live/rosbridge/types.hpp"

#include <fmt/format.h>

namespace rovernet {
namespace {

constexpr std::string_view node_name = "/rovernet";
constexpr std::string_view simulated_time = "/use_sim_time";

/// Calls put() for the items of a list under a key.
template <class Put>
void put_list(RosWriter& out, std::string_view key, Put put) {
    out.key(key);
    out.open_list();
    put();
    out.close_list();
}

void put_texts(RosWriter& out, std::string_view key, std::initializer_list<std::string_view> all) {
    put_list(out, key, [&] {
        for (const std::string_view each : all) out.text(each);
    });
}

void put_member(RosWriter& out, std::string_view key, std::string_view value) {
    out.key(key);
    out.text(value);
}

/// A rosapi_msgs/TypeDef, without its lists of constants: no type has any.
void put_definition(RosWriter& out, const RosType& type) {
    const auto members = type.members();
    out.open_object();
    put_member(out, "type", type.name);
    put_list(out, "fieldnames", [&] {
        for (const RosMember& each : members) out.text(each.name);
    });
    put_list(out, "fieldtypes", [&] {
        for (const RosMember& each : members) out.text(each.type);
    });
    put_list(out, "fieldarraylen", [&] {
        for (const RosMember& each : members) out.whole(each.elements.value_or(-1));
    });
    put_list(out, "examples", [&] {
        for (const RosMember& each : members) {
            out.text(each.elements ? "[]" : find_type(each.type) ? "{}" : "");
        }
    });
    out.close_object();
}

/// Definitions of a type and of all that it has inside, as ROS puts them into one text.
std::string full_text(std::string_view name) {
    const std::string line(80, '=');
    std::string text;
    for (const RosType* type : types_within(*find_type(name))) {
        if (!text.empty()) text += fmt::format("{}\nMSG: {}\n", line, type->name);
        text += type->definition;
    }
    return text;
}

void write_details(RosWriter& out, const std::string& type) {
    put_list(out, "typedefs", [&] {
        const RosType* found = find_type(plain_type(type));
        if (!found) return;
        for (const RosType* each : types_within(*found)) put_definition(out, *each);
    });
}

}  // namespace

void RosApi::write(RosWriter& out, const RosCall& call) const {
    const std::string& text = call.arguments.text;
    const Network& network = session_.network();
    out.open_object();
    switch (call.service.kind()) {
        case RosServiceKind::topics:
            write_topics(out, "topics", Direction::both);
            write_types(out);
            break;
        case RosServiceKind::services: write_services(out); break;
        case RosServiceKind::nodes: put_texts(out, "nodes", {node_name}); break;
        case RosServiceKind::topics_for_type:
            write_topics(out, "topics", Direction::both, text);
            break;
        case RosServiceKind::services_for_type: write_services(out, text); break;
        case RosServiceKind::topic_type: {
            const auto topic = find_topic(text, session_);
            put_member(out, "type", topic ? topic->type->type : "");
            break;
        }
        case RosServiceKind::service_type: {
            const auto service = find_service(text, network);
            put_member(out, "type", service ? service->type->type : "");
            break;
        }
        case RosServiceKind::message_details: write_details(out, text); break;
        case RosServiceKind::topics_and_raw_types: write_raw_types(out); break;
        case RosServiceKind::parameter: write_parameter(out, text); break;
        case RosServiceKind::parameter_names: put_texts(out, "names", {simulated_time}); break;
        case RosServiceKind::publishers: write_users(out, "publishers", text, false); break;
        case RosServiceKind::subscribers: write_users(out, "subscribers", text, true); break;
        case RosServiceKind::node_details: write_node(out, text); break;
        case RosServiceKind::time:
            out.key("time");
            write_time(out, network.now());
            break;
        default: break;
    }
    out.close_object();
}

void RosApi::write_topics(RosWriter& out, std::string_view key, Direction direction,
                          std::string_view type) const {
    put_list(out, key, [&] {
        for (const RosTopic& topic : all_topics(session_)) {
            const Direction own = topic.type->is_input ? Direction::in : Direction::out;
            if (direction != Direction::both && direction != own) continue;
            if (!type.empty() && !is_type_of(*topic.type, type)) continue;
            out.text(name_of(topic, session_));
        }
    });
}

void RosApi::write_types(RosWriter& out) const {
    put_list(out, "types", [&] {
        for (const RosTopic& topic : all_topics(session_)) out.text(topic.type->type);
    });
}

void RosApi::write_raw_types(RosWriter& out) const {
    write_topics(out, "topics", Direction::both);
    write_types(out);
    put_list(out, "typedefs_full_text", [&] {
        for (const RosTopic& topic : all_topics(session_)) out.text(full_text(topic.type->type));
    });
}

void RosApi::write_services(RosWriter& out, std::string_view type) const {
    const Network& network = session_.network();
    put_list(out, "services", [&] {
        for (const RosServiceType& each : ros_services) {
            if (!type.empty() && plain_type(type) != each.type) continue;
            if (!each.is_of_robot) out.text(fmt::format("/{}", each.name));
            for (NodeId n{0}; each.is_of_robot && n.index() < network.size(); ++n.value) {
                out.text(fmt::format("/{}/{}", network.name(n), each.name));
            }
        }
    });
}

void RosApi::write_parameter(RosWriter& out, const std::string& name) const {
    const bool is_known = plain_name(name) == plain_name(simulated_time);
    put_member(out, "value", is_known ? "true" : "null");
    out.key("successful");
    out.truth(is_known);
    put_member(out, "reason", is_known ? "" : "there is no parameter " + name);
}

void RosApi::write_node(RosWriter& out, const std::string& node) const {
    const bool is_known = plain_name(node) == plain_name(node_name);
    if (!is_known) {
        for (const char* key : {"subscribing", "publishing", "services"}) put_texts(out, key, {});
        return;
    }
    write_topics(out, "subscribing", Direction::in);
    write_topics(out, "publishing", Direction::out);
    write_services(out);
}

/// Writes the nodes that publish a topic, or those that subscribe to it.
void RosApi::write_users(RosWriter& out, std::string_view key, const std::string& topic,
                         bool is_input) const {
    const auto found = find_topic(topic, session_);
    put_list(out, key, [&] {
        if (found && found->type->is_input == is_input) out.text(node_name);
    });
}

}  // namespace rovernet
