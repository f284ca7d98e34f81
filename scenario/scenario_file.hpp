// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"

#include <memory>
#include <string>
#include <vector>

namespace rovernet {

struct Scenario;
struct WorldFile;

/// Options of the command line that change a scenario file.
struct ScenarioOptions {
    /// Values of the option --set: assignments "path=value", see set_option().
    std::vector<std::string> set = {};
    /// Values of the option --world-path: folders in which includes and bitmaps of a Stage world
    /// are searched, relative to the current folder.
    std::vector<std::string> world_path = {};
    /// Values of the option --bitmap: replacements "OLD=NEW". The file NEW is read wherever the
    /// Stage world names the bitmap OLD.
    std::vector<std::string> bitmaps = {};
    /// Option --lenient. True: a missing include or bitmap of a Stage world causes only a notice.
    /// False: it causes an error.
    bool lenient = false;
    /// True if a scenario without robots is an error. False for pictures of a map, which need no
    /// robots.
    bool needs_robots = true;
};

/// Input file of a scenario, overridden by options of the command line. The file is a scenario
/// file, a Stage world (NAME.world) or a movement file. The file is read once. A study makes a
/// Scenario from a ScenarioFile for each combination of varied values.
/// Example: examples/parameters.cpp.
class ScenarioFile {
  public:
    /// @param path  file; "-": a scenario from standard input, whose paths are relative to the
    ///              current folder
    /// @throws InputError if the file is no scenario; the message names the kind of file and the
    ///         remedy
    ScenarioFile(const std::string& path, const ScenarioOptions& options);
    /// Makes a ScenarioFile of a document that was made in code.
    /// @param path  file that the document replaces: paths in the document are relative to its
    ///              folder; empty: to the current folder
    /// @throws InputError if the document is no table, or its Stage world is wrong
    ScenarioFile(Value document, const std::string& path, const ScenarioOptions& options);

    /// Scenario of the file (see scenario.hpp), overridden by `settings` (values by the path of
    /// their key, as for --set).
    /// @throws InputError at the first mistake; at the position of the setting if a setting is
    /// wrong
    Scenario scenario(const Table& settings = {}) const;

  private:
    std::string path_;  // of the file, as the user typed it
    // Options of the command line, without --set of keys of [scene]: these are in the documents.
    ScenarioOptions options_;
    // Document of the file; and with the robots of the Stage world and all options.
    Value without_world_, document_;
    // Notices to the user about the Stage world.
    std::vector<std::string> notices_;
    std::shared_ptr<const WorldFile> world_;  // Stage world; null unless [scene] names a world
};

/// Loads the scenario of ScenarioFile(path, options) with its map, and adds notices about unlikely
/// values, such as a robot that starts off the map. Used by commands that need one scenario.
/// @throws InputError as ScenarioFile, and if the map is invalid
Scenario load_scenario(const std::string& path, const ScenarioOptions& options);
/// Loads the scenario of a file that was read before, with its map, and adds notices about unlikely
/// values, such as a robot that starts off the map.
/// @param settings  values by path, see ScenarioFile::scenario()
Scenario load_scenario(const ScenarioFile& file, const Table& settings = {});

}  // namespace rovernet
