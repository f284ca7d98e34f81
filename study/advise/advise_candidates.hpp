// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"
#include "scenario/scenario.hpp"
#include "scenario/scenario_file.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

// Candidates of `rovernet advise`: models that may replace the reference, each with parameters
// fitted to the scenario.

namespace rovernet {

/// Request of a user to `rovernet advise`: models that may be candidates, and changes of the
/// reference.
struct CandidateQuestion {
    /// Names of models to compare with the reference: "friis", or with changed parameters as in
    /// CandidateModel::name. If empty on a map: all models less detailed than the reference
    /// (earlier in the list of models). If empty on an open field: all models that need no map.
    std::vector<std::string> models;
    /// Assignments "propagation.KEY=VALUE" and "reception.KEY=VALUE" that change the reference.
    std::vector<std::string> reference;
    /// True: candidates have the parameters of the scenario file instead of fitted ones.
    bool as_given = false;
};

/// Propagation or reception model that is a candidate.
struct CandidateModel {
    /// Name of the candidate, such as "log_distance". If the candidate is a cheaper form of the
    /// reference, the name includes the changed keys: "rays order=1 diffraction=none".
    std::string name;
    std::string model;  ///< name of the model in the list of models
    Table table;        ///< complete table [propagation] or [reception] of a scenario file
    /// Text of fitted parameters, such as "exponent 2.91, excess 3.2 dB"; empty: no parameter is
    /// fitted.
    std::string fitted;
    std::string note;  ///< reason why the fit failed; empty: no failure
};

/// Candidates and reference as a grid of path losses and receptions, each in the order of detail
/// with the reference last. The access protocol is not varied, because it is a property of the
/// simulated robots and not a degree of model detail.
struct AdviceCandidates {
    std::vector<CandidateModel> path_losses, receptions;
    /// Number of the study point for each pair of path loss and reception model, as [path
    /// loss][reception]. None for incompatible models, such as `disc` (which has no levels) with
    /// the reception `sinr`.
    std::vector<std::vector<std::optional<std::uint32_t>>> points;
    /// Path loss models that are incompatible with every reception model, as texts
    /// "NAME: REASON".
    std::vector<std::string> left_out;
    bool on_map = false;

    std::size_t reference_path_loss() const { return path_losses.size() - 1; }
    std::size_t reference_reception() const { return receptions.size() - 1; }
    /// Most detailed reception model that is compatible with a path loss model, as an index; mostly
    /// the reception model of the reference.
    std::size_t reception_of(std::size_t path_loss) const;
    /// Number of pairs of models that may be compared: all pairs except the reference. The
    /// probability of a false verdict is divided among these pairs, since any pair may be chosen.
    std::size_t family() const;
    /// Name of a pair of models: "log_distance + sinr".
    std::string name_of(std::size_t path_loss, std::size_t reception) const;

    /// Varied keys of a study over all pairs of path loss and reception.
    std::vector<Vary> vary() const;
    /// Pairs of incompatible models, which a study over all pairs must skip.
    std::vector<Exclusion> exclude() const;
};

/// Candidates for a scenario. Unless `question` changes the reference, the reference has the
/// reception `sinr` and this path loss: on a map `rays` (order 3, diffraction utd), on a map of
/// several storeys `multi_wall`, on an open field `two_ray` (form exact). Free parameters of the
/// other models are fitted to the reference, see calibrate_to_model().
/// @param tell  called with the finished share of the fit, 0 ... 1; may be empty
/// @throws InputError if the file is invalid, if an option names an unknown model, or if the
///         reference is invalid in the scenario
AdviceCandidates candidates_for(const std::string& file, const ScenarioOptions& options,
                                const CandidateQuestion& question,
                                const std::function<void(double)>& tell = {});

}  // namespace rovernet
