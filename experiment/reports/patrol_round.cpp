// SPDX-License-Identifier: MIT
#include "experiment/reports/patrol_round.hpp"

#include "mobility/patrol.hpp"

#include <string>
#include <variant>
#include <vector>

namespace rovernet {
namespace {

/// Movement of the robot with this name; null if it is not `patrol`.
const Patrol* patrol_of(const Scenario& scenario, const std::string& name) {
    for (const RobotTable& robot : scenario.robots) {
        for (int i = 0; i < robot.count.value_or(1); ++i)
            if (robot.name_of(i) == name) return std::get_if<Patrol>(&robot.move.model);
    }
    return nullptr;
}

/// Follows a robot from place to place of its path.
struct RoundFollower {
    const std::vector<Vec3>& path;
    std::size_t next;         // index of the next place
    std::size_t reached = 0;  // number of places since `begin`; a repeated one counts again
    Time begin = {};
    std::optional<PatrolRound> last = {};

    bool is_at_next(Vec3 p) const {
        constexpr double same_place = 1e-6;  // [m]: more than rounding
        return distance(p, path[next]) < same_place;
    }
    /// Counts the places at p, where the robot is at time t, and the rounds that end there.
    void pass(Vec3 p, Time t) {
        for (std::size_t here = 0; here < path.size() && is_at_next(p); ++here) {
            next = (next + 1) % path.size();
            if (reached++ == 0) begin = t;
            if (reached <= path.size()) continue;
            if (t > begin) last = {path.size(), begin, t - begin};
            reached = 1;
            begin = t;
        }
    }
};

}  // namespace

std::optional<PatrolRound> patrol_round(const Scenario& scenario, const Track& track) {
    const Patrol* patrol = patrol_of(scenario, track.name);
    if (!patrol || track.legs.empty()) return std::nullopt;
    const Time end = start_of_run + scenario.scenario.duration;
    RoundFollower follower{patrol->path, patrol->path.size() - 1};
    if (!follower.is_at_next(track.legs.front().from)) follower.next = 0;
    for (const Leg& leg : track.legs) {
        follower.pass(leg.from, leg.start);
        if (leg.end <= end) follower.pass(leg.to, leg.end);
    }
    return follower.last;
}

}  // namespace rovernet
