// SPDX-License-Identifier: MIT
#pragma once

#include "files/temporary_directory.hpp"
#include "scenario/scenario.hpp"
#include "traces/recorded/recorded_reader.hpp"

#include <string>
#include <vector>

// Storing a scenario in a recorded trace, and loading a scenario from a recorded trace.

namespace rovernet {

/// Scenario in the form in which a recorded trace stores it.
struct RecordedScenario {
    /// Scenario as TOML text, with every default. An attached file is named by its path as
    /// attachment, such as map/office.yaml. Other paths are relative to the folder of the trace.
    std::string text;
    /// Attached files: the map with its picture and the movement file, unless they are larger than
    /// 64 MB. Files of a Stage world are not attached.
    std::vector<AttachedFile> files;
    /// Digest of the walls of a Stage world, see wall_digest(); "none": a world without walls;
    /// empty: no world.
    std::string walls = {};
};
/// Converts a scenario to the form in which a recorded trace stores it.
/// @param folder  folder of the trace
RecordedScenario recorded_scenario(const Scenario& scenario, const std::string& folder);

/// Scenario of a recorded trace. The scenario and its attached files are unpacked into a temporary
/// folder. This object must outlive the runs of the scenario.
class ReplayedScenario {
  public:
    /// @param path  path of the trace, for errors, and to find files that are not attached
    /// @throws InputError if the trace has no scenario, the scenario is no TOML, or one of its
    ///         files is broken or cannot be unpacked
    ReplayedScenario(const RecordedRun& run, const std::string& path);

    /// Scenario with its map loaded, overridden by assignments "path=value", see set_option().
    /// @throws InputError if the scenario is invalid, or if the walls of its Stage world have
    ///         changed since the run was recorded, unless an assignment changes the scene
    Scenario with(const std::vector<std::string>& set) const;

  private:
    /// Path of a file that the scenario names. If the file is attached to the trace, the path is
    /// relative to the temporary folder. Otherwise it is the absolute path of a file beside the
    /// trace.
    std::string find_file(const RecordedRun& run, const std::string& name) const;

    void check_walls(const Scenario& scenario) const;

    std::string trace_;          // path of the trace
    std::string walls_;          // digest of the walls of the recorded run; empty: not known
    TemporaryDirectory folder_;  // folder of the attached files
    std::string file_;           // path of the scenario file in folder_
};

/// Checks that the robots listed in a trace are the robots of its scenario, in the same order,
/// since records identify robots by their index in this order.
/// @param path  path of the trace, for the error message
/// @throws InputError if the robots differ
void check_robots(const RecordedRun& run, const Scenario& scenario, const std::string& path);

}  // namespace rovernet
