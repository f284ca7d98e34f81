// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/robot_command.hpp"
#include "sim/ids.hpp"
#include "sim/time.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

// Questions of the lock-step protocol: one JSON object a line, from a controller. docs/live.md has
// the table of keys.

namespace rovernet {

class Network;

/// Fault of a line; the session is as before. The controller may send it again, mended.
class RequestError : public std::runtime_error {
  public:
    /// @param code     one word for programs: "unknown_robot"
    /// @param at       place in the line, as a path: "do.C.v"; empty: all of it
    /// @param message  what was found and what was expected
    RequestError(const char* code, std::string at, const std::string& message)
        : std::runtime_error(message), code_(code), at_(std::move(at)) {}
    const char* code() const { return code_; }
    const std::string& at() const { return at_; }

  private:
    const char* code_;
    std::string at_;
};

/// "hello": the controller takes robots.
struct HelloRequest {
    std::string name;            ///< empty: the name of its first robot
    std::vector<NodeId> robots;  ///< one at least, each once
    Duration step{};             ///< [ns] of simulated time from a question to its answer, > 0
    bool observes_pose = true, observes_heard = true, observes_neighbors = false;
    bool columns = false;  ///< states of robots come as lists
    std::optional<std::uint64_t> seed = {};
};

/// "step": commands that hold from now on, then a step of simulated time.
struct StepRequest {
    std::uint64_t number = 0;  ///< controller's own, greater than the last one
    /// Commands in the order in which they are carried out: by robot, movements before messages,
    /// messages as they came.
    std::vector<std::pair<NodeId, RobotCommand>> commands;
};

/// "reset": the run begins anew.
struct ResetRequest {
    std::optional<std::uint64_t> seed = {};  ///< none: the same again
};

/// "bye": the controller leaves.
struct ByeRequest {};

using Request = std::variant<HelloRequest, StepRequest, ResetRequest, ByeRequest>;

/// Reader of lines, which keeps its memory. A line is checked whole before anything is made of it.
///
/// Limits: 32 levels of brackets, 100,000 robots or messages, names of 64 bytes, messages of 65,535
/// bytes, 1,000 m/s and 1,000 rad/s.
class RequestReader {
  public:
    RequestReader();
    RequestReader(RequestReader&&) noexcept;
    ~RequestReader();

    /// Reads a line, without its end.
    /// @param network  has the robots' names
    /// @param own      robots of the controller, in ascending order; empty before its hello
    /// @throws RequestError
    Request read(std::string_view line, const Network& network, std::span<const NodeId> own);
    /// Number "n" of the last line, if it had one: errors name it.
    std::optional<std::uint64_t> number() const { return number_; }

  private:
    struct Parser;
    std::unique_ptr<Parser> parser_;
    std::optional<std::uint64_t> number_;
};

}  // namespace rovernet
