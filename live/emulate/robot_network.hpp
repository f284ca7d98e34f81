// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <sys/types.h>
#include <utility>

namespace rovernet {

/// Descriptor that is closed with its owner.
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

/// Run that is meant by `rovernet in`, as far as that is said.
struct WantedRun {
    std::optional<pid_t> process = {};
    std::optional<std::string> folder = {};  ///< of its results
    /// User whose runs are trusted; none: the one of this process. Whoever hands out a network
    /// reads and changes all that programs send there.
    std::optional<uid_t> user = {};
};

/// Network of a robot of a run that is going on.
struct RobotNetwork {
    std::string robot;
    pid_t run;
    std::string folder;        ///< of the run's results
    OwnDescriptor space;       ///< of the namespace
    OwnDescriptor connection;  ///< to the run: at its end a message comes, or it breaks
};

/// Comes in at a robot's door. Doors of other users than the one that is trusted are passed over.
/// @throws std::invalid_argument if there is no such robot, or if several runs have one, telling
///     which there are
/// @throws RunError if the run ends meanwhile
RobotNetwork find_network(const std::string& robot, const WantedRun& wanted);

/// Moves this process, which must have one thread, into a robot's network.
/// @throws RunError
void enter_network(const RobotNetwork& network);

/// The folder of a run, as a person at the present folder would write it.
std::string folder_text(const std::string& folder);

}  // namespace rovernet
