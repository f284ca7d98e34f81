// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/viewer/frame_columns.hpp"
#include "pictures/viewer/view_comparison.hpp"

#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace rovernet {

class RecordedIndex;
struct Scenario;

/// Choice of the content of a view file.
struct ViewChoice {
    FrameChoice frames = {};
    bool map = true;    ///< true: the file contains walls, doors and stairs, and reasons with walls
    bool packs = true;  ///< whether the columns are compressed
    /// Largest size of the view file [bytes]: later frames are left out. Robots, legs and messages
    /// are always complete, so that a file without frames may be larger.
    std::size_t most_bytes = std::numeric_limits<std::size_t>::max();
    /// Sentences about data that the trace lacks, for the page.
    std::vector<std::string> missing = {};
    /// Comparison with the run that is shown beside this one; null: none.
    const ViewComparison* comparison = nullptr;
};

/// View file of a run, and its size.
struct ViewedRun {
    std::string name;   ///< name of the scenario
    std::string bytes;  ///< content of the view file, see docs/formats/view-format.md
    std::size_t robots, messages;
    std::size_t frames;                 ///< number of frames in the file
    std::vector<std::string> left_out;  ///< sentences about data that the file does not contain
    std::vector<std::string> damage;    ///< sentences about broken or missing parts of the trace
    std::vector<MessageName> message_names = {};  ///< messages, by their index in the file
    /// Index of the trace; null if the trace is damaged.
    std::shared_ptr<const RecordedIndex> index = nullptr;
};

/// Checks that a page can show the times of a scenario: the duration is at most 2^53 - 1 ns, about
/// 104 days.
/// @param path  file of the scenario or of its trace
/// @throws InputError if the duration is longer
void check_viewable(const Scenario& scenario, const std::string& path);

/// Makes a view file of a recorded trace.
/// @param path  recorded trace with a scenario
/// @throws InputError if the file is no recorded trace, its scenario cannot be loaded, or the run
/// is
///         too long for a page (check_viewable)
ViewedRun view_of_trace(const std::string& path, const ViewChoice& choice);

}  // namespace rovernet
