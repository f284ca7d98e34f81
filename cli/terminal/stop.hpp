// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/output.hpp"

#include <vector>

namespace rovernet::cli {

/// Lets Ctrl-C (SIGINT), SIGTERM and SIGHUP end the process at once from now on, with exit code
/// 130 and with the programs that it has started. SIGHUP does nothing where it is ignored already,
/// as by nohup.
void end_on_signals();

/// While one of these lives, signals to stop are counted only, for a command that has something to
/// finish or to put away; the fifth ends the process all the same.
class HeldStop {
  public:
    HeldStop();
    ~HeldStop();
    HeldStop(const HeldStop&) = delete;
    HeldStop& operator=(const HeldStop&) = delete;
};

/// Writes files with the stop held: none is written by half.
/// @throws RunError as write_files()
void write_whole(const std::vector<OutputFile>& files);

/// Number of times that the process was asked to stop while that was held.
int stops_asked();

}  // namespace rovernet::cli
