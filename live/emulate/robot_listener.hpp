// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

namespace rovernet {

/// Listener for a robot's namespace: the abstract Unix socket "rovernet/PID/ROBOT", where PID is
/// the process id of the run. The socket has no file, and vanishes with its process.
///
/// Any user may bind any such name. Therefore client and server check the user of the peer
/// (user_behind). If the name is taken, the listener is at "rovernet/PID.NUMBER/ROBOT".
struct RobotListener {
    pid_t run;
    std::string mark;  ///< suffix of PID in the socket's name: "" or ".NUMBER"
    std::string robot;

    /// Opens the socket of the listener. @throws RunError for a name that is too long
    int listen() const;
    /// Connects to the listener. @return the socket; none if no process listens; -1 if the
    /// listener's queue is full
    std::optional<int> connect_to() const;

    friend auto operator<=>(const RobotListener&, const RobotListener&) = default;
};

/// Opens the listener of a robot. @return the listening socket
/// @throws RunError
int open_listener(pid_t run, const std::string& robot);

/// Listeners of robots of all runs on this machine, of any user.
std::vector<RobotListener> all_listeners();

/// User of the peer process of a socket, from the kernel: user of the client if the socket was
/// accepted, user of the server if the socket has connected to it.
std::optional<uid_t> user_behind(int socket);

/// Name of a user for messages: "alice (1000)".
std::string user_name(uid_t user);

}  // namespace rovernet
