// SPDX-License-Identifier: MIT
#pragma once

#include "models/arrival.hpp"
#include "models/phy/phy.hpp"
#include "sim/fields.hpp"
#include "sim/record.hpp"
#include "sim/units.hpp"

#include <concepts>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

// Interface of reception models: the fate of a frame at a receiver in range. A model consists of
// settings with a name and make_judge(), and of a Judge that serves all nodes.
// test/extend/added/models/reception/preamble.hpp is a small one.
//
//     begins(frame)              when a frame starts
//     judge(frame, others, r)    when it ends at a receiver that could decode it
//     is_forgotten(frame)        when it cannot affect other frames any more

namespace rovernet {

class Interference;

/// Frame that starts now, as passed to Judge::begins(). `transmission` and `receptions` are valid
/// during that call only. A judge that needs their data later copies them, into a table indexed by
/// Emission::flight.
struct SentFrame {
    /// Frame, stored while it can affect others.
    const Emission& emission;
    /// Physical layer of the network; outlives the judge.
    const Phy& phy;
    /// How it is transmitted: rate, coding, preamble.
    const Transmission& transmission;
    /// Receptions at the nodes that can decode it, in order.
    std::span<const Reception> receptions;
};

/// Other frames that may be on air at a receiver; Interference::arrival determines whether they
/// are.
using Frames = std::span<const Emission* const>;

/// Judge of a reception model: determines the fate of frames at their receivers. One object for all
/// nodes of a Network.
class Judge {
  public:
    /// Destructor; Interference owns the judge.
    virtual ~Judge() = default;

    /// Whether the fate of a frame may depend on frames that ended before it began; these are then
    /// passed to judge(), too.
    virtual bool looks_back() const = 0;
    /// Determines the fate of a reception that ends now, at a node that is on; sets reception.fate,
    /// but leaves it unchanged if the frame is received. A judge that models locking also sets
    /// reception.locked. The receptions of a frame are judged in the order of their ends.
    /// @param frame   frame being received
    /// @param others  frames that may have been on air there, in any order
    virtual void judge(Interference& air, const Emission& frame, Frames others,
                       Reception& reception) = 0;

    /// Called when a frame starts; frames are in the order of their starts.
    virtual void begins(const SentFrame& /*frame*/) {}
    /// Called when a frame cannot affect other frames any more.
    virtual void is_forgotten(const Emission& /*frame*/) {}
    /// Cut-off of interference [dB]: frames weaker than the sensitivity by more than this are
    /// neglected; empty: only frames that can be decoded or sensed have an effect.
    virtual std::optional<Db> interference_cut() const { return std::nullopt; }
    /// Largest number of simultaneous frames on air so far; only counted if there is a cut-off of
    /// interference.
    virtual std::size_t most_on_air() const { return 0; }
    /// Checks a bit rate of a robot or of the access model, at setup.
    /// @throws std::invalid_argument if frames at this rate cannot be judged
    virtual void check(const Phy& /*phy*/, BitRate /*rate*/) const {}
};

/// Settings of a reception model: its name, and a function that creates its judge.
template <class T>
concept MakesJudge = std::copyable<T> && requires(const T& settings) {
    { T::name } -> std::convertible_to<std::string_view>;
    { settings.make_judge() } -> std::same_as<std::unique_ptr<Judge>>;
};

/// Settings of any reception model, stored by value. NetworkSettings::reception is one:
///
///   Network network({.reception = Collision{.capture_ratio = 6_dB}});
class ReceptionModel {
  public:
    template <class T>
    requires(!std::same_as<T, ReceptionModel> && MakesJudge<T>) ReceptionModel(T settings)
        : name_(T::name),
          make_([settings = std::move(settings)] { return settings.make_judge(); }) {}

    /// Name of the model in scenario files.
    std::string_view name() const { return name_; }

    /// Creates the judge for one Network; null: a frame is received if it is within the link
    /// budget.
    std::unique_ptr<Judge> make_judge() const { return make_(); }
    /// Cut-off of interference of the model's judge [dB], see Judge::interference_cut.
    std::optional<Db> interference_cut() const {
        const auto judge = make_judge();
        return judge ? judge->interference_cut() : std::nullopt;
    }

  private:
    std::string_view name_;
    // Function that creates the judge.
    std::function<std::unique_ptr<Judge>()> make_;
};

/// Reception model "threshold": a frame is received if it is within the link budget. Frames do not
/// interfere, and a node can receive while it transmits. The default.
struct Threshold {
    static constexpr std::string_view name = "threshold";

    static constexpr auto fields() { return describe(); }

    /// Returns null, because no judge is needed.
    std::unique_ptr<Judge> make_judge() const { return nullptr; }
};

}  // namespace rovernet
