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

// Links with known loss, for fitting and judging models.

namespace rovernet {

/// Link whose path loss is known, by a measurement or by a reference model.
struct KnownLink {
    std::string name;        ///< name of the link for reports: end points and time, or file line
    std::string place = {};  ///< label of the antennas' positions, equal for levels measured at
                             ///< equal positions; empty if the loss is not measured
    Vec3 from, to;           ///< positions of the antennas [m]
    Hertz frequency;
    /// Keys of the two end points, and replication number, for propagation models with random
    /// draws.
    std::uint64_t from_key = 0, to_key = 0;
    std::uint32_t replication = 0;
    /// Number of the link's group. The links of a group have dependent errors: links of one
    /// replication, or of one receiver.
    std::uint32_t group = 0;
    /// Path loss [dB]; for an unseen link (nothing received) the lower bound of the path loss.
    double loss = 0;
    bool unseen = false;  ///< true: nothing was received, so that the path loss is above `loss`
    /// Link budget [dB]: largest path loss at which the link is up.
    double budget = 0;

    double distance() const { return rovernet::distance(from, to); }
    bool up() const { return !unseen && loss <= budget; }
};

/// Links of known loss in a scenario, with the data that propagation models need.
struct KnownLinks {
    std::vector<KnownLink> links;
    std::size_t groups = 0;
    /// Property that the links of a group have in common, as a word for reports: "replication",
    /// "sender", "receiver", or "group" (a column of the file of measurements).
    const char* group_name = "replication";
    /// True if levels were measured, so that real powers and gains may differ from the scenario.
    bool measured = false;
    /// True if receiver positions are known; false: KnownLink::to is meaningless.
    bool knows_receivers = true;
    /// Scene (walls) that contains the links.
    std::shared_ptr<const Scene> scene;
    Meters floor_height;
    std::uint64_t seed = 0;
    /// Path loss of a link by a propagation model [dB].
    double loss_by(const Propagation& model, const KnownLink& link) const;
};

/// Smallest replication number that samples of links use. Studies use smaller numbers.
inline constexpr std::uint32_t first_sampled_replication = 1'000'000;

/// Size of a sample of links.
struct SampleSize {
    std::uint32_t replications = 20;
    std::uint32_t times = 20;  ///< number of sampling times in each replication
    std::size_t links = 5000;  ///< largest number of links in the sample
    std::uint32_t first_replication = first_sampled_replication;
};

/// Sample of links between a scenario's robots, with losses by a reference model. Links are sampled
/// at random times of some replications; by default no study uses the numbers of these
/// replications. The sample has all pairs of robots that are switched on and within the reference's
/// range for a link budget raised by 20 dB. Pairs are selected by distance only, since a selection
/// by loss would bias every fit. If the links are too many, every k-th link is taken.
///
/// If robots react to messages, the scenario is run with its traffic, but with the faster model
/// multi_wall instead of rays: only the robots' positions depend on these runs.
///
/// Groups of links (see KnownLink::group) are replications, or senders if all replications are
/// equal.
/// @param tell  called with the finished share, 0 ... 1, of the runs, then of the computed losses;
///              may be empty
/// @throws InputError, RunError as a run; InputError if no two robots are within range
KnownLinks sample_links(const Scenario& scenario, const Propagation& reference,
                        const SampleSize& size, const std::function<void(double)>& tell = {});

/// Sample of links of known loss that can grow. The sample for a number of replications equals the
/// result of sample_links(), but is computed from the sample for a smaller number. The reference
/// model is evaluated once for each link; without random draws, once for all links with equal end
/// points.
class LinkSample {
  public:
    /// @param size  largest number of links, and number of times in each replication; for
    /// replications see grow()
    LinkSample(const Scenario& scenario, Propagation reference, const SampleSize& size);
    ~LinkSample();
    LinkSample(const LinkSample&) = delete;
    LinkSample& operator=(const LinkSample&) = delete;

    /// Grows the sample to the links of `replications` replications (not fewer than before), and
    /// returns all links, as sample_links() does.
    KnownLinks grow(std::uint32_t replications, const std::function<void(double)>& tell = {});

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Requirement on receiver positions in a file of measured levels: known positions only, or also
/// unknown positions.
enum class Receivers { known, may_be_unknown };

/// Measured levels as links of a scenario. The file has comma-separated values. Its first line
/// names the columns; lines that begin with # are comments.
///
///   from_x_m, from_y_m, to_x_m, to_y_m   antennas [m]; from_z_m, to_z_m: 0 if not given
///   level_dbm                            received level [dBm]; empty: below `floor`
///   group                                any word: name of the group, see KnownLink::group; if
///                                        not given, the receiver's position
///   place                                any word, equal for repeated measurements at the same
///                                        positions; if not given, both antennas' positions
///
/// Loss = power of the scenario's [radio] + gains - level.
/// @param floor      level [dBm] below which nothing was received
/// @param receivers  may_be_unknown: a file may have `place` instead of receiver positions
/// @throws InputError with line and column if the file is invalid
KnownLinks read_levels(const std::string& path, const Scenario& scenario, std::optional<Dbm> floor,
                       Receivers receivers = Receivers::known);

/// Repeatability of measured levels: statistics of differences between levels measured repeatedly
/// at the same positions.
struct Repeatability {
    std::size_t levels = 0;  ///< number of repeated levels, without the first level at each
                             ///< position
    double rms = 0;  ///< root mean square difference to the first level at the position [dB]

    /// Standard deviation of the error of one level [dB]: rms / sqrt(2), since the difference of
    /// two levels with independent errors is sqrt(2) times as large. Even an exact model has this
    /// error.
    double one_level() const { return rms / std::numbers::sqrt2; }
};
/// Repeatability of measured levels over two sets together. A level counts if either set has an
/// earlier level with equal KnownLink::place.
Repeatability repeatability(const KnownLinks& first, const KnownLinks& second);

}  // namespace rovernet
