// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/scenario.hpp"
#include "traces/recorded/recorded_reader.hpp"

#include <string>
#include <vector>

// The scenario inside a recorded trace: how it is stored, and how it is taken out again.

namespace rovernet {

/// Scenario as it goes into a recorded trace.
struct RecordedScenario {
    /// TOML with every default. Attached files are named as they are attached, such as
    /// map/office.yaml; others as from the folder of the trace.
    std::string text;
    /// Its map with the picture, and its movement file, unless they are larger than 64 MB. The
    /// files of a Stage world are not among them.
    std::vector<AttachedFile> files;
};
/// @param folder  of the trace
RecordedScenario recorded_scenario(const Scenario& scenario, const std::string& folder);

/// Scenario that was recorded, in a temporary folder with the files that were attached. It has to
/// live as long as what is run of it.
class ReplayedScenario {
  public:
    /// @param path  of the trace, for errors, and for files that were not attached
    /// @throws InputError if there is none, it is no TOML, or a file that it names is broken or
    ///         cannot be unpacked
    ReplayedScenario(const RecordedRun& run, const std::string& path);

    /// Scenario with its map loaded, and these assignments "path=value" over it, see set_option().
    /// @throws InputError for what is wrong with it
    Scenario with(const std::vector<std::string>& set) const;

  private:
    /// A folder for this process alone, gone with its object.
    struct Folder {
        Folder();
        Folder(const Folder&) = delete;
        ~Folder();
        std::string path;
    };

    /// Name of a file of the scenario, as from its folder.
    std::string find_file(const RecordedRun& run, const std::string& name) const;

    std::string trace_;  // its path
    Folder folder_;      // folder of the attached files
    std::string file_;   // path of the scenario in it
};

/// Checks that a trace names the robots of the scenario inside, in their order: robots of records
/// are found by these names. @param path  of the trace. @throws InputError if they differ
void check_robots(const RecordedRun& run, const Scenario& scenario, const std::string& path);

}  // namespace rovernet
