// SPDX-License-Identifier: MIT
#pragma once

#include "sim/legs.hpp"
#include "sim/time.hpp"

#include <span>
#include <string>
#include <vector>

namespace rovernet {

/// What a robot did: its legs in order, each from where and when the one before ended.
struct Track {
    std::string name;
    std::vector<Leg> legs;
};

/// The tracks until `end` as an ns-2 movement file; node_(i) is the i-th track, in the order of
/// time. ns-2 replays it to within 1 cm.
std::string setdest_text(std::span<const Track> tracks, Time end);

/// The tracks until `end` as BonnMotion's .movements: a line per track, "time x y" for each place,
/// with z if some track leaves z = 0.
std::string bonnmotion_text(std::span<const Track> tracks, Time end);
/// The .params that go with it.
std::string bonnmotion_params(std::span<const Track> tracks, Time end);

}  // namespace rovernet
