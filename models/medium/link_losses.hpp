// SPDX-License-Identifier: MIT
#pragma once

#include "models/medium/medium_settings.hpp"
#include "models/medium/recent_losses.hpp"
#include "models/medium/stations.hpp"
#include "models/propagation/propagation_model.hpp"
#include "models/variation/fades.hpp"
#include "sim/geometry.hpp"
#include "sim/ids.hpp"
#include "sim/legs.hpp"
#include "sim/random.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"

#include <cstdint>
#include <memory>

namespace rovernet {

/// Losses, levels and margins of single links of a medium. Functions that take two nodes and a time
/// return the local mean: with shadowing, without fading. Functions that take a frame include the
/// fading of the frame.
///
/// A link is up if and only if its path loss is within link_budget.
class LinkLosses {
  public:
    /// @param settings, stations  parts of the medium; must outlive the LinkLosses
    /// @throws std::invalid_argument if a fading parameter is out of its range
    LinkLosses(const MediumSettings& settings, const Stations& stations,
               std::shared_ptr<const Fades> fades)
        : settings_(settings), stations_(stations), fades_(std::move(fades)) {}

    /// Exact path loss [dB] from `from` to `to` at `t`: the local mean, without fading.
    Db path_loss(NodeId from, NodeId to, Time t, const Legs& legs) const;
    /// Received power [dBm] at `to` of a signal that `from` transmits at `t`.
    Dbm level(NodeId from, NodeId to, Time t, const Legs& legs) const;
    /// Link margin at `t`: path loss [dB] that could be added before the link goes down; negative
    /// if the link is down.
    Db margin(NodeId from, NodeId to, Time t, const Legs& legs) const;
    /// Whether `to` can hear `from` at `t`: both are on, may have a link, and the path loss is
    /// within the budget. A link is down at any level if a radio is off, or if the gates of the
    /// radios forbid the link.
    bool is_up(NodeId from, NodeId to, Time t, const Legs& legs) const;
    /// Shape of the link's loss as a function of positions, while both nodes stay on their legs.
    LossShape shape(NodeId from, NodeId to, Time t, const Legs& legs) const;
    /// Whether the link margin may change while both nodes continue on their legs from `t`: one
    /// moves, or one turns and an antenna is directional.
    bool may_change(NodeId from, NodeId to, Time t, const Legs& legs) const;

    /// Key for random draws about the frame that `from` starts to transmit at `t`
    /// (LinkBatch::frame). A node starts at most one frame at a time.
    std::uint64_t frame_key(NodeId from, Time t) const {
        return combine(stations_.key(from), static_cast<std::uint64_t>((t - start_of_run).count()));
    }
    /// Links of a transmitter, as the input of a propagation model; receivers are added later.
    /// @param frame  key of the frame, for its fading; 0: local mean
    LinkBatch batch(NodeId from, Vec3 origin, Time t, std::uint64_t frame) const;
    /// Path loss [dB] from `from` at `here` to `to` at `there`, with the fading of the frame; a
    /// value above `cutoff` is only a lower bound.
    double of_frame(NodeId from, NodeId to, Vec3 here, Vec3 there, Time t, std::uint64_t frame,
                    Db cutoff) const;
    /// Path loss [dB] by the propagation model: the local mean, without fading; a value above
    /// `cutoff` is only a lower bound.
    double mean(NodeId from, NodeId to, Vec3 here, Vec3 there, Time t, std::uint64_t frame,
                Db cutoff) const;
    /// Path loss [dB] of a frame: local mean `loss_db` of the link plus the frame's fading; equal
    /// to `loss_db` if frames do not fade.
    double faded(double loss_db, NodeId from, NodeId to, Vec3 here, Vec3 there,
                 std::uint64_t frame) const;
    /// Whether frames fade.
    bool fades() const { return fades_ != nullptr; }
    /// Largest gain by fading [dB]; 0 if frames do not fade.
    Db most_fade() const { return fades_ ? fades_->most() : Db{0}; }

    /// Whether losses of a model of this shape are stored in RecentLosses, for judging frames. A
    /// loss that depends on distance alone is not stored, because computing it takes no longer than
    /// a look-up.
    bool keeps(LossShape shape) const {
        return settings_.interference_cut && settings_.keep_losses && !settings_.all_pairs &&
               (shape == LossShape::by_walls || shape == LossShape::unknown);
    }
    /// Stores the computed loss [dB] of a link in RecentLosses; a value above `cutoff` is only a
    /// lower bound.
    void keep(const RecentLosses::Link& link, Db cutoff, double loss_db) {
        recent_.keep(link, cutoff, loss_db);
    }

  private:
    const MediumSettings& settings_;
    const Stations& stations_;
    // Fading of frames; null: frames do not fade.
    std::shared_ptr<const Fades> fades_;
    // Losses of the last searches, if the reception model has interference.
    RecentLosses recent_;
};

}  // namespace rovernet
