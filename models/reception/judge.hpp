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

namespace rovernet {

class Interference;

/// A frame that goes on air, as judging it may take.
struct SentFrame {
    const Emission& emission;
    const Phy& phy;                         ///< of the network; outlives the judge
    BitRate rate;                           ///< of its payload
    Duration preamble;                      ///< [ns] before its payload
    std::span<const Reception> receptions;  ///< of those that can decode it, in order
};

/// Other frames that may be on air at a receiver.
using Frames = std::span<const Emission* const>;

/// Decides what becomes of frames at their receivers; one for all nodes of a Network.
class Judge {
  public:
    virtual ~Judge() = default;

    /// A receiver may have been at frames that were over before the one that is judged began.
    virtual bool looks_back() const = 0;
    /// Decides what becomes of a reception that ends now, at a node that is on, among `others` that
    /// may have been on air there.
    virtual void judge(Interference& air, const Emission& frame, Frames others,
                       Reception& reception) = 0;

    /// A frame goes on air, or no judgement depends on it any more.
    virtual void begins(const SentFrame& /*frame*/) {}
    virtual void is_forgotten(const Emission& /*frame*/) {}
    /// Frames weaker than the sensitivity by this are left out; nothing: only who can decode or
    /// sense a frame matters.
    virtual std::optional<Db> interference_cut() const { return std::nullopt; }
    /// Frames on air at a time, at most, so far; counted where there is a cut.
    virtual std::size_t most_on_air() const { return 0; }
    /// @throws std::invalid_argument for a bit rate that frames cannot be judged at
    virtual void check(const Phy& /*phy*/, BitRate /*rate*/) const {}
};

/// The settings of a reception model.
template <class T>
concept MakesJudge = std::copyable<T> && requires(const T& settings) {
    { T::name } -> std::convertible_to<std::string_view>;
    { settings.make_judge() } -> std::same_as<std::unique_ptr<Judge>>;
};

/// Any reception model's settings, held by value: what becomes of frames at a receiver.
class ReceptionModel {
  public:
    template <class T>
    requires(!std::same_as<T, ReceptionModel> && MakesJudge<T>) ReceptionModel(T settings)
        : name_(T::name),
          make_([settings = std::move(settings)] { return settings.make_judge(); }) {}

    std::string_view name() const { return name_; }

    /// A judge for one Network; null: a frame is received wherever the link budget allows it.
    std::unique_ptr<Judge> make_judge() const { return make_(); }
    /// Judge::interference_cut of its judges.
    std::optional<Db> interference_cut() const {
        const auto judge = make_judge();
        return judge ? judge->interference_cut() : std::nullopt;
    }

  private:
    std::string_view name_;
    std::function<std::unique_ptr<Judge>()> make_;
};

/// Reception model "threshold": a frame is received wherever the link budget allows it.
struct Threshold {
    static constexpr std::string_view name = "threshold";

    std::unique_ptr<Judge> make_judge() const { return nullptr; }
};

}  // namespace rovernet
