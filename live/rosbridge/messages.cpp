// SPDX-License-Identifier: MIT
#include "live/rosbridge/messages.hpp"

#include "experiment/reports/link_table.hpp"
#include "live/rosbridge/square_cells.hpp"
#include "mobility/planners.hpp"
#include "models/medium/medium.hpp"
#include "sim/math.hpp"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <limits>
#include <vector>

namespace rovernet {
namespace {

constexpr std::string_view world_frame = "map";
constexpr std::array<double, 36> no_covariance = {};

void put(RosWriter& out, std::string_view key, double value) {
    out.key(key);
    out.number(value);
}
void put_text(RosWriter& out, std::string_view key, std::string_view value) {
    out.key(key);
    out.text(value);
}
void put_whole(RosWriter& out, std::string_view key, std::int64_t value) {
    out.key(key);
    out.whole(value);
}

/// Opens an object under a key, and closes it again.
class Within {
  public:
    Within(RosWriter& out, std::string_view key) : out_(out) {
        out.key(key);
        out.open_object();
    }
    explicit Within(RosWriter& out) : out_(out) { out.open_object(); }
    ~Within() { out_.close_object(); }
    Within(const Within&) = delete;
    Within& operator=(const Within&) = delete;

  private:
    RosWriter& out_;
};

void put_header(RosWriter& out, Time stamp, std::string_view frame) {
    const Within header(out, "header");
    out.key("stamp");
    write_time(out, stamp);
    put_text(out, "frame_id", frame);
}

void put_vector(RosWriter& out, std::string_view key, Vec3 value) {
    const Within vector(out, key);
    put(out, "x", value.x);
    put(out, "y", value.y);
    put(out, "z", value.z);
}

/// The rotation about the z axis by an angle.
void put_rotation(RosWriter& out, std::string_view key, Radians angle) {
    const auto [sin, cos] = math::sincos(angle.value / 2);
    const Within quaternion(out, key);
    put(out, "x", 0);
    put(out, "y", 0);
    put(out, "z", sin);
    put(out, "w", cos);
}

void put_transform(RosWriter& out, Time stamp, std::string_view frame, std::string_view child,
                   Vec3 at, Radians heading) {
    const Within stamped(out);
    put_header(out, stamp, frame);
    put_text(out, "child_frame_id", child);
    const Within transform(out, "transform");
    put_vector(out, "translation", at);
    put_rotation(out, "rotation", heading);
}

/// Whether a range finder measures in a frame of its own, beside that of its robot.
bool has_frame(const Scanner& scanner) {
    const bool is_at_origin = scanner.at == Vec3{} && scanner.heading == Radians{};
    return !scanner.is_ring() && !is_at_origin;
}

std::int8_t occupancy(Cell cell) {
    switch (cell) {
        case Cell::free: return 0;
        case Cell::occupied: return 100;
        case Cell::unknown: break;
    }
    return -1;
}

}  // namespace

void write_time(RosWriter& out, Time time) {
    const auto whole = std::chrono::floor<std::chrono::seconds>(time);
    const Within stamp(out);
    put_whole(out, "sec", whole.time_since_epoch().count());
    put_whole(out, "nanosec", (time - whole).count());
}

Duration RosMessages::period(const RosTopic& topic) const {
    if (topic.kind() == RosTopicKind::scan)
        return session_.range_finders(topic.robot)[topic.scanner].finder.every;
    return topic.type->period;
}

void RosMessages::write(RosWriter& out, const RosTopic& topic) const {
    const Within message(out);
    switch (topic.kind()) {
        case RosTopicKind::clock: out.key("clock"); return write_time(out, network().now());
        case RosTopicKind::transforms: return write_transforms(out);
        case RosTopicKind::static_transforms: return write_static_transforms(out);
        case RosTopicKind::map: return write_map(out);
        case RosTopicKind::odometry: return write_odometry(out, topic.robot);
        case RosTopicKind::scan: return write_scan(out, topic.robot, topic.scanner);
        case RosTopicKind::neighbors: return write_neighbors(out, topic.robot);
        default: return;
    }
}

void RosMessages::write_transforms(RosWriter& out) const {
    out.key("transforms");
    out.open_list();
    for (NodeId robot{0}; robot.index() < network().size(); ++robot.value) {
        const std::string name = network().name(robot);
        put_transform(out, network().now(), name + "/odom", name + "/base_link",
                      network().position(robot), network().heading(robot));
    }
    out.close_list();
}

void RosMessages::write_static_transforms(RosWriter& out) const {
    out.key("transforms");
    out.open_list();
    for (NodeId robot{0}; robot.index() < network().size(); ++robot.value) {
        put_transform(out, start_of_run, world_frame, network().name(robot) + "/odom", {}, {});
        for (const Scanner& each : session_.range_finders(robot)) {
            if (!has_frame(each)) continue;
            put_transform(out, start_of_run, network().name(robot) + "/base_link",
                          scan_frame(robot, each), each.at, each.heading);
        }
    }
    out.close_list();
}

void RosMessages::write_map(RosWriter& out) const {
    // All doors are open. The message has a single number for both sides of a cell.
    const OccupancyGrid grid = square_cells(network().planners().scene().grid());
    put_header(out, start_of_run, world_frame);
    {
        const Within info(out, "info");
        out.key("map_load_time");
        write_time(out, start_of_run);
        put(out, "resolution", grid.cell_width);
        put_whole(out, "width", grid.columns);
        put_whole(out, "height", grid.rows);
        const Within origin(out, "origin");
        put_vector(out, "position", grid.origin);
        put_rotation(out, "orientation", Radians{grid.yaw});
    }
    std::vector<std::int8_t> cells;
    cells.reserve(grid.cells.size());
    for (const Cell cell : grid.cells) cells.push_back(occupancy(cell));
    out.key("data");
    out.numbers(cells);
}

void RosMessages::write_odometry(RosWriter& out, NodeId robot) const {
    const std::string name = network().name(robot);
    const Twist twist = session_.twist(robot);
    put_header(out, network().now(), name + "/odom");
    put_text(out, "child_frame_id", name + "/base_link");
    {
        const Within uncertain(out, "pose");
        {
            const Within pose(out, "pose");
            put_vector(out, "position", network().position(robot));
            put_rotation(out, "orientation", network().heading(robot));
        }
        out.key("covariance");
        out.numbers(no_covariance);
    }
    const Within uncertain(out, "twist");
    {
        const Within velocity(out, "twist");
        put_vector(out, "linear", {twist.speed, 0, 0});
        put_vector(out, "angular", {0, 0, twist.turn_rate});
    }
    out.key("covariance");
    out.numbers(no_covariance);
}

/// Frame in which a range finder of a robot measures.
std::string RosMessages::scan_frame(NodeId robot, const Scanner& scanner) const {
    const std::string name = network().name(robot);
    return has_frame(scanner) ? fmt::format("{}/{}_frame", name, scanner.label())
                              : name + "/base_link";
}

void RosMessages::write_scan(RosWriter& out, NodeId robot, std::size_t number) const {
    const Scanner& scanner = session_.range_finders(robot)[number];
    const RangeFinder& finder = scanner.finder;
    std::vector<float> ranges;
    for (const double range : session_.scan(robot, number)) {
        // REP 117: a beam without an echo has the range infinity.
        ranges.push_back(range < finder.range.value ? static_cast<float>(range)
                                                    : std::numeric_limits<float>::infinity());
    }
    put_header(out, network().now(), scan_frame(robot, scanner));
    put(out, "angle_min", finder.from.value);
    put(out, "angle_max", finder.to.value);
    put(out, "angle_increment", finder.step().value);
    put(out, "time_increment", 0);
    put(out, "scan_time", seconds(finder.every));
    put(out, "range_min", 0);
    put(out, "range_max", finder.range.value);
    out.key("ranges");
    out.numbers(ranges);
    out.key("intensities");
    out.numbers(std::span<const float>{});
}

void RosMessages::write_neighbors(RosWriter& out, NodeId robot) const {
    const std::string name = network().name(robot);
    put_header(out, network().now(), name + "/base_link");
    out.key("neighbors");
    out.open_list();
    for_each_link_table(network(), name, [&](const LinkTable& table) {
        for (const LinkTable::Row& row : table.rows) {
            const Device& device = row.neighbour;
            const Within neighbor(out);
            put_text(out, "address", device.robot);
            put_text(out, "ip", device.ip);
            put_text(out, "mac", device.mac);
            put_text(out, "essid", device.essid);
            put(out, "frequency", device.frequency.value / 1e6);
            put(out, "rssi", row.level.value);
            put(out, "noise", row.noise.value);
            put_whole(out, "quality", row.quality);
            out.key("last_heard");
            const auto heard = robots_.last_heard(robot, *network().find(device.robot));
            heard ? write_time(out, *heard) : out.null();
        }
    });
    out.close_list();
}

void RosMessages::write(RosWriter& out, const HeardMessage& heard) const {
    const Within message(out);
    out.key("stamp");
    write_time(out, heard.time);
    put_text(out, "src_address", network().name(heard.from));
    put_text(out, "last_hop", network().name(heard.last_hop));
    put_text(out, "dst_address", heard.is_for_everyone ? "*" : network().name(heard.at));
    put_whole(out, "dst_port", heard.port);
    put_whole(out, "hops", heard.hops);
    out.key("rssi");
    heard.level ? out.number(heard.level->value) : out.null();
    put(out, "noise", network().medium().stations().noise(heard.at).value);
    out.key("data");
    out.bytes(heard.payload);
}

}  // namespace rovernet
