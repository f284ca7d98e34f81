// SPDX-License-Identifier: MIT
#pragma once

#include "models/link_gain.hpp"
#include "models/medium/antenna_heights.hpp"
#include "models/medium/link_range.hpp"
#include "models/medium/loss_bounds.hpp"
#include "models/medium/membership.hpp"
#include "models/medium/strength.hpp"
#include "models/phy/phy.hpp"
#include "models/propagation/propagation.hpp"
#include "models/propagation/shadowed_range.hpp"
#include "models/radio.hpp"
#include "sim/random.hpp"
#include "sim/units.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rovernet {

/// Kinds of stations: stations of one kind have the same propagation model and equal radio
/// parameters, as far as these affect links. Data for a pair of kinds (ranges, tables) is computed
/// when first needed, once for all robots.
class RadioKinds {
  public:
    using Kind = std::uint32_t;

    /// @param phy               physical layer of all frames
    /// @param interference_cut  see MediumSettings
    /// @param most_fade         largest gain by fading; empty: frames do not fade
    explicit RadioKinds(Phy phy, std::optional<Db> interference_cut,
                        std::optional<Db> most_fade = {})
        : phy_(std::move(phy)),
          interference_cut_(interference_cut),
          most_fade_(most_fade.value_or(Db{0})),
          varies_(most_fade.has_value()) {}

    /// Adds a station. @return its kind
    Kind add(const Radio& radio, const Propagation& model);
    /// Whether the sensitivity of receivers depends on the coding of a frame.
    bool depend_on_coding() const { return phy_.has_sensitivities(); }
    /// Kind of a station of the kind `kind` while it transmits frames of this coding.
    Kind of_coding(Kind kind, Coding coding);

    /// Number of kinds.
    std::size_t size() const { return kinds_.size(); }
    /// Number of stations of a kind.
    std::size_t stations(Kind kind) const { return kinds_[kind].stations; }
    /// Radio of the stations of a kind, without labels and addresses.
    const Radio& radio(Kind kind) const { return kinds_[kind].radio; }
    /// Propagation model of the transmissions of a kind's stations.
    const Propagation& model(Kind kind) const { return models_[kinds_[kind].model]; }
    /// Noise floor [dBm] of a kind's receivers.
    Dbm noise(Kind kind) const { return kinds_[kind].noise; }
    /// Height [m] of a kind's antennas above the robot's z.
    double height(Kind kind) const { return heights_[kind]; }

    /// Whether the gates of two kinds of stations allow links between them.
    bool may_link(Kind a, Kind b) const {
        return !gated_ || Membership::match(kinds_[a].membership, kinds_[b].membership);
    }

    /// Largest path loss [dB] at which a signal of `from` is still `strength` at `to`.
    Db budget(Strength strength, Kind from, Kind to, LinkGain gain) const;
    /// Upper bound of budget() [dB] for all poses of the antennas, from their largest gains.
    Db budget(Strength strength, Kind from, Kind to) const;
    /// Weakest signal [dBm] that interferes at `to`; to be called only if there is a cut-off.
    Dbm weakest_interfering(const Radio& to) const;
    /// Upper bound on the ratio [dB] by which `frames` neglected frames raise a receiver's noise.
    /// To be called only if interference has a cut-off.
    Db left_out(std::size_t frames) const;
    /// Sets the heights of all antennas, present and past.
    void set_antennas(const AntennaHeights& heights);
    /// Heights of all antennas, as passed to set_antennas().
    const AntennaHeights& antennas() const { return antennas_; }
    /// Whether the range bound or the shape of any model depends on antenna heights.
    bool heights_matter() const { return heights_matter_; }
    /// Whether any antenna is directional.
    bool is_directional() const { return directional_; }
    /// Upper bound of the squared distance [m^2] to nodes that `from` reaches with this strength.
    double squared_reach(Kind from, Strength strength);

