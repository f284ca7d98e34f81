// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/planners.hpp"
#include "scene/scene.hpp"

#include <cstddef>
#include <deque>
#include <memory>

namespace rovernet {

/// Planners of the scenes that were used last: a worker that makes many runs keeps them from run to
/// run.
///
/// A scene never changes, so its address tells which one it is: it is kept alive as long as its
/// planners are.
class KeptPlanners {
  public:
    /// @param most_cells  of the scenes that are kept, all together: each takes some 30 bytes. The
    ///                    scene asked for last is kept anyhow
    explicit KeptPlanners(std::size_t most_cells = 16'000'000) : most_cells_(most_cells) {}

    /// The planners of `scene`; none for an open field (null), which needs none.
    std::shared_ptr<Planners> of(const std::shared_ptr<const Scene>& scene);

  private:
    struct Kept {
        std::shared_ptr<const Scene> scene;  // outlives its planners
        std::shared_ptr<Planners> planners;
    };
    std::size_t most_cells_;
    std::deque<Kept> kept_;  // the one that was asked for last comes first
};

}  // namespace rovernet
