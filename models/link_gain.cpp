// SPDX-License-Identifier: MIT
#include "models/link_gain.hpp"

#include "sim/math.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <span>
#include <stdexcept>
#include <vector>

namespace rovernet {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// Pattern of exponent 1: 10 log10((1 + cos phi) / 2).
double half_angle_db(double cos_phi) { return 10 * math::log10(std::max(0.0, (1 + cos_phi) / 2)); }

double cosine_db(const Radio& radio, double cos_phi) {
    const double width = radio.antenna_beamwidth.value_or(Radians{60 * degree}).value;
    const double exponent = -3 / half_angle_db(math::sincos(width / 2).cos);
    const double floor = -radio.front_to_back.value_or(Db{20}).value;
    return std::clamp(exponent * half_angle_db(cos_phi), floor, 0.0);
}

/// Gain in the table at an angle, interpolated between neighbouring points, also around the turn.
double table_db(std::span<const PatternPoint> points, double degrees) {
    while (degrees < points.front().degrees) degrees += 360;
    while (degrees >= points.front().degrees + 360) degrees -= 360;
    std::size_t i = points.size() - 1;
    while (points[i].degrees > degrees) --i;
    PatternPoint next = points[(i + 1) % points.size()];
    if (i + 1 == points.size()) next.degrees += 360;
    const double share = (degrees - points[i].degrees) / (next.degrees - points[i].degrees);
    return points[i].db + share * (next.db - points[i].db);
}

}  // namespace

Db pattern_gain(const Radio& radio, const Pose& pose, Vec3 place) {
    if (!radio.is_directional()) return Db{0};
    const double dx = place.x - pose.antenna.x, dy = place.y - pose.antenna.y;
    const double distance = std::sqrt(dx * dx + dy * dy);
    if (distance == 0) return Db{0};
    const Radians direction = pose.heading + radio.antenna_direction.value_or(Radians{0});
    const auto [sin, cos] = math::sincos(direction.value);
    const double along = (cos * dx + sin * dy) / distance;
    if (radio.antenna == AntennaShape::cosine) return {cosine_db(radio, along)};
    const double across = (cos * dy - sin * dx) / distance;
    return {table_db(*radio.antenna_pattern, math::atan2(across, along) / degree)};
}

void check_antenna(const Radio& radio) {
    const auto points = radio.antenna_pattern.value_or(std::vector<PatternPoint>{});
    if (radio.antenna == AntennaShape::table && points.empty()) {
        throw std::invalid_argument(
            "antenna_pattern: antenna \"table\" needs points, such as [[0, 0], [180, -20]]");
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto [degrees, db] = points[i];
        if (!(db <= 0)) {
            throw std::invalid_argument(fmt::format(
                "antenna_pattern: found {:g} dB; expected at most 0 dB: antenna_gain is the gain "
                "in the strongest direction",
                db));
        }
        const bool ascends = i == 0 || degrees > points[i - 1].degrees;
        if (ascends && degrees < points.front().degrees + 360) continue;
        throw std::invalid_argument(
            fmt::format("antenna_pattern: found {:g} degrees after {:g}; expected angles in "
                        "ascending order, all within one turn of 360 degrees",
                        degrees, points[i - (i > 0 ? 1 : 0)].degrees));
    }
}

}  // namespace rovernet
