// SPDX-License-Identifier: MIT
#pragma once

#include "network/network.hpp"
#include "scenario/scenario.hpp"

#include <map>
#include <string>

namespace rovernet {

/// Builder of motion: where a scenario's robots start and how they move, checked against the map.
class MotionBuilder {
  public:
    /// Plan of a robot: its movement from the start, or one in answer to something. Each has its
    /// own draws.
    using Plan = std::uint64_t;
    static constexpr Plan from_the_start = 0;

    /// Makes a builder, which scenario and network must outlive.
    MotionBuilder(Network& network, const Scenario& scenario);

    /// Start of the robot. @throws InputError if there is no room for it
    Vec3 start(const RobotTable& table, const std::string& name);
    /// Movement of the robot from `from` on. @throws InputError for a way that there is not
    Movement movement(const MoveTable& move, const RobotTable& robot, const std::string& name,
                      Vec3 from, Plan plan);

  private:
    Key key(Purpose purpose, const std::string& name, std::uint64_t index,
            Plan plan = from_the_start) const;
    bool fits(Vec3 p, Meters radius) const;
    Vec3 drawn_place(const RobotTable& table, const std::string& name) const;
    Vec3 place_of_model(const RobotTable& table, const std::string& name);
    Step first_step(Movement movement, const RobotTable& robot, const std::string& name, Vec3 from);
    void check_way(Vec3 from, Vec3 to, const RobotTable& robot, const Location& where);

    Movement make(const FixedTable&, const MoveTable&, const RobotTable&, const std::string&, Vec3,
                  Plan) {
        return Fixed{};
    }
    Movement make(const WaypointsTable&, const MoveTable&, const RobotTable&, const std::string&,
                  Vec3, Plan);
    Movement make(const GoalTable&, const MoveTable&, const RobotTable&, const std::string&, Vec3,
                  Plan);
    template <class Model>
    Movement make(Model model, const MoveTable& move, const RobotTable& robot,
                  const std::string& name, Vec3 from, Plan plan);

    Network& network_;
    const Scenario& scenario_;
    std::map<const MoveTable*, Movement> shared_;     // copies share their parameters
    std::map<std::string, NodeId, std::less<>> ids_;  // all robots, also those not yet built
};

}  // namespace rovernet
