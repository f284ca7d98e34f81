// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/scenario.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace rovernet {

/// Point of a study: one combination of the values that it varies.
struct StudyPoint {
    Table settings;  ///< path -> value, in the order of [study] vary
    std::string id;  ///< id of the scenario that it stands for: 16 hexadecimal digits
};

/// The settings of every point: all combinations of the values that vary, those of the last key
/// first, with keys in `zip` going together and without those in `exclude`.
/// @throws InputError if that leaves none, makes more than a million, or a value is listed twice
std::vector<Table> study_points(const StudyTable& study, const Location& where);

/// "radio.power=15 dBm, robot.r.count=20"; "the scenario as it is" if nothing varies.
std::string settings_text(const Table& settings);

/// A study: a scenario file, the points at which it is run, and how often.
///
/// The id of a point is XXH64 over the resolved scenario (every default filled in; without [study]
/// but its warm-up, without [trace], and without the name and the replication), its walls and its
/// movement file: what changes a result changes the id. Replication r of every point has the same
/// keyed draws: runs of different points are paired.
class Study {
  public:
    /// Reads every point's scenario.
    /// @param vary     what varies, if not what the file says; nothing is zipped then
    /// @param exclude  points that are left out then
    /// @throws InputError at the first mistake, naming the point
    Study(const std::string& path, const ScenarioOptions& options,
          const std::optional<std::vector<Vary>>& vary = {},
          const std::vector<Exclusion>& exclude = {});

    const Scenario& base() const { return base_; }  ///< the file's own scenario
    const ScenarioOptions& options() const { return options_; }
    const StudyTable& table() const { return base_.study; }
    const std::vector<StudyPoint>& points() const { return points_; }

    /// Scenario of one run.
    Scenario scenario(std::size_t point, std::uint32_t replication);
    /// The resolved scenario that an id stands for.
    Table identity(const Scenario& scenario);

  private:
    struct Walls {
        std::shared_ptr<const Scene> scene;  ///< null: an open field
        std::string digest;
        /// Scenes with its doors closed: making them may take longer than a run.
        std::shared_ptr<const std::vector<SceneChange>> changes;
    };

    void check_points_differ() const;
    Scenario at(const Table& settings);
    const Walls& walls(const Scenario& scenario);

    ScenarioOptions options_;
    ScenarioFile file_;
    Scenario base_;
    std::vector<StudyPoint> points_;
    std::map<std::string, Walls> walls_;  // walls by the text of [scene]: a map is read once
};

/// Id of one run: XXH64 over the point's id, the replication and the version.
std::string run_id(const std::string& point_id, std::uint32_t replication,
                   const std::string& version);

}  // namespace rovernet
