// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/propagation.hpp"
#include "scenario/scenario.hpp"

#include <string>
#include <string_view>
#include <vector>

// Notices about values that are valid but unlikely. A notice changes no result: the command prints
// it on standard error.

namespace rovernet {

/// Adds notices about valid but unlikely values of radios, switching times, payloads and message
/// starts: a power of 20 W, a frequency of 2.45 MHz, a bit rate that the standard lacks, a robot
/// switched on while it is on, a payload "64 B", robots that transmit at the same instants so that
/// their frames collide.
/// @throws InputError for a sensitivity above 0 dBm, surely a mistake: such a receiver receives
/// nothing
void note_unlikely(Scenario& scenario);

/// Whether the routing protocol gets messages of a flow: the flow starts during the run, and its
/// messages are not bound to one hop.
bool is_for_protocol(const Scenario& scenario, const TrafficTable& flow);

/// Sentence about a frequency that robots' radios do not use, with a suggestion; empty for any
/// other frequency.
std::string unlikely_frequency(Hertz frequency);

/// Adds notices about robots that start off the map, or in a wall of a Stage world. A start in a
/// wall of a map is an error, which is reported when the network is built.
/// @param scene  scene of the scenario; null: an open field
void note_places(Scenario& scenario, const Scene* scene);

/// Adds a notice about antennas whose height puts them in another storey than their robots.
/// @param scene  scene of the scenario; null: an open field
void note_antennas(Scenario& scenario, const Scene* scene);

/// Adds a notice if [study] varies [propagation] and some robots have a propagation model of their
/// own, since the study does not change the models of these robots.
void note_own_models(Scenario& scenario);

/// Checks that the propagation model is not disc. Used by commands that compare received power
/// levels, since disc gives no levels.
/// @param who  name of the command or method, for the error message
/// @throws InputError if the model is disc
void refuse_disc(const Propagation& model, const Location& where, std::string_view who);

/// Adds a notice to the list, unless the list has it already.
void add_notice(std::vector<std::string>& notices, std::string notice);

}  // namespace rovernet
