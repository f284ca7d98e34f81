// SPDX-License-Identifier: MIT
#pragma once

#include "live/emulate/tap.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

namespace rovernet {

/// Network namespaces, one for each robot, with its TAP device in it. A user who may not make them
/// gets a user namespace around them, in which that is allowed.
///
/// They belong to a process of their own, the keeper, so that this one stays where it is. The
/// keeper hands a namespace to every process that asks (enter_namespace) at the abstract Unix
/// socket "rovernet/PID/ROBOT", where PID is this process; the system decides who may enter. The
/// keeper ends when this process does, however that ends: then nothing is left but programs that
/// still run in a namespace.
class Namespaces {
  public:
    /// @throws RunError if namespaces or devices cannot be made
    explicit Namespaces(std::vector<RobotDevice> robots);
    ~Namespaces();
    Namespaces(const Namespaces&) = delete;
    Namespaces& operator=(const Namespaces&) = delete;

    const std::vector<RobotDevice>& robots() const { return robots_; }
    /// Descriptor of a robot's TAP device, which the caller then owns.
    int take_device(std::size_t robot);

  private:
    void receive_devices();
    void end();

    std::vector<RobotDevice> robots_;
    std::vector<int> devices_;  // -1: taken
    int keeper_socket_ = -1;
    pid_t keeper_ = -1;
};

/// Moves this process, which must have one thread, into the namespace of a robot of a run.
/// @param run  process of that run; may be left out if one run only has a robot of that name
/// @throws std::invalid_argument if there is none, or several; RunError
void enter_namespace(const std::string& robot, std::optional<pid_t> run);

}  // namespace rovernet
