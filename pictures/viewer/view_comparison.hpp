// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/replay/run_comparison.hpp"
#include "pictures/viewer/frame_columns.hpp"
#include "scenario/document/value.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace rovernet {

class ViewFile;

/// Comparison of two runs, for the view file of the second run.
struct ViewComparison {
    std::array<std::string, 2> names;  ///< names of the runs, as the page shows them
    RunComparison result;
    /// Identities of the messages in the first run's view file, by index.
    std::vector<MessageName> messages = {};
};

/// Writes the columns `compare`, and the entry of the head that describes them.
/// @param messages  messages in this view file, by index
/// @param robots    number of robots
void write_comparison(const ViewComparison& comparison, const std::vector<MessageName>& messages,
                      std::size_t robots, ViewFile& file, Table& head);

}  // namespace rovernet
