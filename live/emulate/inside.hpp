// SPDX-License-Identifier: MIT
#pragma once

#include "live/emulate/robot_network.hpp"

#include <string>
#include <vector>

namespace rovernet {

/// End of a program that ran with the network of a robot.
struct ProgramEnd {
    int status;         ///< as waitpid() gives it
    bool run_ended_it;  ///< it went on when the run ended, and was ended then
};

/// Runs a program with the network of a robot, and waits for its end. Signals to this process are
/// passed on to it; those of the terminal reach it by themselves.
///
/// When the run ends, however that happens, so do the program and whatever it has started: they
/// have no network any more (end_processes). The keeper of the run says so; if it cannot, as it was
/// killed, the connection breaks, and this process ends them.
/// @param words  of the program, at least one
/// @throws RunError if it cannot be started
ProgramEnd run_inside(const RobotNetwork& network, const std::vector<std::string>& words);

/// Ends this process as a program has ended: with its exit code, or by its signal.
[[noreturn]] void end_like(int status);

}  // namespace rovernet
