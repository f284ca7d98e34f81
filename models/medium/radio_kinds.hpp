// SPDX-License-Identifier: MIT
#pragma once

#include "models/link_gain.hpp"
#include "models/medium/link_range.hpp"
#include "models/medium/loss_bounds.hpp"
#include "models/medium/membership.hpp"
#include "models/medium/strength.hpp"
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

/// Kinds of stations: those of a kind are alike in all that decides a link, their model included.
/// What a pair of kinds needs (ranges, tables) is computed when it is first asked for, once for all
/// robots of these kinds.
class RadioKinds {
  public:
    using Kind = std::uint32_t;

    /// @param interference_cut  see MediumSettings
    /// @param most_fade         gain of the luckiest fade; none: frames do not fade
    explicit RadioKinds(std::optional<Db> interference_cut, std::optional<Db> most_fade = {})
        : interference_cut_(interference_cut),
          most_fade_(most_fade.value_or(Db{0})),
          varies_(most_fade.has_value()) {}

    /// Counts one station. @return its kind
    Kind add(const Radio& radio, const Propagation& model);

    /// Number of kinds.
    std::size_t size() const { return kinds_.size(); }
    /// Number of stations of a kind.
    std::size_t stations(Kind kind) const { return kinds_[kind].stations; }
    /// Radio of a kind, without labels and addresses.
    const Radio& radio(Kind kind) const { return kinds_[kind].radio; }
    /// Model of what its stations send.
    const Propagation& model(Kind kind) const { return models_[kinds_[kind].model]; }
    /// Noise floor of its receivers [dBm].
    Dbm noise(Kind kind) const { return kinds_[kind].noise; }
    /// Height of its antennas above the robot's z [m].
    double height(Kind kind) const { return heights_[kind]; }

    /// Whether the gates of both let them have a link.
    bool may_link(Kind a, Kind b) const {
        return !gated_ || Membership::match(kinds_[a].membership, kinds_[b].membership);
    }

    /// Largest path loss [dB] at which a signal is strong enough.
    Db budget(Strength strength, const Radio& from, const Radio& to, LinkGain gain) const;
    /// Largest path loss [dB] at which a signal is strong enough, between antennas in whatever
    /// poses.
    Db budget(Strength strength, const Radio& from, const Radio& to) const {
        return budget(strength, from, to, LinkGain::most(from, to));
    }
    /// Weakest signal [dBm] that interferes at `to`; there must be a cut.
    Dbm weakest_interfering(const Radio& to) const;
    /// Ratio by which `frames` that the cut left out may raise a receiver's noise; there must be a
    /// cut.
    Db left_out(std::size_t frames) const;
    /// Sets the height [m] that no antenna of any station exceeds or has exceeded; it must not
    /// decrease.
    void set_highest(Meters z) {
        if (z == highest_) return;
        highest_ = z;
        for (Alike& each : kinds_) each.reach2 = {};
    }
    /// Height [m] that was set last.
    Meters highest() const { return highest_; }
    /// Whether the bound of some model's range takes the heights of the antennas.
    bool heights_matter() const { return heights_matter_; }
    /// Whether some antenna is directional.
    bool is_directional() const { return directional_; }
    /// Squared distance [m^2] beyond which a signal is strong enough for nobody; may be infinite.
    double squared_reach(Kind from, Strength strength);

