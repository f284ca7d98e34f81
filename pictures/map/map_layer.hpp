// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/draw/legend.hpp"
#include "pictures/draw/plot.hpp"
#include "pictures/draw/svg.hpp"
#include "scene/scene.hpp"

#include <array>
#include <vector>

namespace rovernet {

/// Map in a picture: walls with one grey or hatch per material, unknown cells in light grey.
class MapLayer {
  public:
    /// @param scene  scene to draw; outlives the layer
    /// @param open   scene with all doors open, from which the unknown cells are taken
    MapLayer(const Scene& scene, const Scene& open);
    explicit MapLayer(const Scene& scene) : MapLayer(scene, scene) {}

    /// Adds a door by its corners: an open door is drawn as a dashed outline, a closed door as a
    /// wall with a coloured outline.
    void add_door(const std::array<Vec3, 4>& corners, bool closed) {
        (closed ? closed_doors_ : open_doors_).push_back(corners);
    }
    /// Adds stairs, drawn as steps from the foot to the head, with an arrow at the head.
    void add_stairs(Vec3 foot, Vec3 head) { stairs_.push_back({foot, head}); }

    /// @param on_colors  true over a heat map: walls get a white outline, and unknown cells are
    ///                   hatched so that colours stay visible
    void draw(Svg& svg, const Plot& plot, bool on_colors) const;
    void append_to(Legend& legend, bool on_colors) const;

  private:
    using Corners = std::array<Vec3, 4>;

    const Scene& scene_;
    std::vector<std::vector<Corners>> walls_;  // walls by material
    std::vector<Corners> unknown_;
    std::vector<Corners> open_doors_, closed_doors_;
    std::vector<std::array<Vec3, 2>> stairs_;
};

}  // namespace rovernet
