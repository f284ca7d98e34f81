// SPDX-License-Identifier: MIT
#include "pictures/foxglove/foxglove_trace.hpp"

#include "experiment/recorded_scenario.hpp"
#include "files/base64.hpp"
#include "pictures/foxglove/foxglove_schemas.hpp"
#include "scenario/document/json.hpp"
#include "traces/recorded/mcap_writer.hpp"
#include "traces/recorded/recorded_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <variant>

namespace rovernet {
namespace {

using namespace foxglove;

constexpr Duration step{100'000'000};  // between two transforms of a robot that moves
constexpr Duration line_stays{200'000'000};
constexpr Color on_color{.r = 0.12, .g = 0.47, .b = 0.71}, off_color{.r = 0.6, .g = 0.6, .b = 0.6};
constexpr Color delivered_color{.r = 0.17, .g = 0.63, .b = 0.17};
constexpr Color other_color{.r = 0.6, .g = 0.6, .b = 0.6, .a = 0.6};
constexpr Color lost_color{.r = 0.84, .g = 0.15, .b = 0.16};

enum class Topic : std::uint16_t { map = 1, transforms, robots, frames, messages };
struct Channel {
    Topic topic;
    std::string_view name, type;
};
constexpr std::array<Channel, 5> channels{{{Topic::map, "/map", "foxglove.Grid"},
                                           {Topic::transforms, "/tf", "foxglove.FrameTransforms"},
                                           {Topic::robots, "/robots", "foxglove.SceneUpdate"},
                                           {Topic::frames, "/frames", "foxglove.SceneUpdate"},
                                           {Topic::messages, "/messages", "foxglove.Log"}}};

/// File with a channel for each Topic, whose messages are JSON.
class FoxgloveFile {
  public:
    FoxgloveFile(const std::string& path, std::string_view version)
        : file_(path, "", fmt::format("rovernet {}", version)) {
        for (const Channel& channel : channels) {
            const std::string schema = to_json_line(schema_of(channel.type));
            file_.declare({.number = static_cast<std::uint16_t>(channel.topic),
                           .topic = channel.name,
                           .encoding = "json",
                           .schema_name = channel.type,
                           .schema_encoding = "jsonschema",
                           .schema = schema});
        }
    }
    void add(Topic topic, Time time, Table message) {
        constexpr std::size_t chunk_size = 1 << 20;
        chunk_.begin_message(static_cast<std::uint16_t>(topic),
                             static_cast<std::uint64_t>((time - start_of_run).count()));
        chunk_.bytes().bytes(to_json_line(Value(std::move(message))));
        chunk_.end_message();
        if (chunk_.bytes().size() > chunk_size) write_chunk();
    }
    void finish() {
        if (chunk_.bytes().size() > 0) write_chunk();
        file_.finish();
        file_.give_name();
    }

