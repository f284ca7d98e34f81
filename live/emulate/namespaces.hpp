// SPDX-License-Identifier: MIT
#pragma once

#include "live/emulate/tap.hpp"

#include <cstddef>
#include <functional>
#include <string>
#include <sys/types.h>
#include <vector>

namespace rovernet {

/// Network namespaces, one for each robot, with its TAP device in it. A user who may not make them
/// gets a user namespace around them, in which that is allowed.
///
/// They belong to a process of their own, the keeper (run_keeper), so that this one stays where it
/// is. The keeper hands a namespace to this user's processes that ask (RobotNetwork). It ends when
/// this process does, however that ends, and the programs in the namespaces before it: then nothing
/// is left.
class Namespaces {
  public:
    /// @param folder  of the run's results, by which programs find it
    /// @param go_on   asked now and then; false: it is not waited for any more
    /// @throws RunError if namespaces or devices cannot be made; Interrupted
    Namespaces(std::vector<RobotDevice> robots, const std::string& folder,
               const std::function<bool()>& go_on);
    /// Waits for the end of the programs in them.
    ~Namespaces();
    Namespaces(const Namespaces&) = delete;
    Namespaces& operator=(const Namespaces&) = delete;

    const std::vector<RobotDevice>& robots() const { return robots_; }
    /// Descriptor of a robot's TAP device, which the caller then owns.
    int take_device(std::size_t robot);

  private:
    void receive_devices(const std::function<bool()>& go_on);
    void end();

    std::vector<RobotDevice> robots_;
    std::vector<int> devices_;  // -1: taken
    int keeper_socket_ = -1;
    pid_t keeper_ = -1;
};

}  // namespace rovernet