    /// Way in which it is decided who is reached by stations of a kind.
    Decision decision(Kind from) const {
        // A table costs time and memory: it pays where many radios are alike.
        constexpr std::size_t most_tables = 16;
        const Decision cheapest = kinds_[from].cheapest;
        const bool pays = cheapest != Decision::by_table || kinds_.size() <= most_tables;
        return pays && !varies_ ? cheapest : Decision::by_loss;
    }
    /// Squared range [m^2] for Decision::by_range: in range is who is no farther; negative if
    /// nobody is.
    double squared_range(Kind from, Kind to, Strength strength) {
        const double range2 = kinds_[from].range2[to][strength];
        return std::isnan(range2) ? compute_range(from, to, strength) : range2;
    }
    /// Bounds of the path loss for Decision::by_range, over a squared distance [m^2] at which a
    /// signal may be heard.
    LossBounds::Bounds loss_bounds(Kind from, double squared_distance) {
        Alike& mine = kinds_[from];
        return mine.loss_bounds.at(squared_distance, [&](double d) {
            return loss_at(models_[mine.model], mine.radio.frequency, d);
        });
    }
    /// Table of draws in range, for Decision::by_table.
    const ShadowedRange& table(Kind from, Kind to, Strength strength) {
        auto& table = kinds_[from].tables[to][static_cast<std::size_t>(strength)];
        if (!table) [[unlikely]]
            table = make_table(from, to, strength);
        return *table;
    }
    /// First look at whom a sender may reach, for Decision::by_table.
    const FirstLook& first_look(Kind from, Strength strength) {
        auto& look = kinds_[from].looks[static_cast<std::size_t>(strength)];
        if (!look) [[unlikely]]
            look = make_look(from, strength);
        return *look;
    }
    /// Makes room for what is asked about `from`: to be called before squared_range(), table() and
    /// first_look().
    void prepare(Kind from) {
        if (kinds_[from].prepared_for != kinds_.size()) [[unlikely]]
            make_room(from);
    }

  private:
    static constexpr std::array strengths = {Strength::decodable, Strength::detectable,
                                             Strength::interfering};
    static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    // Squared distances [m^2] by Strength; not a number: not computed yet.
    struct SquaredDistances {
        std::array<double, strengths.size()> of = {unknown, unknown, unknown};
        double& operator[](Strength s) { return of[static_cast<std::size_t>(s)]; }
    };
    // Tables of draws in range, by Strength; none: not made yet.
    using Tables = std::array<std::optional<ShadowedRange>, strengths.size()>;
    // Kind of stations, and what was computed for it.
    struct Alike {
        Radio radio;
        Membership membership;
        /// Index into models_.
        std::uint32_t model;
        Decision cheapest;
        Dbm noise;
        std::size_t stations = 1;
        /// Number of kinds that the lists below have room for.
        std::size_t prepared_for = 0;
        SquaredDistances reach2 = {};
        LossBounds loss_bounds = {};
        /// Ranges and tables to each kind.
        std::vector<SquaredDistances> range2 = {};
        std::vector<Tables> tables = {};
        /// First looks by Strength.
        std::vector<std::optional<FirstLook>> looks = {};
    };

    // Numbers of a radio's network, new ones if it is new.
    Membership membership(const Radio& radio);
    // Makes room in the lists of a kind for all kinds.
    void make_room(Kind from);
    // Computes what squared_range(), table() and first_look() are asked for the first time.
    double compute_range(Kind from, Kind to, Strength strength);
    ShadowedRange make_table(Kind from, Kind to, Strength strength) const;
    FirstLook make_look(Kind from, Strength strength);

    // Cut of interference [dB], if the reception model has one.
    std::optional<Db> interference_cut_;
    // Kinds, and models that differ.
    std::vector<Alike> kinds_;
    // Heights of the kinds' antennas [m].
    std::vector<double> heights_;
    std::vector<Propagation> models_;
    // Networks so far, by the numbers that Membership has.
    std::vector<std::string> essids_ = {"any"};
    std::vector<std::pair<int, Hertz>> channels_;
    // Gain of the luckiest fade [dB].
    Db most_fade_;
    // A link varies with the frame or with headings, so that losses alone do not decide.
    bool varies_;
    bool directional_ = false;
    // Some two kinds may have no link.
    bool gated_ = false;
    bool heights_matter_ = false;
    Meters highest_{-std::numeric_limits<double>::infinity()};
    // Largest budget that any kind allows a sender of 0 dBm, by Strength.
    std::array<Db, strengths.size()> best_budget_ = {Db{-1e300}, Db{-1e300}, Db{-1e300}};
};

}  // namespace rovernet
