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
// settings, which have a name and make_judge(), and of a Judge that serves all nodes. Small
// example: test/extend/added/models/reception/preamble.hpp.
//
//     begins(frame)              when a frame starts
//     judge(frame, others, r)    when a frame ends at a receiver that could decode it
//     is_forgotten(frame)        when a frame can no longer affect other frames

namespace rovernet {

class Interference;

/// Frame that starts now, as passed to Judge::begins(). `transmission` and `receptions` are valid
/// only during Judge::begins(). A judge that needs their data later copies them, into a table
/// indexed by Emission::flight.
struct SentFrame {
    /// Frame as transmitted; the reference is valid while the frame can affect other frames.
    const Emission& emission;
    /// Physical layer of the network; outlives the judge.
    const Phy& phy;
    /// Transmission parameters of the frame: rate, coding, preamble.
    const Transmission& transmission;
    /// Receptions at the nodes that can decode the frame, in order.
    std::span<const Reception> receptions;
};

/// List of the other frames that may be on air at a receiver. Interference::arrival() determines
/// which of these frames have an effect at the receiver.
using Frames = std::span<const Emission* const>;

/// Judge of a reception model: determines the fate of frames at their receivers. One object for all
/// nodes of a Network.
class Judge {
  public:
    /// Virtual destructor, because Interference owns the judge by a pointer to Judge.
    virtual ~Judge() = default;

    /// Whether the fate of a frame may depend on frames that ended before the frame began. If true,
    /// the argument `others` of judge() includes such earlier frames.
    virtual bool looks_back() const = 0;
    /// Number of airtimes of the longest frame over which Interference::earlier() goes back.
    virtual int airtimes_kept() const { return 0; }
    /// Determines the fate of a reception that ends now, at a node that is on. Sets reception.fate
    /// if the frame is lost, and leaves it unchanged if the frame is received. A judge that models
    /// locking also sets reception.locked. The receptions of a frame are judged in the order of
    /// their ends.
    /// @param frame   frame being received
    /// @param others  other frames that may have been on air at the node, in any order
    virtual void judge(Interference& air, const Emission& frame, Frames others,
                       Reception& reception) = 0;

    /// Called when a frame starts; frames are in the order of their starts.
    virtual void begins(const SentFrame& /*frame*/) {}
    /// Called when a frame cannot affect other frames any more.
    virtual void is_forgotten(const Emission& /*frame*/) {}
    /// Cut-off of interference [dB]: frames weaker than the sensitivity by more than this ratio are
    /// neglected. Empty: only frames that can be decoded or sensed interfere.
    virtual std::optional<Db> interference_cut() const { return std::nullopt; }
    /// Largest number of simultaneous frames on air so far; 0 if interference_cut() is empty.
    virtual std::size_t most_on_air() const { return 0; }
    /// Checks a bit rate of a robot or of the access model, at setup.
    /// @throws std::invalid_argument if frames at this rate cannot be judged
    virtual void check(const Phy& /*phy*/, BitRate /*rate*/) const {}
};

/// Type of a reception model's settings: has the model's name, and creates its judge.
template <class T>
concept MakesJudge = std::copyable<T> && requires(const T& settings) {
    { T::name } -> std::convertible_to<std::string_view>;
    { settings.make_judge() } -> std::same_as<std::unique_ptr<Judge>>;
};

/// Settings of any reception model, stored by value; the type of NetworkSettings::reception:
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

    /// Creates the judge for one Network. Null: every frame is received whose path loss is within
    /// the link budget.
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

/// Reception model "threshold": a frame is received if its path loss is within the link budget.
/// Frames do not interfere, and a node can receive while it transmits. "threshold" is the default.
struct Threshold {
    static constexpr std::string_view name = "threshold";

    static constexpr auto fields() { return describe(); }

    /// Judge of the model: null, because no judge is needed.
    std::unique_ptr<Judge> make_judge() const { return nullptr; }
};

}  // namespace rovernet
