// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/propagation.hpp"
#include "scenario/scenario.hpp"
#include "sim/geometry.hpp"
#include "sim/units.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

// Links whose loss is known: what models are fitted to, and judged by.

namespace rovernet {

/// Link whose loss is known.
struct KnownLink {
    std::string name;        ///< for people: its ends, and when
    std::string place = {};  ///< equal for levels measured at one place; empty: not measured
    Vec3 from, to;           ///< antennas [m]
    Hertz frequency;
    /// Keys of its ends and the replication, for models that draw.
    std::uint64_t from_key = 0, to_key = 0;
    std::uint32_t replication = 0;
    /// Links of one group share what is random: robots of a replication, a measured receiver.
    std::uint32_t group = 0;
    /// Path loss [dB]; of an unseen link its lower bound.
    double loss = 0;
    bool unseen = false;  ///< nothing was received: the loss is above that bound
    /// Link budget [dB]: the link is up if its loss is no more.
    double budget = 0;

    double distance() const { return rovernet::distance(from, to); }
    bool up() const { return !unseen && loss <= budget; }
};

/// Known links of one scenario.
struct KnownLinks {
    std::vector<KnownLink> links;
    std::size_t groups = 0;
    const char* group_name = "replication";  ///< what a group is
    /// Levels were measured: powers and gains may be others than the scenario says.
    bool measured = false;
    /// Places of receivers are given; false: `to` is nowhere.
    bool knows_receivers = true;
    /// Scene that they lie in.
    std::shared_ptr<const Scene> scene;
    Meters floor_height;
    std::uint64_t seed = 0;
    /// Loss of a link by a model [dB].
    double loss_by(const Propagation& model, const KnownLink& link) const;
};

/// Replications from this one on are sampled; those that studies compare are below.
inline constexpr std::uint32_t first_sampled_replication = 1'000'000;

/// Size of a sample.
struct SampleSize {
    std::uint32_t replications = 20;
    std::uint32_t times = 20;  ///< in each replication
    std::size_t links = 5000;  ///< at most
    std::uint32_t first_replication = first_sampled_replication;
};

/// Links of a scenario's own robots, with their losses by a reference model: at random times of
/// replications that (by default) no study compares, all pairs of robots that are on and no farther
/// apart than the reference reaches with a budget of 20 dB more. They are chosen by distance alone:
/// chosen by their loss, they would bias every fit. Of too many every k-th is taken.
///
/// If robots react to messages, the scenario is run with its messages, but with multi_wall in place
/// of rays: only where robots drive depends on these runs.
///
/// Groups are replications; senders if all replications are alike.
/// @param tell  told the share that is done, 0 ... 1: first of the runs, then of the losses; may be
///              empty
/// @throws InputError, RunError as a run; InputError if there are no two robots within reach
KnownLinks sample_links(const Scenario& scenario, const Propagation& reference,
                        const SampleSize& size, const std::function<void(double)>& tell = {});

/// Sample of links that grows: each size has the links and losses of sample_links(), but what was
/// sampled for a smaller size is kept. The reference is asked once for each link; once for links of
/// all times and replications with equal ends if it draws nothing.
class LinkSample {
  public:
    /// @param size  at most so many links, of so many times a replication; see grow()
    LinkSample(const Scenario& scenario, Propagation reference, const SampleSize& size);
    ~LinkSample();
    LinkSample(const LinkSample&) = delete;
    LinkSample& operator=(const LinkSample&) = delete;

    /// Links of so many replications, no fewer than before; else as sample_links().
    KnownLinks grow(std::uint32_t replications, const std::function<void(double)>& tell = {});

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// What a file of levels says of its receivers.
enum class Receivers { known, may_be_unknown };

/// Measured levels as links of a scenario: a file of comma-separated values whose first line names
/// the columns; lines that begin with # are comments.
///
///   from_x_m, from_y_m, to_x_m, to_y_m   antennas [m]; from_z_m, to_z_m: 0 if not given
///   level_dbm                            received level [dBm]; empty: below `floor`
///   group                                any word; the receiver's place if not given
///   place                                any word, equal where one place was measured again; both
///                                        antennas' places if not given
///
/// Loss is the power of the scenario's [radio] with its gains, less the level.
/// @param floor      level [dBm] below which nothing was received
/// @param receivers  may_be_unknown: a file may have `place` in their place
/// @throws InputError with line and column for what is no such file
KnownLinks read_levels(const std::string& path, const Scenario& scenario, std::optional<Dbm> floor,
                       Receivers receivers = Receivers::known);

/// How well measurements repeat.
struct Repeatability {
    std::size_t levels = 0;  ///< that were measured again
    double rms = 0;          ///< root mean square difference to the place's first level [dB]

    /// Error of one level [dB], and so that of a model that is right: two levels with independent
    /// errors differ by sqrt(2) times as much.
    double one_level() const { return rms / std::numbers::sqrt2; }
};
/// Repeatability of two sets of measured levels together.
Repeatability repeatability(const KnownLinks& first, const KnownLinks& second);

}  // namespace rovernet
