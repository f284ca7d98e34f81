// SPDX-License-Identifier: MIT
#pragma once

#include "sim/geometry.hpp"
#include "sim/ids.hpp"
#include "sim/units.hpp"

#include <array>
#include <cstddef>
#include <memory>
#include <optional>

namespace rovernet {

class Scene;

/// Cache of the last path losses, one for each pair of sender and receiver. The search for
/// receivers stores the losses at the start of a frame. The frame's judge reads them at its end.
///
/// The cache stores up to 1024 pairs. If two pairs share a slot, the later pair is kept. A loss is
/// found only for exactly equal positions in the same scene, so that it equals the model's result.
class RecentLosses {
  public:
    /// Link from one antenna to another, in a scene.
    struct Link {
        NodeId from, to;
        Vec3 here, there;              ///< positions of both antennas [m]
        const Scene* scene = nullptr;  ///< scene with the walls between the antennas
        friend bool operator==(const Link&, const Link&) = default;
    };

    /// Stores the path loss [dB] of a link; a value above `cutoff` is only a lower bound.
    void keep(const Link& link, Db cutoff, double loss_db) {
        if (!slots_) slots_ = std::make_unique<Slots>();
        (*slots_)[slot(link)] = {link, cutoff.value, loss_db};
    }
    /// Path loss [dB] of the link, if it is stored; a value above `cutoff` is only a lower bound.
    std::optional<double> find(const Link& link, Db cutoff) const {
        if (!slots_) return std::nullopt;
        const Known& known = (*slots_)[slot(link)];
        const bool tells = known.loss_db <= known.cutoff || cutoff.value <= known.cutoff;
        return tells && known.link == link ? std::optional(known.loss_db) : std::nullopt;
    }

  private:
    static constexpr std::size_t size = 1024;
    struct Known {
        Link link{};
        double cutoff = 0, loss_db = 0;  // cutoff and path loss [dB]
    };
    using Slots = std::array<Known, size>;
    static std::size_t slot(const Link& link) {
        return (std::size_t{link.from.index()} * 31 + link.to.index()) % size;
    }
    std::unique_ptr<Slots> slots_;
};

}  // namespace rovernet
