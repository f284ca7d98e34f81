// SPDX-License-Identifier: MIT
#include "live/lockstep/answer.hpp"

#include "experiment/version.hpp"
#include "files/base64.hpp"
#include "models/medium/medium.hpp"
#include "scenario/document/json.hpp"

#include <algorithm>
#include <cmath>

namespace rovernet {
AnswerWriter::AnswerWriter(Session& session, const Scenario& scenario)
    : session_(session), scenario_(scenario) {
    const Network& network = session.network();
    for (NodeId robot{0}; robot.index() < network.size(); ++robot.value) {
        names_.push_back(to_json_line(Value(network.name(robot))));
    }
}

void AnswerWriter::put(double number) {
    if (!std::isfinite(number)) return put("null");
    line_.put_number(number);
}

/// Calls put_one(item) for each item, with a comma between two.
template <class Items, class PutOne>
void AnswerWriter::put_list(const Items& items, PutOne put_one) {
    const char* between = "";
    for (const auto& item : items) {
        put(between);
        put_one(item);
        between = ",";
    }
}

std::string_view AnswerWriter::welcome(const HelloRequest& hello) {
    const Network& network = session_.network();
    line_.clear();
    put(R"({"type":"welcome","protocol":1,"version":)", to_json_line(Value(version())));
    put(",\"seed\":", scenario_.scenario.seed);
    put(",\"t_ns\":", network.now().time_since_epoch().count());
    put(",\"step_ns\":", hello.step.count());
    put(",\"end_ns\":", session_.end().time_since_epoch().count());
    put(",\"robots\":{");
    put_list(hello.robots, [&](NodeId robot) {
        const RobotState state = network.robot(robot);
        put(name(robot));
        put(":{\"id\":", std::uint64_t{robot.value});
        put(",\"radius\":", state.radius.value);
        put(",");
        put_place(state.at);
        put(",\"heading\":", state.heading.value);
        if (hello.observes_scan) put_scanners(robot);
        put("}");
    });
    put("},\"map\":");
    put_map();
    put("}");
    return line_.text();
}

bool AnswerWriter::tells_height(Vec3 at) const {
    return at.z != 0 || session_.network().scene().storeys().size() > 1;
}

void AnswerWriter::put_place(Vec3 at) {
    put("\"x\":", at.x);
    put(",\"y\":", at.y);
    if (!tells_height(at)) return;
    put(",\"z\":", at.z);
}

void AnswerWriter::put_map() {
    const Scene& scene = session_.network().scene();
    if (scene.open_field()) return put("null");
    const OccupancyGrid& grid = scene.grid();
    const SceneTable& table = scenario_.scene;
    const bool is_building = !table.floors.empty();
    put("{\"image\":");
    put(is_building ? to_json_line(Value(table.floors.front().map))
        : table.map ? to_json_line(Value(*table.map))
                    : "null");
    put(",\"resolution\":", grid.cell_width);
    put(",\"cell_size\":[", grid.cell_width, ",", grid.cell_height, "]");
    put(",\"origin\":[", grid.origin.x, ",", grid.origin.y, "]");
    put(",\"yaw\":", grid.yaw);
    put(",\"columns\":", std::int64_t{grid.columns});
    put(",\"rows\":", std::int64_t{grid.rows});
    if (is_building) {
        put(",\"floors\":[");
        put_list(table.floors, [&](const FloorTable& floor) {
            put("{\"height\":", floor.height.value);
            put(",\"image\":", to_json_line(Value(floor.map)));
            put("}");
        });
        put("]");
    }
    put("}");
}

std::string_view AnswerWriter::state(const HelloRequest& hello, std::uint64_t number,
                                     const std::vector<SentMessage>& sent,
                                     const std::vector<HeardMessage>& heard) {
    const Time now = session_.network().now();
    line_.clear();
    put(R"({"type":"state","n":)", number);
    put(",\"t_ns\":", now.time_since_epoch().count());
    if (hello.observes_pose && hello.columns) {
        put_columns(hello.robots);
    } else if (hello.observes_pose) {
        put(",\"robots\":{");
        put_list(hello.robots, [&](NodeId robot) { put_robot(robot); });
        put("}");
    }
    if (hello.observes_heard) {
        put(",\"heard\":[");
        put_list(heard, [&](const HeardMessage& each) { put_heard(each); });
        put("]");
    }
    if (hello.observes_neighbors) {
        put(",\"neighbors\":{");
        put_list(hello.robots, [&](NodeId robot) { put_neighbors(robot); });
        put("}");
    }
    if (hello.observes_scan) {
        put(",\"scan\":{");
        put_list(hello.robots, [&](NodeId robot) { put_scans(robot); });
        put("}");
    }
    put(",\"sent\":[");
    put_list(sent, [&](const SentMessage& each) {
        put("{\"uid\":", each.uid);
        put(",\"robot\":", name(each.robot));
        put("}");
    });
    put("],\"done\":", truth(now >= session_.end()));
    put("}");
    return line_.text();
}

void AnswerWriter::put_robot(NodeId robot) {
    const Network& network = session_.network();
    const Vec3 at = network.position(robot);
    const Twist twist = session_.twist(robot);
    put(name(robot));
    put(":{");
    put_place(at);
    put(",\"heading\":", network.heading(robot).value);
    put(",\"v\":", twist.speed);
    put(",\"w\":", twist.turn_rate);
    put(",\"on\":", truth(network.medium().stations().is_on(robot)));
    put(",\"stalled\":", truth(session_.is_stalled(robot)));
    put(",\"no_way\":", truth(session_.has_no_way(robot)));
    put("}");
}

template <class PutOne>
void AnswerWriter::put_column(std::string_view key, const std::vector<NodeId>& robots,
                              PutOne put_one) {
    put(",\"", key, "\":[");
    put_list(robots, put_one);
    put("]");
}

void AnswerWriter::put_columns(const std::vector<NodeId>& robots) {
    const Network& network = session_.network();
    put(",\"state\":{\"robots\":[");
    put_list(robots, [&](NodeId robot) { put(std::uint64_t{robot.value}); });
    put("]");
    put_column("x", robots, [&](NodeId robot) { put(network.position(robot).x); });
    put_column("y", robots, [&](NodeId robot) { put(network.position(robot).y); });
    if (std::any_of(robots.begin(), robots.end(),
                    [&](NodeId robot) { return tells_height(network.position(robot)); })) {
        put_column("z", robots, [&](NodeId robot) { put(network.position(robot).z); });
    }
    put_column("heading", robots, [&](NodeId robot) { put(network.heading(robot).value); });
    put_column("v", robots, [&](NodeId robot) { put(session_.twist(robot).speed); });
    put_column("w", robots, [&](NodeId robot) { put(session_.twist(robot).turn_rate); });
    put_column("on", robots,
               [&](NodeId robot) { put(truth(network.medium().stations().is_on(robot))); });
    put_column("stalled", robots, [&](NodeId robot) { put(truth(session_.is_stalled(robot))); });
    put_column("no_way", robots, [&](NodeId robot) { put(truth(session_.has_no_way(robot))); });
    put("}");
}

void AnswerWriter::put_heard(const HeardMessage& heard) {
    put("{\"at\":", name(heard.at));
    put(",\"t_ns\":", heard.time.time_since_epoch().count());
    put(",\"from\":", name(heard.from));
    put(",\"last_hop\":", name(heard.last_hop));
    put(",\"hops\":", std::int64_t{heard.hops});
    put(",\"port\":", std::uint64_t{heard.port});
    put(",\"rssi\":");
    heard.level ? put(heard.level->value) : put("null");
    put(",\"noise\":", session_.network().medium().stations().noise(heard.at).value);
    put(",\"data\":\"", base64(heard.payload));
    put("\"}");
}

void AnswerWriter::put_neighbors(NodeId robot) {
    const Network& network = session_.network();
    put(name(robot));
    put(":[");
    put_list(network.links(robot, network.now()), [&](const Neighbour& neighbour) {
        put("{\"name\":", name(neighbour.node));
        put(",\"rssi\":", neighbour.level.value);
        put(",\"noise\":", neighbour.noise.value);
        put(",\"quality\":", std::int64_t{neighbour.quality});
        put("}");
    });
    put("]");
}

/// Range finders of a robot, with the begin and the direction of each beam in the robot's frame.
void AnswerWriter::put_scanners(NodeId robot) {
    put(",\"scan\":[");
    put_list(session_.range_finders(robot), [&](const Scanner& scanner) {
        put("{\"name\":", to_json_line(Value(scanner.label())));
        put(",\"kind\":", to_json_line(Value(name_of(scanner.finder.kind))));
        put(",\"range\":", scanner.finder.range.value);
        put(",\"beams\":[");
        const char* between = "";
        for (std::size_t i = 0; i < scanner.size(); ++i) {
            const ScannerPose beam = scanner.pose() * scanner.beam(i);
            put(between);
            put("[", beam.at.x, ",", beam.at.y, ",", beam.heading.value, "]");
            between = ",";
        }
        put("]}");
    });
    put("]");
}

/// Distances that each range finder of a robot measures now.
void AnswerWriter::put_scans(NodeId robot) {
    put(name(robot));
    put(":[");
    const char* between = "";
    for (std::size_t i = 0; i < session_.range_finders(robot).size(); ++i) {
        put(between);
        put("[");
        put_list(session_.scan(robot, i), [&](double metres) { put(metres); });
        put("]");
        between = ",";
    }
    put("]");
}

std::string error_line(const RequestError& fault, std::optional<std::uint64_t> number) {
    Table table;
    table.set("type", "error");
    if (number) table.set("n", *number);
    table.set("code", fault.code());
    table.set("at", fault.at());
    table.set("msg", fault.what());
    return to_json_line(Value(std::move(table)));
}

std::string end_line(std::string_view reason, std::string_view fingerprint, const Table& metrics) {
    Table table;
    table.set("type", "end");
    table.set("reason", reason);
    table.set("fingerprint", fingerprint);
    table.set("metrics", metrics);
    return to_json_line(Value(std::move(table)));
}

}  // namespace rovernet
