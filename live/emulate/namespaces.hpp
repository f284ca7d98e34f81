// SPDX-License-Identifier: MIT
#pragma once

#include "live/emulate/tap.hpp"

#include <cstddef>
#include <functional>
#include <string>
#include <sys/types.h>
#include <vector>

namespace rovernet {

/// Network namespaces, one for each robot, each with a TAP device. An unprivileged user gets a user
/// namespace first, in which network namespaces can be created.
///
/// A separate process, the keeper (run_keeper), holds the namespaces, so that this process stays in
/// its own network. The keeper passes a namespace to processes of this user on request
/// (RobotNetwork). When this process ends for any reason, the keeper ends the programs in the
/// namespaces, and then itself: no process remains.
class Namespaces {
  public:
    /// @param folder  folder of the run's results, by which programs find the run
    /// @param go_on   called repeatedly during the setup; returning false stops the setup
    /// @throws RunError if namespaces or devices cannot be made; Interrupted by `go_on`
    Namespaces(std::vector<RobotDevice> robots, const std::string& folder,
               const std::function<bool()>& go_on);
    /// Ends the programs in the namespaces, and waits for their end.
    ~Namespaces();
    Namespaces(const Namespaces&) = delete;
    Namespaces& operator=(const Namespaces&) = delete;

    const std::vector<RobotDevice>& robots() const { return robots_; }
    /// Descriptor of a robot's TAP device; the caller becomes its owner.
    int take_device(std::size_t robot);

  private:
    void receive_devices(const std::function<bool()>& go_on);
    void end();

    std::vector<RobotDevice> robots_;
    std::vector<int> devices_;  // TAP devices of the robots; -1: taken by take_device()
    int keeper_socket_ = -1;
    pid_t keeper_ = -1;
};

}  // namespace rovernet
