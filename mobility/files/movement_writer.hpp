// SPDX-License-Identifier: MIT
#pragma once

#include "sim/legs.hpp"
#include "sim/time.hpp"

#include <span>
#include <string>
#include <vector>

namespace rovernet {

/// Track of a robot: its legs in order, each from where the one before ended. It rests in the time
/// between two legs and after the last. A leg that starts elsewhere is a jump; one that starts
/// before the end of the one before ends that.
struct Track {
    std::string name;
    std::vector<Leg> legs;
};

/// The tracks until `end` as an ns-2 movement file; node_(i) is the i-th track, in the order of
/// time. ns-2 replays it to within 1 cm, in the plane: z stays as at the start. Each leg goes to
/// where it really ended, also one that another interrupted, so a rest needs no line. A jump is a
/// stop and scheduled places. ns-2 refuses targets with x or y <= 0 or beyond its field; comments
/// at the begin say what the tracks need.
/// @throws std::invalid_argument if a track has no leg, or `end` is never and one never ends moving
std::string setdest_text(std::span<const Track> tracks, Time end);

/// The tracks until `end` as BonnMotion's .movements: a line per track, "time x y" for each place,
/// with z if some track leaves z = 0. Times are exact; places to 5e-10 m. A jump takes 1 ns.
/// @throws std::invalid_argument as setdest_text()
std::string bonnmotion_text(std::span<const Track> tracks, Time end);
/// The file NAME.params that goes with bonnmotion_text().
/// @throws std::invalid_argument as setdest_text()
std::string bonnmotion_params(std::span<const Track> tracks, Time end);

}  // namespace rovernet
