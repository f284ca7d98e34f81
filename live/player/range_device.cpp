// SPDX-License-Identifier: MIT
#include "live/player/range_device.hpp"

#include <algorithm>
#include <array>

namespace rovernet {
namespace {

enum LaserRequest : std::uint32_t { laser_geometry = 1, laser_set = 2, laser_get = 3 };
enum RangerRequest : std::uint32_t { ranger_geometry = 1, ranger_set = 4, ranger_get = 5 };
constexpr std::uint32_t sonar_geometry = 1;

constexpr std::size_t size_bytes = 24;  // [bytes] of a size that is all 0

float single(double number) { return static_cast<float>(number); }

/// Place, and rotations about the three axes.
void put_pose(XdrWriter& out, const ScannerPose& pose) {
    out.f64s(std::array{pose.at.x, pose.at.y, pose.at.z, 0.0, 0.0, pose.heading.value});
}

void put_singles(XdrWriter& out, const std::vector<double>& ranges) {
    out.count(ranges.size());
    for (const double range : ranges) out.f32(single(range));
}

}  // namespace

PlayerRangeDevice::PlayerRangeDevice(PlayerRobot& robot, std::size_t number)
    : robot_(robot),
      number_(number),
      scanner_(robot.session().range_finders(robot.id())[number]),
      first_(scanner_.finder.from),
      last_(scanner_.finder.to) {
    if (!scanner_.is_ring()) return;
    const auto [least, most] = std::minmax_element(scanner_.angles.begin(), scanner_.angles.end());
    first_ = *least;
    last_ = *most;
}

PlayerInterface PlayerRangeDevice::interface() const { return player_interface(scanner_); }

PlayerInterface player_interface(const Scanner& scanner) {
    switch (scanner.finder.kind) {
        case RangeFinderKind::laser: return PlayerInterface::laser;
        case RangeFinderKind::sonar: return PlayerInterface::sonar;
        case RangeFinderKind::ranger: break;
    }
    return PlayerInterface::ranger;
}

std::vector<std::string> PlayerRangeDevice::data() {
    const std::vector<double> ranges = robot_.session().scan(robot_.id(), number_);
    const RangeFinder& finder = scanner_.finder;
    XdrWriter out;
    switch (finder.kind) {
        case RangeFinderKind::laser:
            out.f32(single(finder.from.value)).f32(single(finder.to.value));
            out.f32(single(finder.step().value)).f32(single(finder.range.value));
            put_singles(out, ranges);
            out.bytes({});  // intensities
            out.u32(0);     // number of the scan
            break;
        case RangeFinderKind::sonar: put_singles(out, ranges); break;
        case RangeFinderKind::ranger: out.count(ranges.size()).f64s(ranges); break;
    }
    return {out.take()};
}

std::optional<std::string> PlayerRangeDevice::answer(std::uint32_t subtype, XdrReader) {
    switch (scanner_.finder.kind) {
        case RangeFinderKind::laser: return answer_laser(subtype);
        case RangeFinderKind::sonar:
            return subtype == sonar_geometry ? std::optional(sonar_poses()) : std::nullopt;
        case RangeFinderKind::ranger: break;
    }
    return answer_ranger(subtype);
}

/// What holds is the scenario's: setting it is answered with that.
std::optional<std::string> PlayerRangeDevice::answer_laser(std::uint32_t subtype) const {
    XdrWriter out;
    if (subtype == laser_geometry) {
        put_pose(out, scanner_.pose());
        return out.zeros(size_bytes).take();
    }
    if (subtype != laser_get && subtype != laser_set) return std::nullopt;
    const RangeFinder& finder = scanner_.finder;
    return out.f32(single(finder.from.value))
        .f32(single(finder.to.value))
        .f32(single(finder.step().value))
        .f32(single(finder.range.value))
        .f32(0)  // resolution of ranges: exact
        .u32(0)  // no intensities
        .f32(single(1 / seconds(finder.every)))
        .take();
}

std::optional<std::string> PlayerRangeDevice::answer_ranger(std::uint32_t subtype) const {
    if (subtype == ranger_geometry) return ranger_poses();
    if (subtype != ranger_get && subtype != ranger_set) return std::nullopt;
    const RangeFinder& finder = scanner_.finder;
    const double step = scanner_.is_ring() ? 0 : finder.step().value;
    return XdrWriter()
        .f64s(std::array{first_.value, last_.value, step, 0.0, finder.range.value, 0.0,
                         1 / seconds(finder.every)})
        .take();
}

/// Pose and size of the whole, and of its elements: the beams of a ring, or one with all beams.
std::string PlayerRangeDevice::ranger_poses() const {
    const std::size_t elements = scanner_.is_ring() ? scanner_.size() : 1;
    XdrWriter out;
    put_pose(out, scanner_.pose());
    out.zeros(size_bytes).count(elements);
    for (std::size_t i = 0; i < elements; ++i) {
        put_pose(out, scanner_.is_ring() ? scanner_.beam(i) : ScannerPose{});
    }
    return out.count(elements).zeros(elements * size_bytes).take();
}

std::string PlayerRangeDevice::sonar_poses() const {
    XdrWriter out;
    out.count(scanner_.size());
    for (std::size_t i = 0; i < scanner_.size(); ++i) {
        put_pose(out, scanner_.pose() * scanner_.beam(i));
    }
    return out.take();
}

}  // namespace rovernet
