// SPDX-License-Identifier: MIT
#include "scene/scanner.hpp"

#include "sim/math.hpp"

#include <stdexcept>

namespace rovernet {

ScannerPose operator*(const ScannerPose& outer, const ScannerPose& inner) {
    const auto [sin, cos] = math::sincos(outer.heading.value);
    const Vec3 turned{cos * inner.at.x - sin * inner.at.y, sin * inner.at.x + cos * inner.at.y,
                      inner.at.z};
    return {outer.at + turned, outer.heading + inner.heading};
}

std::string Scanner::label() const {
    return name.empty() ? std::string(name_of(finder.kind)) : name;
}

std::size_t Scanner::size() const {
    return is_ring() ? angles.size() : static_cast<std::size_t>(finder.beams);
}

ScannerPose Scanner::beam(std::size_t number) const {
    if (!is_ring()) return {{}, finder.angle(static_cast<int>(number))};
    return {places.empty() ? Vec3{} : places[number], angles[number]};
}

void Scanner::measure(const Scene& scene, const ScannerPose& robot,
                      std::span<const RoundBody> bodies, std::span<double> out) const {
    const ScannerPose own = robot * pose();
    if (!is_ring()) return finder.measure(scene, own.at, own.heading, bodies, out);
    if (out.size() != size()) {
        throw std::invalid_argument("Scanner: the output must have one element for each beam");
    }
    const RangeFinder single{.beams = 1, .from = {}, .to = {}, .range = finder.range};
    for (std::size_t i = 0; i < size(); ++i) {
        const ScannerPose begin = own * beam(i);
        single.measure(scene, begin.at, begin.heading, bodies, out.subspan(i, 1));
    }
}

}  // namespace rovernet
