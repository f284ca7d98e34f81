// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fields.hpp"
#include "sim/geometry.hpp"
#include "sim/leg.hpp"
#include "sim/random.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"

#include <concepts>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <variant>

namespace rovernet {

class Legs;
class Planners;
class Scene;

/// Valid turn rates [rad/s] of robots that turn in place. At the lowest rate, half a turn ends long
/// before the end of the simulation's clock (292 years).
inline constexpr Range turn_rates{.low = 1e-8, .text = ">= 1e-8 rad/s"};

/// Valid ranges [s] of the time steps (step_length) and the rests (rest_length) of movement models.
/// The simulation's clock (292 years) has room for several of the longest steps.
inline constexpr Range step_length{
    .low = 1e-6, .high = 9e8, .text = "from 1 us to 9e8 s (28 years)"};
inline constexpr Range rest_length{.low = 0, .high = 9e8, .text = "from 0 s to 9e8 s (28 years)"};

/// Robot that needs its next leg (piece of movement): the input of a movement model.
struct Mover {
    Time now;
    Vec3 position;       ///< current position [m]
    Meters radius;       ///< radius of the robot's body
    Planners& planners;  ///< planners of paths around the scene's walls, with all doors open
    const Legs& legs;    ///< legs of all robots, for models that depend on other robots
    double heading = 0;  ///< current heading [rad], counter-clockwise from the x axis
    static constexpr MetersPerSecond any_speed{std::numeric_limits<double>::infinity()};
    MetersPerSecond top_speed = any_speed;  ///< speed limit of the library's movement models [m/s]
    /// Key of the movement's random draws: seed, replication, key of the robot (a), and number of
    /// its movement (b).
    Key draws = {};

    /// Current scene, with closed doors; null: the scene of the planners.
    const Scene* scene_now = nullptr;

    /// Scene of the robot's current storey; the whole scene if it has only one storey.
    const Scene& scene() const;
    /// Key of the robot's random draw number `index` in this movement.
    Key key(std::uint64_t index) const {
        Key key = draws;
        key.purpose = Purpose::movement;
        key.index = index;
        return key;
    }
};

/// Result of a movement model: the movement is over and the robot rests at its goal.
struct AtRest {};

/// Result of a movement model: there is no path to the goal, and the robot rests at its position.
struct Blocked {
    Vec3 goal;  ///< goal without a path [m]
};

/// Result of a movement model: the next leg (piece of movement), or the reason why there is none.
using Step = std::variant<Leg, AtRest, Blocked>;

/// Movement model: a generator of legs (pieces of movement). It is called whenever a leg has ended,
/// not at fixed time steps. A leg starts at mover.now at mover.position and lasts at least a
/// nanosecond. Only the first leg of a run may start at another position, the robot's start
/// position.
/// Example: examples/own_movement.cpp.
template <class T>
concept MovementModel = std::copy_constructible<T> && requires(T model, Mover& mover) {
    { model.next_leg(mover) } -> std::same_as<Step>;
};

/// Straight leg from the mover's position to `to` at `speed` > 0 [m/s], at most mover.top_speed.
Leg straight_leg(const Mover& mover, Vec3 to, MetersPerSecond speed);
/// Straight leg from the mover's position to `to`, which the mover reaches at `arrival` >
/// mover.now, or later if mover.top_speed is too low.
Leg straight_leg(const Mover& mover, Vec3 to, Time arrival);

/// Endless leg (piece of movement) at rest at the mover's position.
inline Leg standing_leg(const Mover& mover) {
    return {
        .start = mover.now, .from = mover.position, .to = mover.position, .heading = mover.heading};
}

/// Movement model of a robot that never moves. The movement has no end.
struct Fixed {
    Step next_leg(Mover& mover) { return standing_leg(mover); }
};

/// Reaction of a moving robot to a door that closes in the path of its leg. A movement model sets
/// the reaction by a static member `at_doors`; the default is `waits`.
enum class AtDoors {
    waits,   ///< the robot stops at the door, and continues the leg once the door opens
    looks,   ///< the robot stops at the door, and the model returns a new leg
    drives,  ///< like `looks`; a standing robot also gets a new leg whenever a door closes or opens
    passes   ///< the robot moves on, also through walls: a recorded movement, which is played
             ///< exactly as it is, also without turning in place first
};

/// Movement model that stores the state of a robot separately, in its Progress: copies of one
/// Movement share their parameters, which saves memory with millions of robots.
template <class T>
concept SharedMovementModel = MovementModel<T> &&
    requires(const T& model, Mover& mover, typename T::Progress& progress) {
    { model.next_leg(mover, progress) } -> std::same_as<Step>;
};

/// Movement model of any type, stored by value. A default-constructed or moved-from Movement is
/// Fixed, without memory of its own.
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

/// Sequence of random numbers for one movement.
///
/// The numbers depend only on seed, replication, the robot's name and the number of its movement,
/// not on other robots.
struct Draws {
    std::uint32_t used = 0;  // number of draws so far; 2^32 are enough for a billion legs

    double uniform(const Mover& mover) { return rovernet::uniform(mover.key(used++)); }
    double normal(const Mover& mover) { return rovernet::normal(mover.key(used++)); }
};

}  // namespace rovernet
