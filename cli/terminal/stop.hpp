// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/output.hpp"

#include <vector>

namespace rovernet::cli {

/// Installs handlers by which Ctrl-C (SIGINT), SIGTERM and SIGHUP immediately end the programs that
/// this process has started, and the process with exit code 130. If SIGHUP was ignored before (by
/// nohup, say), it is still ignored.
void end_on_signals();

/// Guard that defers stop signals (Ctrl-C, SIGTERM) during its lifetime: signals are only counted,
/// so that a command can finish or clean up. The fifth signal ends the process nevertheless.
class HeldStop {
  public:
    HeldStop();
    ~HeldStop();
    HeldStop(const HeldStop&) = delete;
    HeldStop& operator=(const HeldStop&) = delete;
};

/// Writes files while stop signals (Ctrl-C, SIGTERM) are deferred, so that no file is incomplete.
/// @throws RunError as write_files()
void write_whole(const std::vector<OutputFile>& files);

/// Number of stop signals (Ctrl-C, SIGTERM) that were received while a HeldStop deferred them.
int stops_asked();

}  // namespace rovernet::cli
