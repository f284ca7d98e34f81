// SPDX-License-Identifier: MIT
#pragma once

#include "sim/geometry.hpp"
#include "sim/ids.hpp"
#include "sim/units.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

namespace rovernet {

class Scene;

/// Losses that were computed last, one for each pair of a sender and a receiver: who judges a frame
/// when it has ended needs the losses with which its receivers were found when it began.
///
/// It holds 1024 pairs; of two that share a slot the later one. A loss is found again for the same
/// places to the last bit in the same scene, so that it is what the model would answer.
class RecentLosses {
  public:
    /// Link from one antenna to another.
    struct Link {
        NodeId from, to;
        Vec3 here, there;              ///< antennas [m]
        const Scene* scene = nullptr;  ///< scene between them
        friend bool operator==(const Link&, const Link&) = default;
    };

    /// Takes note of a loss [dB]; above `give_up` it says no more than that.
    void keep(const Link& link, Db give_up, double loss_db) {
        if (!slots_) slots_ = std::make_unique<Slots>();
        (*slots_)[slot(link)] = {link, give_up.value, loss_db};
    }
    /// Loss [dB] of the link, if it is known; above `give_up` it says no more than that.
    std::optional<double> find(const Link& link, Db give_up) const {
        if (!slots_) return std::nullopt;
        const Known& known = (*slots_)[slot(link)];
        const bool tells = known.loss_db <= known.give_up || give_up.value <= known.give_up;
        return tells && known.link == link ? std::optional(known.loss_db) : std::nullopt;
    }

  private:
    static constexpr std::size_t size = 1024;
    struct Known {
        Link link{};
        double give_up = 0, loss_db = 0;  // [dB]
    };
    using Slots = std::array<Known, size>;
    static std::size_t slot(const Link& link) {
        return (std::size_t{link.from.index()} * 31 + link.to.index()) % size;
    }
    std::unique_ptr<Slots> slots_;
};

}  // namespace rovernet
