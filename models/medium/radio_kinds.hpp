// SPDX-License-Identifier: MIT
#pragma once

#include "models/link_gain.hpp"
#include "models/medium/link_range.hpp"
#include "models/medium/loss_bounds.hpp"
#include "models/medium/membership.hpp"
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

/// What a signal is strong enough for, strongest first.
enum class Strength { decodable, detectable, disturbing };

/// How it is decided for whom a signal is strong enough: the cheapest way that its model allows.
enum class Decision {
    by_range,  ///< by the distance alone
    by_table,  ///< by the distance and a draw of the pair
    by_loss,   ///< by asking the model
};

/// The kinds of stations: those of a kind are alike in all that decides a link, their model
/// included. What a pair of kinds needs is computed when it is first asked for.
class RadioKinds {
  public:
    using Kind = std::uint32_t;

    /// @param interference_cut  see Medium::Settings
    explicit RadioKinds(std::optional<Db> interference_cut) : interference_cut_(interference_cut) {}

    /// Counts one station; @return its kind.
    Kind add(const Radio& radio, const Propagation& model);

    std::size_t size() const { return kinds_.size(); }
    std::size_t stations(Kind kind) const { return kinds_[kind].stations; }
    /// Without labels and addresses.
    const Radio& radio(Kind kind) const { return kinds_[kind].radio; }
    const Propagation& model(Kind kind) const { return models_[kinds_[kind].model]; }
    Dbm noise(Kind kind) const { return kinds_[kind].noise; }
    double height(Kind kind) const { return heights_[kind]; }  ///< [m] of the antenna

    bool may_link(Kind a, Kind b) const {
        return !gated_ || Membership::match(kinds_[a].membership, kinds_[b].membership);
    }

    /// The largest path loss [dB] at which a signal is strong enough.
    Db budget(Strength strength, const Radio& from, const Radio& to, LinkGain gain) const;
    /// The same between antennas in whatever poses, at most.
    Db budget(Strength strength, const Radio& from, const Radio& to) const {
        return budget(strength, from, to, LinkGain::most(from, to));
    }
    /// The weakest signal [dBm] that disturbs `to`; there must be a cut.
    Dbm weakest_disturbing(const Radio& to) const;
    /// No antenna of any station has been or is higher [m] than this; must not decrease.
    void set_highest(Meters z) {
        if (z == highest_) return;
        highest_ = z;
        for (Alike& each : kinds_) each.reach2 = {};
    }
    Meters highest() const { return highest_; }
    /// The bound of some model's range takes the heights of the antennas.
    bool heights_matter() const { return heights_matter_; }
    /// [m^2] A signal is strong enough for nobody farther away; may be infinite.
    double squared_reach(Kind from, Strength strength);

    Decision decision(Kind from) const {
        // A table costs time and memory: it pays where many radios are alike.
        constexpr std::size_t most_tables = 16;
        const Decision cheapest = kinds_[from].cheapest;
        const bool pays = cheapest != Decision::by_table || kinds_.size() <= most_tables;
        return pays ? cheapest : Decision::by_loss;
    }
    /// Decides by_range: in range is who is no farther than that [m^2]; negative if nobody is.
    double squared_range(Kind from, Kind to, Strength strength) {
        const double range2 = kinds_[from].range2[to][strength];
        return std::isnan(range2) ? compute_range(from, to, strength) : range2;
    }
    /// Decides by_range: bounds of the path loss over a squared distance [m^2] at which a signal
    /// may be heard.
    LossBounds::Bounds loss_bounds(Kind from, double squared_distance) {
        Alike& mine = kinds_[from];
        return mine.loss_bounds.at(squared_distance, [&](double d) {
            return loss_at(models_[mine.model], mine.radio.frequency, d);
        });
    }
    /// Decides by_table.
    const ShadowedRange& table(Kind from, Kind to, Strength strength) {
        auto& table = kinds_[from].tables[to][static_cast<std::size_t>(strength)];
        if (!table) [[unlikely]]
            table = make_table(from, to, strength);
        return *table;
    }
    /// Decides by_table whom a sender may reach.
    const FirstLook& first_look(Kind from, Strength strength) {
        auto& look = kinds_[from].looks[static_cast<std::size_t>(strength)];
        if (!look) [[unlikely]]
            look = make_look(from, strength);
        return *look;
    }
    /// To be called before squared_range(), table() and first_look() are asked about `from`.
    void prepare(Kind from) {
        if (kinds_[from].prepared_for != kinds_.size()) [[unlikely]]
            make_room(from);
    }

  private:
    static constexpr std::array strengths = {Strength::decodable, Strength::detectable,
                                             Strength::disturbing};
    static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    /// [m^2], by Strength.
    struct SquaredDistances {
        std::array<double, strengths.size()> of = {unknown, unknown, unknown};
        double& operator[](Strength s) { return of[static_cast<std::size_t>(s)]; }
    };
    using Tables = std::array<std::optional<ShadowedRange>, strengths.size()>;
    struct Alike {
        Radio radio;
        Membership membership;
        std::uint32_t model;  // index into models_
        Decision cheapest;
        Dbm noise;
        std::size_t stations = 1;
        std::size_t prepared_for = 0;  // so many kinds
        SquaredDistances reach2 = {};
        LossBounds loss_bounds = {};
        std::vector<SquaredDistances> range2 = {};         // to each kind
        std::vector<Tables> tables = {};                   // to each kind
        std::vector<std::optional<FirstLook>> looks = {};  // by Strength
    };

    Membership membership(const Radio& radio);
    void make_room(Kind from);
    double compute_range(Kind from, Kind to, Strength strength);
    ShadowedRange make_table(Kind from, Kind to, Strength strength) const;
    FirstLook make_look(Kind from, Strength strength);

    std::optional<Db> interference_cut_;
    std::vector<Alike> kinds_;
    std::vector<double> heights_;  // [m] of their antennas
    std::vector<Propagation> models_;
    std::vector<std::string> essids_ = {"any"};
    std::vector<std::pair<int, Hertz>> channels_;
    bool gated_ = false;  // some two kinds may have no link
    bool heights_matter_ = false;
    Meters highest_{-std::numeric_limits<double>::infinity()};
    // By Strength: the largest budget that any kind allows a sender of 0 dBm.
    std::array<Db, strengths.size()> best_budget_ = {Db{-1e300}, Db{-1e300}, Db{-1e300}};
};

}  // namespace rovernet
