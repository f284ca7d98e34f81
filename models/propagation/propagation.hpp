// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/shadowed_range.hpp"
#include "scene/scene.hpp"
#include "sim/fields.hpp"
#include "sim/geometry.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"

#include <concepts>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

namespace rovernet {

/// One transmitter and its receivers: all that a propagation model may know.
///
/// A propagation model is a pure function of places and keys: its losses are kept for robots at
/// rest. Time and frame are for what varies behind it.
struct LinkBatch {
    Hertz frequency;                         ///< [Hz] the transmitter's
    Vec3 from;                               ///< [m] its antenna
    std::span<const Vec3> to;                ///< [m] the receivers' antennas
    std::uint64_t from_key = 0;              ///< the transmitter's key, for random draws
    std::span<const std::uint64_t> to_keys;  ///< the receivers' keys; same size as `to`
    const Scene* scene = nullptr;            ///< never null in a Network
    Meters floor_height{3};                  ///< [m] of one storey
    std::uint64_t seed = 0;
    std::uint32_t replication = 0;
    Time at = start_of_run;   ///< when the frame begins, or the link is looked at
    std::uint64_t frame = 0;  ///< key of the frame, for random draws; 0: the link's local mean

    std::size_t size() const { return to.size(); }
    /// Between the antennas of the i-th link [m], in three dimensions.
    double distance(std::size_t i) const { return rovernet::distance(from, to[i]); }
};

/// A path loss model: a plain struct with one pure function over a batch.
///
/// `loss` fills out_db[i] [dB] for the i-th receiver, same size as the batch; finite and never
/// negative, the same in both directions. It may stop working on a link once its loss exceeds
/// `give_up`, and leave any value above `give_up` there.
template <class T>
concept PropagationModel = std::copy_constructible<T> &&
    requires(const T& model, const LinkBatch& links, Db give_up, std::span<double> out_db) {
    { T::name } -> std::convertible_to<std::string_view>;
    model.loss(links, give_up, out_db);
};

/// A model that bounds its own range: beyond `reach(loss, frequency)` [m] its loss is more than
/// `loss`. Without it every robot is looked at.
template <class T>
concept BoundedModel = requires(const T& model, Db loss, Hertz frequency) {
    { model.reach(loss, frequency) } -> std::same_as<Meters>;
};

/// A model that bounds its range by the heights of the antennas: beyond that no loss between two
/// whose z is at most `highest` [m] is as little as `loss`.
template <class T>
concept BoundedByHeight = requires(const T& model, Db loss, Hertz frequency, Meters highest) {
    { model.reach(loss, frequency, highest) } -> std::same_as<Meters>;
};

/// What a link's loss may do while its ends move; tells how links are decided, and where to look
/// for their changes.
enum class LossShape {
    by_distance,  ///< a function of the distance between the antennas alone, which never falls
    by_pair,      ///< such a function for each pair of nodes
    by_heights,   ///< such a function as long as both antennas keep their heights
    by_walls,  ///< so apart from walls: smooth but where the line of sight passes a wall's corner
    unknown,   ///< anything
};
/// The shape between antennas that move at these velocities [m/s]: not by_heights.
constexpr LossShape shape_in_motion(LossShape shape, Vec3 a, Vec3 b) {
    if (shape != LossShape::by_heights) return shape;
    return a.z == 0 && b.z == 0 ? LossShape::by_distance : LossShape::unknown;
}

/// A model that knows its shape; others are `unknown`.
template <class T>
concept ShapedModel = requires(const T& model) {
    { model.shape() } -> std::same_as<LossShape>;
};

/// A model whose loss, at each frequency, is a ShadowedLoss of the antennas' distance and the
/// pair's own one of the shadowing_draws(): then a ShadowedRange decides links as `loss` does.
template <class T>
concept ShadowedModel = requires(const T& model, Hertz frequency) {
    { model.shadowed_loss(frequency) } -> std::same_as<ShadowedLoss>;
};

/// A model with a random part for each pair of nodes tells the same model without it; with nothing
/// random, an equal model.
template <class T>
concept RandomModel = requires(const T& model) {
    { model.median() } -> std::same_as<T>;
    { model.is_random() } -> std::same_as<bool>;
};

/// A model that cannot work with every frequency says so by std::invalid_argument.
template <class T>
concept FrequencyCheckedModel = requires(const T& model, Hertz frequency) {
    model.check_frequency(frequency);
};

/// Any propagation model, held by value and shared between its copies (models do not change).
class Propagation {
  public:
    static constexpr Meters anything{std::numeric_limits<double>::infinity()};

