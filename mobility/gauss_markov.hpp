// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/area.hpp"
#include "mobility/movement.hpp"
#include "sim/fields.hpp"

#include <optional>
#include <string_view>
#include <vector>

namespace rovernet {

/// Gauss-Markov mobility model: after every `step`, a speed s' is drawn that is correlated with the
/// previous speed s by a = `memory`, with a standard normal draw w. The same rule holds for angles:
///   s' = a s + (1 - a) mean_speed + sqrt(1 - a^2) speed_sigma w
///
/// The speed is normally distributed with mean_speed and speed_sigma at all times, and its
/// autocorrelation over k steps is a^k. At a speed below 0 the robot moves in the opposite
/// direction. Within a tenth of the area's shorter side from a border, the mean direction points to
/// the middle of the area, until the next border. A leg that would cross a border or a wall ends
/// there (a micrometre before a wall), and a new step begins: at a border towards the middle, at a
/// wall in the reverse direction. The robot's top speed limits the speed.
/// Sources: B. Liang, Z. Haas, Predictive distance-based mobility management for PCS networks,
/// INFOCOM 1999; T. Camp, J. Boleng, V. Davies, A survey of mobility models for ad hoc network
/// research, Wireless Communications and Mobile Computing 2(5), 2002, section 2.5.
struct GaussMarkov {
    static constexpr std::string_view name = "gauss_markov";
    static constexpr AtDoors at_doors = AtDoors::looks;

    std::vector<Vec3> area = {};       ///< area [m]: lower-left, upper-right corner; empty: the map
    MetersPerSecond mean_speed{1};     ///< mean of the speed [m/s], >= 0
    MetersPerSecond speed_sigma{0.2};  ///< standard deviation of the speed [m/s], >= 0
    std::optional<Radians> mean_direction = std::nullopt;  ///< first mean direction; empty: random
    Radians direction_sigma{0.4};             ///< standard deviation of the direction, >= 0
    double memory = 0.75;                     ///< a, correlation of consecutive steps [-], 0 ... 1
    Duration step = std::chrono::seconds{1};  ///< time between two draws [ns], from 1 us
    StartPlace start = StartPlace::uniform;

    static constexpr auto fields() {
        constexpr Range share{.low = 0, .high = 1, .text = "from 0 to 1"};
        constexpr Range angle{.low = -1e6, .high = 1e6, .text = "from -1e6 to 1e6 rad"};
        constexpr Range spread{.low = 0, .high = 1e6, .text = "from 0 to 1e6 rad"};
        return describe(field("area", &GaussMarkov::area,
                              "lower-left and upper-right corner of the area in which the robot "
                              "moves; if not given, the whole map"),
                        field("mean_speed", &GaussMarkov::mean_speed, non_negative, "mean speed"),
                        field("speed_sigma", &GaussMarkov::speed_sigma, non_negative,
                              "standard deviation of the speed"),
                        field("mean_direction", &GaussMarkov::mean_direction, angle,
                              "mean direction at the start, counter-clockwise from the x axis; if "
                              "not given, a random direction"),
                        field("direction_sigma", &GaussMarkov::direction_sigma, spread,
                              "standard deviation of the direction from its mean"),
                        field("memory", &GaussMarkov::memory, share,
                              "the factor a: correlation between the velocities of two successive "
                              "steps; 0: no correlation; 1: the velocity never changes"),
                        field("step", &GaussMarkov::step, step_length,
                              "time between two draws of speed and direction"),
                        field("start", &GaussMarkov::start,
                              "place at which the movement begins. uniform: a place drawn "
                              "uniformly from the area; here: the robot's `at` or `place`"));
    }

    /// @throws std::invalid_argument for a parameter out of its range
    Step next_leg(Mover& mover);

    /// State of the robot in this movement, for the model only.
    struct Progress {
        bool begun = false;
        Draws draws = {};
        double speed = 0;           // current speed [m/s]
        double direction = 0;       // current direction of movement [rad]
        double mean_direction = 0;  // direction that the draws scatter about [rad]
    } progress = {};

  private:
    void begin(const Mover& mover);
    void advance(const Mover& mover, const Area& field);
    void turn_to_middle(const Area& field, Vec3 p);
    void turn_round();
};

}  // namespace rovernet
