// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/planners.hpp"
#include "scene/scene.hpp"
#include "sim/fields.hpp"
#include "sim/geometry.hpp"
#include "sim/legs.hpp"
#include "sim/random.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"

#include <concepts>
#include <limits>
#include <memory>
#include <utility>
#include <variant>

namespace rovernet {

/// Rates [rad/s] at which robots turn in place: half a turn ends well before the clock does.
inline constexpr Range turn_rates{.low = 1e-8, .text = ">= 1e-8 rad/s"};

/// A robot that asks for its next leg, and what its movement model may know.
struct Mover {
    Time now;
    Vec3 position;       ///< [m] now
    Meters radius;       ///< radius of the robot's body
    Planners& planners;  ///< ways around the scene's walls, as if all doors were open
    const Legs& legs;    ///< legs of all robots, for models that go by others
    double heading = 0;  ///< [rad] now, counter-clockwise from the x axis
    static constexpr MetersPerSecond any_speed{std::numeric_limits<double>::infinity()};
    MetersPerSecond top_speed = any_speed;  ///< [m/s] no leg of the library's models is faster
    /// Seed, replication, the robot's key (a) and the number of its movement (b): what its draws
    /// depend on.
    Key draws = {};

    /// Scene now, with the doors that are closed; null: that of the planners.
    const Scene* scene_now = nullptr;

    /// Its storey now; the whole scene if that has one only.
    const Scene& scene() const {
        return (scene_now ? *scene_now : planners.scene()).storey_at(position.z);
    }
    /// The key of the robot's draw `index` of this movement.
    Key key(std::uint64_t index) const {
        Key key = draws;
        key.purpose = Purpose::movement;
        key.index = index;
        return key;
    }
};

/// The movement is over, the robot has arrived: it rests where it is.
struct AtRest {};

/// Answer that there is no way to the goal: the robot rests where it is.
struct Blocked {
    Vec3 goal;  ///< [m]
};

using Step = std::variant<Leg, AtRest, Blocked>;

/// A movement model: a generator of legs, asked whenever a leg has run out. Nothing ticks. A leg
/// starts at mover.now at mover.position and lasts at least a nanosecond; only the first leg of a
/// run may start elsewhere: that is where the robot then starts.
template <class T>
concept MovementModel = std::copy_constructible<T> && requires(T model, Mover& mover) {
    { model.next_leg(mover) } -> std::same_as<Step>;
};

/// The straight leg from where the mover is to `to` at `speed` [m/s], > 0, or at its top speed if
/// that is less.
Leg straight_leg(const Mover& mover, Vec3 to, MetersPerSecond speed);
/// The straight leg from where the mover is to `to`, which it reaches at `arrival` > mover.now, or
/// later if its top speed is too low for that.
Leg straight_leg(const Mover& mover, Vec3 to, Time arrival);

/// A leg without end where the mover is.
inline Leg standing_leg(const Mover& mover) {
    return {
        .start = mover.now, .from = mover.position, .to = mover.position, .heading = mover.heading};
}

/// Stays where it is, for ever: it never comes to rest from a movement.
struct Fixed {
    Step next_leg(Mover& mover) { return standing_leg(mover); }
};

/// What a movement model does where a door closes in the way of its leg. A model says so by a
/// member `at_doors`; others wait.
enum class AtDoors {
    waits,   ///< the robot stops at the door, and goes on with the leg once it opens
    looks,   ///< it stops there, and the model is asked for another leg
    drives,  ///< the same; one that stands is asked again, too, whenever a door closes or opens
    passes   ///< it goes on, as it does through walls
};

/// A movement model that keeps what it knows of a robot apart, in its Progress: copies of one
/// Movement share its parameters, which saves their memory where there are millions of robots.
template <class T>
concept SharedMovementModel = MovementModel<T> &&
    requires(const T& model, Mover& mover, typename T::Progress& progress) {
    { model.next_leg(mover, progress) } -> std::same_as<Step>;
};

/// Any movement model, held by value. By default, and moved from, it is Fixed, which takes no
/// memory of its own.
class Movement {
  public:
    Movement() = default;
    Movement(Fixed) {}
    template <class T>
    requires(!std::same_as<T, Movement> && MovementModel<T>) Movement(T model)
        : self_(std::make_unique<Holder<T>>(std::move(model))) {}
    Movement(const Movement& other) : self_(other.self_ ? other.self_->clone() : nullptr) {}
    Movement(Movement&&) = default;
    Movement& operator=(Movement other) {
        self_ = std::move(other.self_);
        return *this;
    }

    Step next_leg(Mover& mover) { return self_ ? self_->next_leg(mover) : Fixed{}.next_leg(mover); }
    AtDoors at_doors() const { return self_ ? self_->at_doors() : AtDoors::waits; }

  private:
    template <class T>
    static constexpr AtDoors at_doors_of() {
        if constexpr (requires { T::at_doors; }) return T::at_doors;
        return AtDoors::waits;
    }
    struct Concept {
        virtual ~Concept() = default;
        virtual Step next_leg(Mover&) = 0;
        virtual AtDoors at_doors() const = 0;
        virtual std::unique_ptr<Concept> clone() const = 0;
    };
    template <class T>
    struct Holder final : Concept {
        explicit Holder(T m) : model(std::move(m)) {}
        Step next_leg(Mover& mover) override { return model.next_leg(mover); }
        AtDoors at_doors() const override { return at_doors_of<T>(); }
        std::unique_ptr<Concept> clone() const override { return std::make_unique<Holder>(model); }
        T model;
    };
    template <SharedMovementModel T>
    struct Holder<T> final : Concept {
        explicit Holder(T m)
            : progress(std::move(m.progress)), model(std::make_shared<const T>(std::move(m))) {}
        Step next_leg(Mover& mover) override { return model->next_leg(mover, progress); }
        AtDoors at_doors() const override { return at_doors_of<T>(); }
        std::unique_ptr<Concept> clone() const override { return std::make_unique<Holder>(*this); }
        typename T::Progress progress;
        std::shared_ptr<const T> model;
    };
    std::unique_ptr<Concept> self_;  // null: Fixed
};

}  // namespace rovernet
