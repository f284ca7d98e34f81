// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/scenario.hpp"
#include "scenario/scenario_file.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace rovernet {

/// Point of a study: one combination of values of the varied keys.
struct StudyPoint {
    Table settings;  ///< value of each varied key, by path, in the order of [study] vary
    std::string id;  ///< id of the point's scenario: 16 hexadecimal digits
};

/// Settings of every point of a study: all combinations of the varied values. The last key varies
/// fastest, and keys of a `zip` group vary together. Combinations in `exclude` are skipped.
/// @throws InputError if there is no point or more than a million, or if a value is listed twice
std::vector<Table> study_points(const StudyTable& study, const Location& where);

/// Text of the settings of a point, such as "radio.power=15 dBm, robot.r.count=20"; "the scenario
/// as it is" if there are no settings.
std::string settings_text(const Table& settings);

/// Study: a scenario file, the points at which it is run, and the number of replications.
///
/// The id of a point is an XXH64 hash of everything that affects results: the resolved scenario
/// (with all defaults; without [trace], name, replication, and [study] except its warm-up), its
/// walls and its movement file. Replication r uses the same random draws at every point, so that
/// runs of different points are paired.
class Study {
  public:
    /// Reads the scenario of every point of the study.
    /// @param vary     varied keys; they replace [study] vary, zip and exclude of the file
    /// @param exclude  combinations of values to skip, if `vary` is given
    /// @throws InputError at the first mistake; the message names the point of the study
    Study(const std::string& path, const ScenarioOptions& options,
          const std::optional<std::vector<Vary>>& vary = {},
          const std::vector<Exclusion>& exclude = {});

    /// Whether the scene of any point has walls, so that robots need path planning.
    bool has_walls() const;
    /// Scenario of the file, without the settings of any point of the study.
    const Scenario& base() const { return base_; }
    const ScenarioOptions& options() const { return options_; }
    const StudyTable& table() const { return base_.study; }
    const std::vector<StudyPoint>& points() const { return points_; }

    /// Scenario of one run of the study.
    Scenario scenario(std::size_t point, std::uint32_t replication);
    /// Resolved scenario, from which the id of a point of the study is computed as a hash.
    Table identity(const Scenario& scenario);

  private:
    struct Walls {
        std::shared_ptr<const Scene> scene;  ///< scene of the point; null: an open field
        std::string digest;
        /// Changes of the scene by doors that open or close. They are cached, since computing the
        /// changed scenes may take longer than a run.
        std::shared_ptr<const std::vector<SceneChange>> changes;
    };

    void check_points_differ() const;
    Scenario at(const Table& settings);
    const Walls& walls(const Scenario& scenario);

    ScenarioOptions options_;
    ScenarioFile file_;
    Scenario base_;
    std::vector<StudyPoint> points_;
    // Walls of points, by the text of their table [scene], so that each map is read only once.
    std::map<std::string, Walls> walls_;
};

/// Id of a run: XXH64 hash of the point's id, the replication and the version of the code.
std::string run_id(const std::string& point_id, std::uint32_t replication,
                   const std::string& version);

}  // namespace rovernet