  private:
    void write_chunk() {
        file_.write(chunk_);
        chunk_.clear();
    }
    McapWriter file_;
    McapChunk chunk_;
};

Table grid_message(const OccupancyGrid& map) {
    std::string walls;
    for (const Cell cell : map.cells) walls += cell == Cell::occupied ? '\1' : '\0';
    constexpr int uint8 = 1;  // foxglove.PackedElementField
    Table field, size, message;
    field.set("name", "wall");
    field.set("offset", 0);
    field.set("type", uint8);
    size.set("x", map.cell_width);
    size.set("y", map.cell_height);
    message.set("timestamp", time(start_of_run));
    message.set("frame_id", "map");
    message.set("pose", pose(map.origin, map.yaw));
    message.set("column_count", map.columns);
    message.set("cell_size", std::move(size));
    message.set("row_stride", map.columns);
    message.set("cell_stride", 1);
    message.set("fields", Array{std::move(field)});
    message.set("data", base64(walls));
    return message;
}

/// Name of the coordinate frame of a robot: its own name, unless that is the frame of the map.
std::string frame_of(const std::string& robot) { return robot == "map" ? "robot map" : robot; }

/// Body, heading and name of a robot, in its own coordinate frame.
Table robot_entity(Time t, const std::string& name, double radius, bool is_on) {
    const double r = std::max(radius, 0.05);
    const Table its_color = color(is_on ? on_color : off_color);
    Table body, heading, label;
    body.set("pose", pose({0, 0, r / 2}, 0));
    body.set("size", vector({2 * r, 2 * r, r}));
    body.set("bottom_scale", 1.0);
    body.set("top_scale", 1.0);
    body.set("color", its_color);
    heading.set("pose", pose({0, 0, r}, 0));
    heading.set("shaft_length", 1.2 * r);
    heading.set("shaft_diameter", 0.2 * r);
    heading.set("head_length", 0.5 * r);
    heading.set("head_diameter", 0.5 * r);
    heading.set("color", its_color);
    constexpr double letter_height = 14;  // [pixels], as scale_invariant
    label.set("pose", pose({0, 0, 3 * r}, 0));
    label.set("billboard", true);
    label.set("font_size", letter_height);
    label.set("scale_invariant", true);
    label.set("color", its_color);
    label.set("text", name);
    Table all = entity(t, frame_of(name), name, Duration{0});
    all.set("cylinders", Array{std::move(body)});
    all.set("arrows", Array{std::move(heading)});
    all.set("texts", Array{std::move(label)});
    return all;
}

/// Makes messages of records, in the order of the run.
class FoxgloveTrace {
  public:
    FoxgloveTrace(RecordedReader& trace, const std::string& in, const std::string& out)
        : trace_(trace), file_(out, trace.run().version), names_(trace.run().robots) {
        const ReplayedScenario replayed(trace.run(), in);
        const Scenario scenario = replayed.with({});
        check_robots(trace.run(), scenario, in);
        end_ = start_of_run + scenario.scenario.duration;
        if (scenario.walls && !scenario.walls->open_field()) {
            for (const OccupancyGrid& map : scenario.walls->maps())
                file_.add(Topic::map, start_of_run, grid_message(map));
        }
        std::map<std::string, double> radii;
        for (const RobotTable& table : scenario.robots) {
            for (int i = 0; i < table.count.value_or(1); ++i)
                radii[table.name_of(i)] = table.radius.value;
        }
        for (const std::string& name : names_) {
            const auto found = radii.find(name);
            radii_.push_back(found == radii.end() ? RobotTable{}.radius.value : found->second);
        }
        legs_.resize(names_.size());
        told_.resize(names_.size());
        is_on_.resize(names_.size(), true);
    }

    void take(const Record& record) {
        const Time now = trace_.now();
        pass_time(now);
        if (const auto* moved = std::get_if<Moved>(&record)) {
            if (moved->node.index() < legs_.size()) legs_[moved->node.index()] = moved->leg;
        } else if (const auto* switched = std::get_if<Switched>(&record)) {
            if (switched->node.index() >= names_.size()) return;
            is_on_[switched->node.index()] = switched->on;
            if (has_begun_) show(switched->node.index(), now);
        } else if (const auto* sent = std::get_if<Sent>(&record)) {
            tell(now, sent->node, fmt::format("sends message {}", text_of(sent->message)));
        } else if (const auto* received = std::get_if<Received>(&record)) {
            draw(*received);
        }
    }

    std::vector<std::string> finish() {
        pass_time(end_);
        transform(end_);
        file_.finish();
        return trace_.damage();
    }

  private:
    /// Writes where the robots are at each step before `now`.
    void pass_time(Time now) {
        if (!has_begun_ && now > start_of_run) {
            has_begun_ = true;
            transform(start_of_run);
            for (std::size_t i = 0; i < names_.size(); ++i) show(i, start_of_run);
        }
        for (; next_ < now; next_ += step) transform(next_);
    }

