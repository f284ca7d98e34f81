// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/scenario.hpp"
#include "scenario/document/value.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

// Candidates of `rovernet advise`: the models that could take the place of the reference, each with
// the parameters that suit the scenario best.

namespace rovernet {

/// What a user asks: which models may be candidates, and what they are judged against.
struct CandidateQuestion {
    /// Propagation models; if empty, on a map those that are listed before the reference, on an
    /// open field those that need no map.
    std::vector<std::string> models;
    /// Assignments "propagation.KEY=VALUE" and "reception.KEY=VALUE" over the reference.
    std::vector<std::string> reference;
    bool as_given = false;  ///< with the parameters of the file, not fitted ones
};

/// Model as a candidate.
struct CandidateModel {
    std::string name;    ///< "log_distance"; "rays order=1" for a cheaper form of the reference
    std::string model;   ///< as listed
    Table table;         ///< [propagation] or [reception] of a scenario file, as a whole
    std::string fitted;  ///< "exponent 2.91, excess 3.2 dB"; empty: as given
    std::string note;    ///< why it was not fitted, if it should have been
};

/// Candidates and reference as a grid of path losses and receptions, each in the order of their
/// detail with the reference last. Access stays as it is: it is what robots do, no model of it.
struct AdviceCandidates {
    std::vector<CandidateModel> path_losses, receptions;
    /// Points of the study by path loss and reception; none for two that do not go together, such
    /// as a disc, which has no levels, and the reception `sinr`.
    std::vector<std::vector<std::optional<std::uint32_t>>> points;
    /// Models that no reception goes with, and why.
    std::vector<std::string> left_out;
    bool on_map = false;

    std::size_t reference_path_loss() const { return path_losses.size() - 1; }
    std::size_t reference_reception() const { return receptions.size() - 1; }
    /// The most detailed reception that a path loss goes with: mostly the reference's.
    std::size_t reception_of(std::size_t path_loss) const;
    /// Number of combinations that could be judged: all points but the reference. Any of them may
    /// become the choice, so that the probability of a false verdict is shared among all of them.
    std::size_t family() const;
    /// "log_distance + sinr"
    std::string name_of(std::size_t path_loss, std::size_t reception) const;

    /// What a study over them varies, and leaves out.
    std::vector<Vary> vary() const;
    std::vector<Exclusion> exclude() const;
};

/// Candidates for a scenario. The reference is the model `rays` (order 3, diffraction utd) on a
/// map, or the most detailed listed model if there is no such; two_ray (form exact) on an open
/// field; with the reception `sinr`. Free parameters of the others are fitted to it, see
/// calibrate_to_model().
/// @param tell  told the share of the fit that is done, 0 ... 1; may be empty
/// @throws InputError for the file; at an option for an unknown model, or a reference that the
///         scenario cannot have
AdviceCandidates candidates_for(const std::string& file, const ScenarioOptions& options,
                                const CandidateQuestion& question,
                                const std::function<void(double)>& tell = {});

}  // namespace rovernet
