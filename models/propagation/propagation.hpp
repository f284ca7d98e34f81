// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/propagation_model.hpp"
#include "sim/fields.hpp"
#include "sim/units.hpp"

#include <concepts>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

// Handle of propagation models. A Network has one model for all robots, and a robot may have its
// own:
//
//     Network network({.propagation = LogDistance{.exponent = 3}});
//     network.add({.name = "A", .propagation = Friis{}});

namespace rovernet {

/// Propagation model of any type, stored by value and shared between copies (models are immutable).
/// Used by robots, tables and the medium. For optional functions that a model lacks, Propagation
/// returns safe defaults.
///
///   const Propagation model = LogDistance{.exponent = 3, .sigma = Db{0}};
///   model.reach(Db{90}, 2450_MHz);  // [m] beyond which more than 90 dB are lost
///   model.shape();                  // LossShape::by_distance
class Propagation {
  public:
    /// Value of `highest` in reach() for antennas of any height: infinity.
    static constexpr Meters anything{std::numeric_limits<double>::infinity()};

    /// @throws std::invalid_argument if a parameter is out of its range
    template <class T>
    requires(!std::same_as<T, Propagation> && PropagationModel<T>) Propagation(T model)
        : self_(std::make_shared<Holder<T>>(std::move(model))) {}

    /// Name of the model in scenario files.
    std::string_view name() const { return self_->name(); }
    /// Computes the losses [dB] of a batch of links, see PropagationModel.
    /// @param cutoff  loss [dB] above which results need not be exact: they may be any value above
    ///                `cutoff`
    /// @param out_db   loss [dB] for each receiver
    void loss(const LinkBatch& links, Db cutoff, std::span<double> out_db) const {
        self_->loss(links, cutoff, out_db);
    }
    /// Loss [dB] of one link.
    /// @param link    link without its receiver: transmitter, frequency and scene
    /// @param to      position of the receiver's antenna [m]
    /// @param to_key  key of the receiver
    double loss_to(Vec3 to, LinkBatch link, std::uint64_t to_key = 0) const {
        link.to = {&to, 1};
        link.to_keys = {&to_key, 1};
        double db = 0;
        loss(link, Db{std::numeric_limits<double>::infinity()}, {&db, 1});
        return db;
    }
    /// Distance [m] beyond which the loss is more than `loss`; infinite if the model has no bound.
    /// @param highest  upper bound [m] on z of all antennas
    Meters reach(Db loss, Hertz frequency, Meters highest = anything) const {
        return self_->reach(loss, frequency, highest);
    }
    /// Whether reach() depends on antenna heights, see BoundedByHeight.
    bool is_bounded_by_height() const { return self_->is_bounded_by_height(); }
    /// Checks a frequency. @throws std::invalid_argument if the propagation model cannot work with
    /// the frequency
    void check_frequency(Hertz frequency) const { self_->check_frequency(frequency); }
    /// Checks a scene. @throws std::invalid_argument if the propagation model cannot work in the
    /// scene
    void check_scene(const Scene& scene) const { self_->check_scene(scene); }
    /// Shape of the path loss as a function of antenna positions.
    LossShape shape() const { return self_->shape(); }
    /// Loss as a function of distance and shadowing draw, for a ShadowedRange; empty if the model
    /// is not a ShadowedModel.
    std::optional<ShadowedLoss> shadowed_loss(Hertz frequency) const {
        return self_->shadowed_loss(frequency);
    }
    /// Whether the loss has a random part for each pair of nodes.
    bool is_random() const { return self_->is_random(); }
    /// Propagation model without its random part; a copy of this model if it has no random part.
    Propagation median() const { return is_random() ? self_->median() : *this; }
    /// Propagation model as type T; null if the model is of another type.
    template <class T>
    const T* as() const {
        const auto* holder = dynamic_cast<const Holder<T>*>(self_.get());
        return holder ? &holder->model : nullptr;
    }
    /// Whether both objects are copies of one Propagation and share its model. The medium stores a
    /// shared model once.
    friend bool operator==(const Propagation&, const Propagation&) = default;

  private:
    // Interface to a model of any type; Holder adds safe defaults for missing functions.
    struct Concept {
        virtual ~Concept() = default;
        virtual std::string_view name() const = 0;
        virtual void loss(const LinkBatch&, Db, std::span<double>) const = 0;
        virtual Meters reach(Db, Hertz, Meters) const = 0;
        virtual bool is_bounded_by_height() const = 0;
        virtual void check_frequency(Hertz) const = 0;
        virtual void check_scene(const Scene&) const = 0;
        virtual LossShape shape() const = 0;
        virtual std::optional<ShadowedLoss> shadowed_loss(Hertz) const = 0;
        virtual bool is_random() const = 0;
        /// Model without its random part; only called for a random model.
        virtual Propagation median() const = 0;
    };
    // Model of type T. Missing functions get defaults that are valid for any model: infinite reach,
    // unknown shape, no shadowing.
    template <class T>
    struct Holder final : Concept {
        /// Stores the model and checks its parameters.
        explicit Holder(T m) : model(std::move(m)) {
            if constexpr (Described<T>) check_fields(model, T::name);
        }
        std::string_view name() const override { return T::name; }
        void loss(const LinkBatch& links, Db cutoff, std::span<double> out_db) const override {
            model.loss(links, cutoff, out_db);
        }
        /// Bound of the range [m] by the model's own reach(); infinite if the model has no reach().
        Meters reach(Db loss, Hertz frequency, [[maybe_unused]] Meters highest) const override {
            if constexpr (BoundedByHeight<T>) return model.reach(loss, frequency, highest);
            if constexpr (BoundedModel<T>) return model.reach(loss, frequency);
            return anything;
        }
        /// True if T is BoundedByHeight.
        bool is_bounded_by_height() const override { return BoundedByHeight<T>; }
        void check_frequency(Hertz frequency) const override {
            if constexpr (FrequencyCheckedModel<T>) model.check_frequency(frequency);
        }
        void check_scene(const Scene& scene) const override {
            if constexpr (SceneCheckedModel<T>) model.check_scene(scene);
        }
        LossShape shape() const override {
            if constexpr (ShapedModel<T>) return model.shape();
            return LossShape::unknown;
        }
        std::optional<ShadowedLoss> shadowed_loss(Hertz frequency) const override {
            if constexpr (ShadowedModel<T>) return model.shadowed_loss(frequency);
            return std::nullopt;
        }
        bool is_random() const override {
            if constexpr (RandomModel<T>) return model.is_random();
            return false;
        }
        Propagation median() const override {
            if constexpr (RandomModel<T>) return Propagation(model.median());
            return Propagation(model);
        }
        T model;
    };
    // Propagation model, shared by all copies of a Propagation; never null.
    std::shared_ptr<const Concept> self_;
};

}  // namespace rovernet
