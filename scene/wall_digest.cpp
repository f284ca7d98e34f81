// SPDX-License-Identifier: MIT
#include "scene/wall_digest.hpp"

#include <fmt/format.h>
#include <xxhash.h>

namespace rovernet {
namespace {

/// The walls as bytes: where they are and what they are made of.
std::string wall_bytes(const Scene& scene) {
    std::string bytes;
    const auto append = [&](double v) {
        bytes.append(reinterpret_cast<const char*>(&v), sizeof v);
    };
    for (const WallRectangle& wall : scene.wall_rectangles()) {
        for (const Vec3& corner : wall.corners) {
            append(corner.x);
            append(corner.y);
        }
        append(static_cast<double>(wall.material));
    }
    for (std::size_t i = 0; i < scene.storeys().size(); ++i) {
        if (i > 0) append(scene.storeys().floor(i));
        for (const Cell cell : scene.storey(i).grid().cells) bytes += static_cast<char>(cell);
    }
    const auto append_material = [&](const Material& m) {
        append(m.per_crossing ? m.per_crossing->value : -1);
        append(m.per_metre ? m.per_metre->value : -1);
        append(m.slab ? static_cast<double>(*m.slab) : -1);
        append(m.thickness.value);
        append(m.height.value);
    };
    for (const Material& m : scene.materials()) append_material(m);  // some are of a file beside
    for (const Material& m : scene.storeys().ceilings()) append_material(m);
    return bytes;
}

}  // namespace

std::string wall_digest(const Scene& scene) {
    const std::string bytes = wall_bytes(scene);
    return fmt::format("{:016x}", XXH64(bytes.data(), bytes.size(), 0));
}

}  // namespace rovernet
