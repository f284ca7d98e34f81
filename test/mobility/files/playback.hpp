// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/files/movement_file.hpp"
#include "sim/geometry.hpp"
#include "sim/time.hpp"

#include <stdexcept>
#include <string>
#include <vector>

namespace rovernet::test {

/// Playback of a movement file: positions and velocities of its robots at any time.
class Playback {
  public:
    explicit Playback(const std::string& path, MovementSyntax syntax = MovementSyntax::strict)
        : file(path, syntax), by_robot_(file.robots().size()) {
        while (const auto command = file.next()) {
            commands.push_back(*command);
            by_robot_.at(command->robot).push_back(*command);
        }
    }

    std::size_t robot(const std::string& name) const {
        for (std::size_t i = 0; i < file.robots().size(); ++i) {
            if (file.robots()[i].name == name) return i;
        }
        throw std::out_of_range("no robot " + name);
    }
    /// Position of a robot [m] at `t` [s], after its commands at `t`.
    Vec3 position(const std::string& name, double t) const { return state(name, t).at; }
    /// Velocity of a robot [m/s] from `t` [s] on.
    Vec3 velocity(const std::string& name, double t) const { return state(name, t).velocity; }
    bool present(const std::string& name, double t) const { return state(name, t).present; }

    MovementFile file;
    std::vector<MovementCommand> commands;

  private:
    struct State {
        Vec3 at;
        Vec3 velocity = {};
        bool present = true;
    };
    /// State at `t` of a robot that moves straight from `from` to `to`, and stands there from
    /// `arrival` on.
    static State moving(Vec3 from, Vec3 to, double start, double arrival, double t) {
        if (t >= arrival) return {to};
        const Vec3 velocity = (1 / (arrival - start)) * (to - from);
        return {from + (t - start) * velocity, velocity};
    }
    /// State at `t` of a robot that received the command `c` at the place `from`.
    static State after(const MovementCommand& c, Vec3 from, double t) {
        const double start = seconds(c.time);
        switch (c.kind) {
            case MovementCommand::Kind::appear: return {c.to};
            case MovementCommand::Kind::vanish: return {from, {}, false};
            case MovementCommand::Kind::reach:
                return moving(from, c.to, start, seconds(c.arrival), t);
            default: break;
        }
        const double length = distance(from, c.to);
        if (c.speed == 0 || length == 0) return {from};
        return moving(from, c.to, start, start + length / c.speed, t);
    }
    State state(const std::string& name, double t) const {
        const std::size_t robot_index = robot(name);
        const FileRobot& r = file.robots()[robot_index];
        State now{r.start, {}, t >= seconds(r.appears)};
        const auto& own = by_robot_[robot_index];
        Vec3 from = r.start;
        for (std::size_t i = 0; i < own.size() && seconds(own[i].time) <= t; ++i) {
            const bool has_next = i + 1 < own.size() && seconds(own[i + 1].time) <= t;
            now = after(own[i], from, has_next ? seconds(own[i + 1].time) : t);
            from = now.at;
        }
        return now;
    }

    std::vector<std::vector<MovementCommand>> by_robot_;
};

/// Message of the error when the file is read, without the folder of the file; empty if there is no
/// error.
inline std::string movement_error(const std::string& path,
                                  MovementSyntax syntax = MovementSyntax::strict) {
    try {
        MovementFile file(path, syntax);
        while (file.next()) continue;
    } catch (const std::exception& error) {
        const std::string text = error.what();
        const std::size_t folder = path.rfind('/') + 1;
        return text.compare(0, folder, path, 0, folder) == 0 ? text.substr(folder) : text;
    }
    return "";
}

}  // namespace rovernet::test
