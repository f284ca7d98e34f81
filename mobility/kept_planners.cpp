// SPDX-License-Identifier: MIT
#include "mobility/kept_planners.hpp"

#include <algorithm>

namespace rovernet {
namespace {

std::size_t cells_of(const Scene& scene) {
    std::size_t cells = 0;
    for (std::size_t i = 0; i < scene.storeys().size(); ++i)
        cells += scene.storey(i).grid().cells.size();
    return cells;
}

}  // namespace

std::shared_ptr<Planners> KeptPlanners::of(const std::shared_ptr<const Scene>& scene) {
    if (!scene) return nullptr;
    const auto found = std::find_if(kept_.begin(), kept_.end(),
                                    [&](const Kept& each) { return each.scene == scene; });
    if (found != kept_.end()) {
        std::rotate(kept_.begin(), found, found + 1);
        return kept_.front().planners;
    }
    kept_.push_front({scene, std::make_shared<Planners>(*scene)});
    std::size_t cells = cells_of(*scene);
    const auto too_many = std::find_if(kept_.begin() + 1, kept_.end(), [&](const Kept& each) {
        return (cells += cells_of(*each.scene)) > most_cells_;
    });
    kept_.erase(too_many, kept_.end());
    return kept_.front().planners;
}

}  // namespace rovernet
