// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/output.hpp"

#include <vector>

namespace rovernet::cli {

/// Makes Ctrl-C (SIGINT), SIGTERM and SIGHUP end the process and the programs that it has started
/// at once, with exit code 130. SIGHUP stays ignored if it was ignored before, as by nohup.
void end_on_signals();

/// Guard that defers stop signals (Ctrl-C, SIGTERM) during its lifetime: they are only counted, so
/// that a command can finish or clean up. The fifth signal ends the process nevertheless.
class HeldStop {
  public:
    HeldStop();
    ~HeldStop();
    HeldStop(const HeldStop&) = delete;
    HeldStop& operator=(const HeldStop&) = delete;
};

/// Writes files with stop signals deferred, so that no file is written partly.
/// @throws RunError as write_files()
void write_whole(const std::vector<OutputFile>& files);

/// Number of stop signals received while a HeldStop deferred them.
int stops_asked();

}  // namespace rovernet::cli
