// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

namespace rovernet {

/// Door of a robot's namespace: the abstract Unix socket "rovernet/PID/ROBOT", where PID is the
/// process of the run. It has no file, and goes with its process.
///
/// Anybody may take any such name. So whoever comes in by a door asks for the user behind it
/// (user_behind), and whoever waits there asks for the user who comes. Where a name is taken, the
/// door is at "rovernet/PID.NUMBER/ROBOT".
struct RobotDoor {
    pid_t run;
    std::string mark;  ///< what stands behind PID: "" or ".NUMBER"
    std::string robot;

    /// @throws RunError for a name that is too long
    int listen() const;
    /// Comes in. @return the socket; nothing if nobody is there; -1 if too many wait there
    std::optional<int> enter() const;

    friend auto operator<=>(const RobotDoor&, const RobotDoor&) = default;
};

/// Opens the door of a robot. @return the socket at which who comes in is accepted
/// @throws RunError
int open_door(pid_t run, const std::string& robot);

/// Doors of all runs on this machine, whoever has opened them.
std::vector<RobotDoor> all_doors();

/// User at the other end of a socket, as the kernel says: of an accepted one who comes, of a
/// connected one who listens there.
std::optional<uid_t> user_behind(int socket);

/// Name of a user, for people: "alice (1000)".
std::string user_name(uid_t user);

}  // namespace rovernet
