// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/planners.hpp"
#include "scene/scene.hpp"

#include <cstddef>
#include <deque>
#include <memory>

namespace rovernet {

/// Cache of path planners for the scenes used last, for a worker that makes many runs.
///
/// A scene is immutable, so its address identifies it. A scene lives as long as its planners.
class KeptPlanners {
  public:
    /// @param most_cells  largest total number of cells of the cached scenes; a cell takes about 30
    ///                    bytes. The last scene is always kept
    explicit KeptPlanners(std::size_t most_cells = 16'000'000) : most_cells_(most_cells) {}

    /// Path planners of `scene`; null for an open field (null), which needs none.
    std::shared_ptr<Planners> of(const std::shared_ptr<const Scene>& scene);

  private:
    struct Kept {
        std::shared_ptr<const Scene> scene;  // cached scene; outlives its planners
        std::shared_ptr<Planners> planners;
    };
    std::size_t most_cells_;
    std::deque<Kept> kept_;  // last used scene first
};

}  // namespace rovernet
