// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/draw/legend.hpp"
#include "pictures/draw/plot.hpp"
#include "pictures/draw/svg.hpp"
#include "scene/scene.hpp"

#include <array>
#include <vector>

namespace rovernet {

/// The map of a picture: walls in a grey or hatch per material, unknown cells light grey.
class MapLayer {
  public:
    /// @param scene  outlives the layer
    /// @param open   the same with all doors open, whose unknown cells are drawn
    MapLayer(const Scene& scene, const Scene& open);
    explicit MapLayer(const Scene& scene) : MapLayer(scene, scene) {}

    /// Adds a door that is open, by its corners: it is drawn as a dashed outline.
    void add_open_door(const std::array<Vec3, 4>& corners) { open_doors_.push_back(corners); }

    /// @param on_colors  the walls get a white seam to stand out; the unknown is hatched, so that
    ///                   it hides nothing
    void draw(Svg& svg, const Plot& plot, bool on_colors) const;
    void append_to(Legend& legend, bool on_colors) const;

  private:
    using Corners = std::array<Vec3, 4>;

    const Scene& scene_;
    std::vector<std::vector<Corners>> walls_;  // walls by material
    std::vector<Corners> unknown_;
    std::vector<Corners> open_doors_;
};

}  // namespace rovernet