    /// Writes the coordinate frames of the robots that have moved since the last transform.
    void transform(Time t) {
        Array changed;
        for (std::size_t i = 0; i < names_.size(); ++i) {
            const Vec3 at = legs_[i].position(t);
            const double heading = legs_[i].heading_at(t);
            if (told_[i] && told_[i]->first == at && told_[i]->second == heading) continue;
            told_[i] = {at, heading};
            Table one;
            one.set("timestamp", time(t));
            one.set("parent_frame_id", "map");
            one.set("child_frame_id", frame_of(names_[i]));
            one.set("translation", vector(at));
            one.set("rotation", rotation(heading));
            changed.emplace_back(std::move(one));
        }
        if (changed.empty()) return;
        Table message;
        message.set("transforms", std::move(changed));
        file_.add(Topic::transforms, t, std::move(message));
    }

    void show(std::size_t robot, Time t) {
        Table shapes = robot_entity(t, names_[robot], radii_[robot], is_on_[robot]);
        file_.add(Topic::robots, t, scene_update({std::move(shapes)}));
    }

    /// Draws a line from the sender of a frame to each of its receivers.
    void draw(const Received& received) {
        const NodeId sender = received.frame.sender;
        if (received.receptions.empty() || sender.index() >= names_.size()) return;
        const Time now = trace_.now();
        const Vec3 from = legs_[sender.index()].position(now);
        Array points, colors;
        for (const Reception& each : received.receptions) {
            if (each.node.index() >= names_.size()) continue;
            points.emplace_back(vector(from));
            points.emplace_back(vector(legs_[each.node.index()].position(now)));
            const Color c = !is_decoded(each.fate) ? lost_color
                            : each.delivered       ? delivered_color
                                                   : other_color;
            for (int end = 0; end < 2; ++end) colors.emplace_back(color(c));
            if (each.delivered)
                tell(now, each.node,
                     fmt::format("receives message {} from {}", text_of(received.frame.message),
                                 names_[sender.index()]));
        }
        constexpr int line_list = 2;     // foxglove.LinePrimitive
        constexpr double thickness = 2;  // [pixels], as scale_invariant
        Table lines;
        lines.set("type", line_list);
        lines.set("pose", pose({}, 0));
        lines.set("thickness", thickness);
        lines.set("scale_invariant", true);
        lines.set("points", std::move(points));
        lines.set("color", color(other_color));
        lines.set("colors", std::move(colors));
        lines.set("indices", Array{});
        Table frame = entity(now, "map", fmt::format("frame {}", ++frames_), line_stays);
        frame.set("lines", Array{std::move(lines)});
        file_.add(Topic::frames, now, scene_update({std::move(frame)}));
    }

    void tell(Time t, NodeId node, std::string text) {
        if (node.index() >= names_.size()) return;
        constexpr int info = 2;  // foxglove.LogLevel
        Table message;
        message.set("timestamp", time(t));
        message.set("level", info);
        message.set("message", std::move(text));
        message.set("name", names_[node.index()]);
        message.set("file", "");
        message.set("line", 0);
        file_.add(Topic::messages, t, std::move(message));
    }

    /// Number of a message, as `rovernet trace follow` has it.
    std::string text_of(MessageId message) const {
        return std::to_string(trace_.context().messages[message].uid);
    }

    RecordedReader& trace_;
    FoxgloveFile file_;
    std::vector<std::string> names_;
    std::vector<double> radii_;  // [m]
    std::vector<Leg> legs_;      // the current ones
    std::vector<bool> is_on_;
    // Position and heading in the last transform of each robot.
    std::vector<std::optional<std::pair<Vec3, double>>> told_;
    Time next_ = start_of_run + step, end_ = start_of_run;
    bool has_begun_ = false;
    std::uint64_t frames_ = 0;
};

}  // namespace

std::vector<std::string> convert_to_foxglove(const std::string& in, const std::string& out) {
    RecordedReader trace(in);
    FoxgloveTrace made(trace, in, out);
    while (const Record* record = trace.next()) made.take(*record);
    return made.finish();
}

}  // namespace rovernet
