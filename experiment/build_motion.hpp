// SPDX-License-Identifier: MIT
#pragma once

#include "network/network.hpp"
#include "scenario/scenario.hpp"

#include <map>
#include <string>

namespace rovernet {

/// Builder of start positions and movements of a scenario's robots, checked against the map.
class MotionBuilder {
  public:
    /// Number of a movement of a robot: 0 for the movement at the start, other numbers for the
    /// movements that the robot's reactions start. Each number has a separate random stream.
    using Plan = std::uint64_t;
    static constexpr Plan from_the_start = 0;

    /// Makes a builder. `network` and `scenario` must outlive the builder.
    MotionBuilder(Network& network, const Scenario& scenario);

    /// Start position of the robot [m]. @throws InputError if the robot does not fit at this
    /// position
    Vec3 start(const RobotTable& table, const std::string& name);
    /// Movement of the robot, starting at the position `from`. @throws InputError if no path
    /// reaches a goal
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
    std::map<const MoveTable*, Movement> shared_;  // movements that robots of one table share
    // Ids of all robots by name, including robots that are not yet in the network.
    std::map<std::string, NodeId, std::less<>> ids_;
};

}  // namespace rovernet
