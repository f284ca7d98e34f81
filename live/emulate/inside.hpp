// SPDX-License-Identifier: MIT
#pragma once

#include "live/emulate/robot_network.hpp"

#include <string>
#include <vector>

namespace rovernet {

/// Result of a program that ran in the network of a robot.
struct ProgramEnd {
    int status;         ///< exit status of the program, from waitpid()
    bool run_ended_it;  ///< true: the program was still running when the run ended, and was killed
};

/// Runs a program in the network of a robot, and waits for its end. Signals to this process are
/// forwarded to the program. Signals from the terminal reach the program directly.
///
/// When the run ends for any reason, this process ends the program and the program's descendants,
/// since their network no longer exists (end_processes). The keeper, the process that owns the
/// networks of the run, reports the end by a message. If the keeper was killed, this process
/// detects the broken connection.
/// @param words  command line of the program, at least one word
/// @throws RunError if the program cannot be started
ProgramEnd run_inside(const RobotNetwork& network, const std::vector<std::string>& words);

/// Ends this process with the exit code, or by the signal, of another program that has ended.
/// @param status  status of that program, from waitpid()
[[noreturn]] void end_like(int status);

}  // namespace rovernet
