// SPDX-License-Identifier: MIT
#pragma once

#include "models/arrival.hpp"
#include "models/phy/phy.hpp"
#include "sim/record.hpp"
#include "sim/units.hpp"

#include <concepts>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

// The port of reception models: what becomes of a frame at a receiver that it reaches. A model is
// settings with a name and make_judge(), and a Judge that applies it for all nodes.
// test/extend/added/models/reception/preamble.hpp is a small one.
//
//     begins(frame)              as a frame goes on air
//     judge(frame, others, r)    as it ends at a receiver that could decode it
//     is_forgotten(frame)        once it matters to no other

namespace rovernet {

class Interference;

/// Frame that goes on air, with all that judging it may take. What it points to is good during the
/// call; a judge keeps what it needs, by Emission::flight.
struct SentFrame {
    /// Frame, as it is kept while it matters.
    const Emission& emission;
    /// Physical layer of the network; outlives the judge.
    const Phy& phy;
    /// Rate of its payload [bit/s].
    BitRate rate;
    /// Time before its payload [ns].
    Duration preamble;
    /// Receptions of those who can decode it, in order.
    std::span<const Reception> receptions;
};

/// Other frames that may be on air at a receiver; a judge asks Interference::arrival whether they
/// are.
using Frames = std::span<const Emission* const>;

/// Rule of a reception model at work: decides the fate of frames at their receivers. One object for
/// all nodes of a Network.
class Judge {
  public:
    /// Judges are owned by Interference.
    virtual ~Judge() = default;

    /// Whether a receiver may have been at frames that were over before the one that is judged
    /// began; these are then among the others, too.
    virtual bool looks_back() const = 0;
    /// Decides the fate of a reception that ends now, at a node that is on; it sets reception.fate,
    /// and leaves it as it is for a frame that is received. A judge that knows sets
    /// reception.locked, too. Receptions of a frame are judged one after the other, in the order in
    /// which it ends at them.
    /// @param frame   frame that is received
    /// @param others  frames that may have been on air there, in no order to rely on
    virtual void judge(Interference& air, const Emission& frame, Frames others,
                       Reception& reception) = 0;

    /// Takes note that a frame goes on air. Frames come in the order of their begin.
    virtual void begins(const SentFrame& /*frame*/) {}
    /// Takes note that no judgement depends on a frame any more.
    virtual void is_forgotten(const Emission& /*frame*/) {}
    /// Cut of interference: frames weaker than the sensitivity by this [dB] are left out; nothing:
    /// only who can decode or sense a frame matters.
    virtual std::optional<Db> interference_cut() const { return std::nullopt; }
    /// Number of frames on air at a time, at most, so far; counted where there is a cut.
    virtual std::size_t most_on_air() const { return 0; }
    /// Checks a bit rate that some robot or the access model sends at, as they are set up.
    /// @throws std::invalid_argument if frames of it cannot be judged
    virtual void check(const Phy& /*phy*/, BitRate /*rate*/) const {}
};

/// Settings of a reception model: they name it and make its judge.
template <class T>
concept MakesJudge = std::copyable<T> && requires(const T& settings) {
    { T::name } -> std::convertible_to<std::string_view>;
    { settings.make_judge() } -> std::same_as<std::unique_ptr<Judge>>;
};

/// Settings of any reception model, held by value. NetworkSettings::reception is one:
///
///   Network network({.reception = Collision{.capture_ratio = 6_dB}});
class ReceptionModel {
  public:
    template <class T>
    requires(!std::same_as<T, ReceptionModel> && MakesJudge<T>) ReceptionModel(T settings)
        : name_(T::name),
          make_([settings = std::move(settings)] { return settings.make_judge(); }) {}

    /// Name of the model, as in files.
    std::string_view name() const { return name_; }

    /// Judge for one Network; null: a frame is received wherever the link budget allows it.
    std::unique_ptr<Judge> make_judge() const { return make_(); }
    /// Cut of interference of its judges [dB], see Judge::interference_cut.
    std::optional<Db> interference_cut() const {
        const auto judge = make_judge();
        return judge ? judge->interference_cut() : std::nullopt;
    }

  private:
    std::string_view name_;
    // Makes the judge of the settings inside.
    std::function<std::unique_ptr<Judge>()> make_;
};

/// Reception model "threshold": a frame is received wherever the link budget allows it. Frames do
/// not interfere, and a node that sends receives as well. The default.
struct Threshold {
    static constexpr std::string_view name = "threshold";

    /// No judge is needed.
    std::unique_ptr<Judge> make_judge() const { return nullptr; }
};

}  // namespace rovernet
