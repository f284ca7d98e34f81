// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <sys/types.h>
#include <utility>

namespace rovernet {

/// File descriptor, closed by the destructor.
class OwnDescriptor {
  public:
    explicit OwnDescriptor(int descriptor = -1) : value_(descriptor) {}
    ~OwnDescriptor();
    OwnDescriptor(OwnDescriptor&& other) noexcept : value_(std::exchange(other.value_, -1)) {}
    OwnDescriptor& operator=(OwnDescriptor&& other) noexcept {
        std::swap(value_, other.value_);
        return *this;
    }
    int get() const { return value_; }

  private:
    int value_;
};

/// Selection of a run for the command `rovernet in`, which starts a program in a robot's network;
/// empty members match any run.
struct WantedRun {
    std::optional<pid_t> process = {};
    std::optional<std::string> folder = {};  ///< folder of the run's results
    /// User whose runs are trusted; none: the user of this process. The owner of a run can read and
    /// change all packets of programs in the run's networks.
    std::optional<uid_t> user = {};
};

/// Network namespace of a robot in a current run, for a program that `rovernet in` starts.
struct RobotNetwork {
    std::string robot;
    pid_t run;
    std::string folder;        ///< folder of the run's results
    OwnDescriptor space;       ///< file descriptor of the network namespace
    OwnDescriptor connection;  ///< connection to the run: at the end of the run a message arrives,
                               ///< or the connection breaks
};

/// Connects to a robot's listener, and gets the robot's network namespace. Listeners of untrusted
/// users are ignored.
/// @throws std::invalid_argument if no run or several runs have a robot with this name; the message
///     lists the candidates
/// @throws RunError if the run ends in the meantime
RobotNetwork find_network(const std::string& robot, const WantedRun& wanted);

/// Moves this process, which must have one thread, into a robot's network namespace.
/// @throws RunError
void enter_network(const RobotNetwork& network);

/// Folder of a run, as a relative path if it lies below the current folder.
std::string folder_text(const std::string& folder);

}  // namespace rovernet
