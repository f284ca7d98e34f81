// SPDX-License-Identifier: MIT
#include "live/player/range_device.hpp"

#include <utility>

namespace rovernet {
namespace {

enum LaserRequest : std::uint32_t { laser_geometry = 1, laser_set = 2, laser_get = 3 };
enum RangerRequest : std::uint32_t { ranger_geometry = 1, ranger_set = 4, ranger_get = 5 };
constexpr std::uint32_t sonar_geometry = 1;

constexpr std::size_t pose_bytes = 48;           // [bytes] of a pose that is all 0
constexpr std::size_t pose_and_size_bytes = 72;  // [bytes] of such a pose and a size
constexpr std::size_t size_bytes = 24;           // [bytes]

float single(double number) { return static_cast<float>(number); }

void put_singles(XdrWriter& out, const std::vector<double>& ranges) {
    out.count(ranges.size());
    for (const double range : ranges) out.f32(single(range));
}

}  // namespace

PlayerRangeDevice::PlayerRangeDevice(PlayerRobot& robot)
    : robot_(robot), finder_(*robot.session().range_finder(robot.id())) {}

PlayerInterface PlayerRangeDevice::interface() const {
    switch (finder_.kind) {
        case RangeFinderKind::laser: return PlayerInterface::laser;
        case RangeFinderKind::sonar: return PlayerInterface::sonar;
        case RangeFinderKind::ranger: break;
    }
    return PlayerInterface::ranger;
}

std::vector<std::string> PlayerRangeDevice::data() {
    const std::vector<double> ranges = robot_.session().scan(robot_.id());
    XdrWriter out;
    switch (finder_.kind) {
        case RangeFinderKind::laser:
            out.f32(single(finder_.from.value)).f32(single(finder_.to.value));
            out.f32(single(finder_.step().value)).f32(single(finder_.range.value));
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
    switch (finder_.kind) {
        case RangeFinderKind::laser: return answer_laser(subtype);
        case RangeFinderKind::sonar:
            return subtype == sonar_geometry ? std::optional(sonar_poses()) : std::nullopt;
        case RangeFinderKind::ranger: break;
    }
    return answer_ranger(subtype);
}

/// What holds is the scenario's: setting it is answered with that.
std::optional<std::string> PlayerRangeDevice::answer_laser(std::uint32_t subtype) const {
    if (subtype == laser_geometry) return XdrWriter().zeros(pose_and_size_bytes).take();
    if (subtype != laser_get && subtype != laser_set) return std::nullopt;
    return XdrWriter()
        .f32(single(finder_.from.value))
        .f32(single(finder_.to.value))
        .f32(single(finder_.step().value))
        .f32(single(finder_.range.value))
        .f32(0)  // resolution of ranges: exact
        .u32(0)  // no intensities
        .f32(single(1 / seconds(finder_.every)))
        .take();
}

std::optional<std::string> PlayerRangeDevice::answer_ranger(std::uint32_t subtype) const {
    if (subtype == ranger_geometry) {
        return XdrWriter()
            .zeros(pose_and_size_bytes)
            .count(1)
            .zeros(pose_bytes)
            .count(1)
            .zeros(size_bytes)
            .take();
    }
    if (subtype != ranger_get && subtype != ranger_set) return std::nullopt;
    return XdrWriter()
        .f64s(std::vector{finder_.from.value, finder_.to.value, finder_.step().value, 0.0,
                          finder_.range.value, 0.0, 1 / seconds(finder_.every)})
        .take();
}

std::string PlayerRangeDevice::sonar_poses() const {
    XdrWriter out;
    out.count(static_cast<std::size_t>(finder_.beams));
    for (int i = 0; i < finder_.beams; ++i) {
        out.f64s(std::vector{0.0, 0.0, 0.0, 0.0, 0.0, finder_.angle(i).value});
    }
    return out.take();
}

}  // namespace rovernet