    /// Method by which the receivers of a sender of the kind `from` are determined.
    Decision decision(Kind from) const {
        // A table costs time and memory, which pays off only if many radios are equal.
        constexpr std::size_t most_tables = 16;
        const Decision cheapest = kinds_[from].cheapest;
        const bool pays = cheapest != Decision::by_table || kinds_.size() <= most_tables;
        return pays && !varies_ ? cheapest : Decision::by_loss;
    }
    /// Squared distance [m^2] up to which a signal has this strength at nodes of kind `to`, for
    /// Decision::by_range; negative if the signal is too weak even at 0 m.
    double squared_range(Kind from, Kind to, Strength strength) {
        const double range2 = kinds_[from].range2[to][strength];
        return std::isnan(range2) ? compute_range(from, to, strength) : range2;
    }
    /// Bounds of the path loss at a squared distance [m^2], for Decision::by_range.
    LossBounds::Bounds loss_bounds(Kind from, double squared_distance) {
        return kinds_[from].loss_bounds.at(squared_distance, [&](double d) {
            return loss_at(model(from), radio(from).frequency, d, antennas_.first);
        });
    }
    /// Table from distance and shadowing draw to link decision, for Decision::by_table.
    const ShadowedRange& table(Kind from, Kind to, Strength strength) {
        auto& table = kinds_[from].tables[to][static_cast<std::size_t>(strength)];
        if (!table) [[unlikely]]
            table = make_table(from, to, strength);
        return *table;
    }
    /// Fast first test that excludes most nodes out of range, for Decision::by_table.
    const FirstLook& first_look(Kind from, Strength strength);
    /// Allocates memory for queries about `from`: must be called before squared_range(), table()
    /// and first_look().
    void prepare(Kind from) {
        if (kinds_[from].prepared_for != kinds_.size()) [[unlikely]]
            make_room(from);
    }

  private:
    static constexpr std::array strengths = {Strength::decodable, Strength::detectable,
                                             Strength::interfering};
    static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    // Squared distances [m^2] by Strength; NaN if not computed yet.
    struct SquaredDistances {
        std::array<double, strengths.size()> of = {unknown, unknown, unknown};
        double& operator[](Strength s) { return of[static_cast<std::size_t>(s)]; }
    };
    // Results of table(), by Strength; empty if not made yet.
    using Tables = std::array<std::optional<ShadowedRange>, strengths.size()>;
    // Kind of stations, and the data computed for it.
    struct Alike {
        Radio radio;
        /// Coding of the frames that the kind's stations transmit.
        Coding coding;
        Membership membership;
        /// Index of the kind's propagation model in models_.
        std::uint32_t model;
        Decision cheapest;
        Dbm noise;
        std::size_t stations = 1;
        /// Number of receiver kinds for which the vectors below have space.
        std::size_t prepared_for = 0;
        SquaredDistances reach2 = {};
        LossBounds loss_bounds = {};
        /// Squared ranges [m^2] and tables of draws, by kind of the receiver.
        std::vector<SquaredDistances> range2 = {};
        std::vector<Tables> tables = {};
        /// First tests of possible receivers, by Strength.
        std::vector<std::optional<FirstLook>> looks = {};
    };

    // Fastest method that a model allows between antennas of the present heights.
    Decision cheapest_decision(const Propagation& model, Hertz frequency) const;
    // Result of budget() [dB] if `to` has the given sensitivity.
    Db budget(Strength strength, const Radio& from, const Radio& to, LinkGain gain,
              Dbm sensitivity) const;
    // Sensitivity [dBm] of a radio to the coding that it receives best.
    Dbm best_sensitivity(const Radio& radio) const;
    // Network of a radio, as numbers; a new network gets new numbers.
    Membership membership(const Radio& radio);
    // Extends the lists of `from` to all kinds of receivers.
    void make_room(Kind from);
    // Compute the results of squared_range(), table() and first_look() on first use.
    double compute_range(Kind from, Kind to, Strength strength);
    ShadowedRange make_table(Kind from, Kind to, Strength strength) const;
    FirstLook make_look(Kind from, Strength strength);

    Phy phy_;
    // Cut-off of interference [dB], if the reception model has one.
    std::optional<Db> interference_cut_;
    // Kinds of stations, by number.
    std::vector<Alike> kinds_;
    // Heights of the kinds' antennas [m].
    std::vector<double> heights_;
    std::vector<Propagation> models_;
    // Known networks, by their numbers in Membership.
    std::vector<std::string> essids_ = {"any"};
    std::vector<std::pair<int, Hertz>> channels_;
    // Largest gain by fading [dB].
    Db most_fade_;
    // True if a link varies with the frame (fading) or with headings: ranges do not decide links.
    bool varies_;
    bool directional_ = false;
    // True if the gates forbid links between at least two kinds.
    bool gated_ = false;
    bool heights_matter_ = false;
    AntennaHeights antennas_;
    // Largest path loss [dB] from a sender of 0 dBm to any kind of receiver, by signal Strength.
    std::array<Db, strengths.size()> best_budget_ = {Db{-1e300}, Db{-1e300}, Db{-1e300}};
};

}  // namespace rovernet
