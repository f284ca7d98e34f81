// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/playing.hpp"
#include "models/propagation/rays.hpp"
#include "models/radio.hpp"
#include "scenario/document/value.hpp"
#include "scene/scene.hpp"
#include "sim/ids.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace rovernet {

class Network;
struct Scenario;

/// Report of the state of the radio link from one robot to another robot at a given time.
struct LinkReport {
    std::string from, to, model;
    Time at;
    double distance_m;
    std::vector<Wall> walls;
    std::vector<std::string> materials;  ///< name of the material of each wall on the link
    /// Loss of each wall [dB], included in the path loss; empty if the model has no loss of single
    /// walls.
    std::vector<Db> wall_losses;
    bool ignores_walls;  ///< true if there are walls, but the path loss is the same without walls
    double wall_m;
    /// Number of ceilings between the two antennas, in a scene with several storeys.
    std::size_t ceilings;
    Db ceiling_loss;  ///< loss of all ceilings on the link [dB], included in the path loss
    /// Number of floors between the two antennas that the propagation model counts. Ceilings that
    /// have a loss of their own are not included.
    std::size_t floors;
    Db floor_loss;  ///< loss of the counted floors [dB], included in the path loss
    Radio sender, receiver;
    Db path_loss;                 ///< total path loss [dB], including walls and shadowing
    std::optional<Db> shadowing;  ///< shadowing [dB], included in the path loss; none: no shadowing
    /// Gain of the sender's antenna pattern towards the receiver, and of the receiver's antenna
    /// pattern towards the sender [dB], <= 0, relative to Radio::antenna_gain.
    Db sender_pattern, receiver_pattern;
    Dbm received;
    Db margin;
    bool up;               ///< true if the received level suffices and both robots are on
    std::string why_down;  ///< reason why the link is down: "B is off"; empty if the link is up
    std::optional<Rays::Paths> rays;  ///< propagation paths (rays), if the model is `rays`
    /// Range [m] of the propagation model, if the model is disc. This model gives no levels, so
    /// that all values in dB are meaningless. None: another model.
    std::optional<Meters> range;
};

/// Runs the scenario until the time `at`, then reports the link from robot `from` to robot `to`. If
/// no robot has reactions, only `from`, `to` and the robots that these two follow move, to save
/// computing time.
/// @throws std::invalid_argument if a robot does not exist, or if both are the same robot
LinkReport report_link(const Scenario& scenario, const std::string& from, const std::string& to,
                       Time at, const TellTime& tell = {});

/// Reports the link from robot `from` to robot `to` at the present time of a network.
/// @throws std::invalid_argument if both are the same robot
LinkReport report_link(const Network& network, NodeId from, NodeId to);

/// Term of a link budget: gain (positive) or loss (negative) on the way from the sender to the
/// receiver [dB].
struct BudgetTerm {
    std::string what;  ///< "sender's antenna gain", "path loss", ...
    double change;
};

/// Terms of a link's budget, from the sender to the receiver. The sender's power and all changes
/// add up to the received level.
/// @param by_wall  true: each wall, the ceilings and the floors have terms of their own, beside the
///                 rest of the path loss
std::vector<BudgetTerm> budget_terms(const LinkReport& report, bool by_wall);

/// Link report as a document, the output of `rovernet link --json`.
Table link_document(const LinkReport& report);

}  // namespace rovernet