    /// @throws std::invalid_argument if a parameter is out of its range
    template <class T>
    requires(!std::same_as<T, Propagation> && PropagationModel<T>) Propagation(T model)
        : self_(std::make_shared<Holder<T>>(std::move(model))) {}

    std::string_view name() const { return self_->name(); }
    void loss(const LinkBatch& links, Db give_up, std::span<double> out_db) const {
        self_->loss(links, give_up, out_db);
    }
    /// Infinite if the model does not bound it. @param highest  [m] no antenna's z is more
    Meters reach(Db loss, Hertz frequency, Meters highest = anything) const {
        return self_->reach(loss, frequency, highest);
    }
    /// Its bound takes the heights of the antennas.
    bool is_bounded_by_height() const { return self_->is_bounded_by_height(); }
    void check_frequency(Hertz frequency) const { self_->check_frequency(frequency); }
    LossShape shape() const { return self_->shape(); }
    /// What to build a ShadowedRange of; nothing if the model is not a ShadowedModel.
    std::optional<ShadowedLoss> shadowed_loss(Hertz frequency) const {
        return self_->shadowed_loss(frequency);
    }
    /// Whether each pair of nodes draws a part of its loss.
    bool is_random() const { return self_->is_random(); }
    /// The model without its random part; this one if it has none.
    Propagation median() const { return is_random() ? self_->median() : *this; }
    /// The model inside if it is a T, or null.
    template <class T>
    const T* as() const {
        const auto* holder = dynamic_cast<const Holder<T>*>(self_.get());
        return holder ? &holder->model : nullptr;
    }
    /// Whether both are copies of one handle; the Network keeps one table entry for them.
    friend bool operator==(const Propagation&, const Propagation&) = default;

  private:
    struct Concept {
        virtual ~Concept() = default;
        virtual std::string_view name() const = 0;
        virtual void loss(const LinkBatch&, Db, std::span<double>) const = 0;
        virtual Meters reach(Db, Hertz, Meters) const = 0;
        virtual bool is_bounded_by_height() const = 0;
        virtual void check_frequency(Hertz) const = 0;
        virtual LossShape shape() const = 0;
        virtual std::optional<ShadowedLoss> shadowed_loss(Hertz) const = 0;
        virtual bool is_random() const = 0;
        virtual Propagation median() const = 0;  // of a model that is random
    };
    template <class T>
    struct Holder final : Concept {
        explicit Holder(T m) : model(std::move(m)) {
            if constexpr (Described<T>) check_fields(model, T::name);
        }
        std::string_view name() const override { return T::name; }
        void loss(const LinkBatch& links, Db give_up, std::span<double> out_db) const override {
            model.loss(links, give_up, out_db);
        }
        Meters reach(Db loss, Hertz frequency, [[maybe_unused]] Meters highest) const override {
            if constexpr (BoundedByHeight<T>) return model.reach(loss, frequency, highest);
            if constexpr (BoundedModel<T>) return model.reach(loss, frequency);
            return anything;
        }
        bool is_bounded_by_height() const override { return BoundedByHeight<T>; }
        void check_frequency(Hertz frequency) const override {
            if constexpr (FrequencyCheckedModel<T>) model.check_frequency(frequency);
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
    std::shared_ptr<const Concept> self_;
};

}  // namespace rovernet
