// SPDX-License-Identifier: MIT
#pragma once

#include "models/medium/medium_settings.hpp"
#include "models/medium/recent_losses.hpp"
#include "models/medium/stations.hpp"
#include "models/propagation/propagation_model.hpp"
#include "models/variation/fading.hpp"
#include "sim/geometry.hpp"
#include "sim/ids.hpp"
#include "sim/legs.hpp"
#include "sim/random.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"

#include <cstdint>
#include <memory>

namespace rovernet {

/// Losses, levels and margins of single links of a medium: of a link at a time, the local mean with
/// shadowing and without fading, and of a frame, which fades.
///
/// A link is up if and only if its path loss is within link_budget.
class LinkLosses {
  public:
    /// @param settings, stations  of the medium; outlive this
    /// @throws std::invalid_argument if its fading has a parameter out of its range
    LinkLosses(const MediumSettings& settings, const Stations& stations,
               std::shared_ptr<const Fades> fades)
        : settings_(settings), stations_(stations), fades_(std::move(fades)) {}

    /// Path loss [dB] from `from` to `to` at `t`, with nothing given up.
    Db path_loss(NodeId from, NodeId to, Time t, const Legs& legs) const;
    /// Received power [dBm] at `to` of what `from` sends at `t`.
    Dbm level(NodeId from, NodeId to, Time t, const Legs& legs) const;
    /// Path loss [dB] that the link could still bear at `t`; negative: it is too weak.
    Db margin(NodeId from, NodeId to, Time t, const Legs& legs) const;
    /// Whether `to` can hear `from` at `t`: both are on, may link, and the budget allows it. A
    /// switched-off or gated link is down whatever its level.
    bool is_up(NodeId from, NodeId to, Time t, const Legs& legs) const;
    /// Shape of the link's margin while both ends go on along their legs as at `t`.
    LossShape shape(NodeId from, NodeId to, Time t, const Legs& legs) const;
    /// Whether the margin may change while they do: one of them moves, or turns and an antenna is
    /// directional.
    bool may_change(NodeId from, NodeId to, Time t, const Legs& legs) const;

    /// Key of the frame that a node sends at `t`, see LinkBatch: there is but one.
    std::uint64_t frame_key(NodeId from, Time t) const {
        return combine(stations_.key(from), static_cast<std::uint64_t>((t - start_of_run).count()));
    }
    /// Links of a transmitter, as a model is asked for them.
    /// @param frame  its key; 0: none
    LinkBatch batch(NodeId from, Vec3 origin, Time t, std::uint64_t frame) const;
    /// Path loss [dB] from `from` here to `to` there, faded as the frame is; above `give_up` it
    /// says no more than that.
    double of_frame(NodeId from, NodeId to, Vec3 here, Vec3 there, Time t, std::uint64_t frame,
                    Db give_up) const;
    /// Path loss [dB] by the model: the local mean; above `give_up` it says no more than that.
    double mean(NodeId from, NodeId to, Vec3 here, Vec3 there, Time t, std::uint64_t frame,
                Db give_up) const;
    /// Loss [dB] that a frame sees where the link's is `loss_db`; that one if frames do not fade.
    double faded(double loss_db, NodeId from, NodeId to, Vec3 here, Vec3 there,
                 std::uint64_t frame) const;
    /// Whether frames fade, and the gain of the luckiest fade [dB].
    bool fades() const { return fades_ != nullptr; }
    Db most_fade() const { return fades_ ? fades_->most() : Db{0}; }

    /// Whether losses of a model of this shape are kept for who judges the frames: one without
    /// walls is computed as fast as it is found again.
    bool keeps(LossShape shape) const {
        return settings_.interference_cut && settings_.keep_losses && !settings_.all_pairs &&
               (shape == LossShape::by_walls || shape == LossShape::unknown);
    }
    /// Keeps a loss [dB] that was computed; above `give_up` it says no more than that.
    void keep(const RecentLosses::Link& link, Db give_up, double loss_db) {
        recent_.keep(link, give_up, loss_db);
    }

  private:
    const MediumSettings& settings_;
    const Stations& stations_;
    // Fades of frames; null: they do not fade.
    std::shared_ptr<const Fades> fades_;
    // Losses of the last searches, if frames are judged that interfere.
    RecentLosses recent_;
};

}  // namespace rovernet
