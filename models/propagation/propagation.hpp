// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/propagation_model.hpp"
#include "models/propagation/shadowed_range.hpp"
#include "sim/fields.hpp"
#include "sim/units.hpp"

#include <concepts>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

// The handle of propagation models. A Network has one for all robots, and each robot may have its
// own:
//
//     Network network({.propagation = LogDistance{.exponent = 3}});
//     network.add({.name = "A", .propagation = Friis{}});

namespace rovernet {

/// Any propagation model, held by value and shared between its copies (models do not change).
/// Robots, tables and the medium have one; what the model does not know of itself has a safe answer
/// here.
///
///   const Propagation model = LogDistance{.exponent = 3, .sigma = Db{0}};
///   model.reach(Db{90}, 2450_MHz);  // [m] beyond which more than 90 dB are lost
///   model.shape();                  // LossShape::by_distance
class Propagation {
  public:
    /// Height that bounds nothing.
    static constexpr Meters anything{std::numeric_limits<double>::infinity()};

    /// @throws std::invalid_argument if a parameter is out of its range
    template <class T>
    requires(!std::same_as<T, Propagation> && PropagationModel<T>) Propagation(T model)
        : self_(std::make_shared<Holder<T>>(std::move(model))) {}

    /// Name of the model, as in files.
    std::string_view name() const { return self_->name(); }
    /// Losses of a batch [dB], see PropagationModel.
    /// @param give_up  loss [dB] above which a value need not be right, only above it
    /// @param out_db   one for each receiver
    void loss(const LinkBatch& links, Db give_up, std::span<double> out_db) const {
        self_->loss(links, give_up, out_db);
    }
    /// Distance [m] beyond which the loss is more than `loss`; infinite if the model does not bound
    /// it.
    /// @param highest  height that no antenna's z exceeds [m]
    Meters reach(Db loss, Hertz frequency, Meters highest = anything) const {
        return self_->reach(loss, frequency, highest);
    }
    /// Whether its bound takes the heights of the antennas, see BoundedByHeight.
    bool is_bounded_by_height() const { return self_->is_bounded_by_height(); }
    /// Checks a frequency. @throws std::invalid_argument if the model cannot work with it
    void check_frequency(Hertz frequency) const { self_->check_frequency(frequency); }
    /// Checks a scene. @throws std::invalid_argument if the model cannot work in it
    void check_scene(const Scene& scene) const { self_->check_scene(scene); }
    /// Shape of the loss while the ends of a link move.
    LossShape shape() const { return self_->shape(); }
    /// Loss to build a ShadowedRange of; nothing if the model is not a ShadowedModel.
    std::optional<ShadowedLoss> shadowed_loss(Hertz frequency) const {
        return self_->shadowed_loss(frequency);
    }
    /// Whether each pair of nodes draws a part of its loss.
    bool is_random() const { return self_->is_random(); }
    /// Model without its random part; this one if it has none.
    Propagation median() const { return is_random() ? self_->median() : *this; }
    /// Model inside if it is a T, or null.
    template <class T>
    const T* as() const {
        const auto* holder = dynamic_cast<const Holder<T>*>(self_.get());
        return holder ? &holder->model : nullptr;
    }
    /// Whether both are copies of one handle; the medium keeps one table entry for them.
    friend bool operator==(const Propagation&, const Propagation&) = default;

  private:
    // Functions of the model inside, whatever its type; what it lacks is answered safely by Holder.
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
        /// Asked only of a model that is random.
        virtual Propagation median() const = 0;
    };
    // Model of a type. A function that the model does not have gets the answer that is right for
    // any: an infinite reach, an unknown shape, no shadowing.
    template <class T>
    struct Holder final : Concept {
        /// Parameters are checked once, here.
        explicit Holder(T m) : model(std::move(m)) {
            if constexpr (Described<T>) check_fields(model, T::name);
        }
        std::string_view name() const override { return T::name; }
        void loss(const LinkBatch& links, Db give_up, std::span<double> out_db) const override {
            model.loss(links, give_up, out_db);
        }
        /// The most that the model knows of its range.
        Meters reach(Db loss, Hertz frequency, [[maybe_unused]] Meters highest) const override {
            if constexpr (BoundedByHeight<T>) return model.reach(loss, frequency, highest);
            if constexpr (BoundedModel<T>) return model.reach(loss, frequency);
            return anything;
        }
        /// Known at compile time.
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
    // Never null, and shared: equal handles are copies of one.
    std::shared_ptr<const Concept> self_;
};

}  // namespace rovernet
