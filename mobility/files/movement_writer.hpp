// SPDX-License-Identifier: MIT
#pragma once

#include "sim/legs.hpp"
#include "sim/time.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace rovernet {

/// Track of a robot: its legs (pieces of movement) in order; each leg starts where the previous leg
/// ended. The robot rests between legs and after the last leg. A leg that starts elsewhere is a
/// jump. A leg that starts before the end of the previous leg ends that leg.
struct Track {
    std::string name;
    std::vector<Leg> legs;
};

/// Numbers of the nodes of tracks in an ns-2 movement file. If all names are like those of nodes in
/// a file that was read ("n5" for node_(5)), the nodes keep their numbers. Otherwise the numbers
/// are 0, 1, ..., in the order of the tracks.
std::vector<std::uint32_t> node_numbers(std::span<const Track> tracks);

/// Text of an ns-2 movement file with the tracks until `end`, in the order of time. node_numbers()
/// gives the number of each node; for each track whose name differs from it, a comment at the start
/// has the name: "# flow.0 -> $node_(0)". ns-2 replays the file to within 1 cm, in the plane; z is
/// constant. Each leg ends at its real end, even if the next leg interrupted it, so a rest needs no
/// line. A jump is written as a stop and scheduled positions. ns-2 refuses targets with x or y <= 0
/// or beyond its field; comments at the start give the field that the tracks need.
/// @throws std::invalid_argument if a track has no leg, or if `end` is never and a track never
///         stops
std::string setdest_text(std::span<const Track> tracks, Time end);

/// Text of a BonnMotion .movements file with the tracks until `end`: one line per track, with "time
/// x y" for each position, or "time x y z" if any track leaves z = 0. Times are exact; positions to
/// 5e-10 m. A jump takes 1 ns.
/// @throws std::invalid_argument as setdest_text()
std::string bonnmotion_text(std::span<const Track> tracks, Time end);
/// Content of the file NAME.params for bonnmotion_text().
/// @throws std::invalid_argument as setdest_text()
std::string bonnmotion_params(std::span<const Track> tracks, Time end);

}  // namespace rovernet
