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
    explicit MapLayer(const Scene& scene);

    /// @param on_colors  the walls get a white seam to stand out; the unknown is hatched, so that
    ///                   it hides nothing
    void draw(Svg& svg, const Plot& plot, bool on_colors) const;
    void append_to(Legend& legend, bool on_colors) const;

  private:
    using Corners = std::array<Vec3, 4>;

    const Scene& scene_;
    std::vector<std::vector<Corners>> walls_;  // walls by material
    std::vector<Corners> unknown_;
};

}  // namespace rovernet
