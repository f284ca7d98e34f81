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

// Requests of the lock-step protocol: one JSON object per line, from a controller.
// docs/guide/live-json.md has the table of keys.

namespace rovernet {

class Network;

/// Error in a request line of a controller. The session is unchanged, and the controller may send a
/// corrected line.
class RequestError : public std::runtime_error {
  public:
    /// @param code     error code for programs: "unknown_robot"
    /// @param at       path of the wrong element in the line: "do.C.v"; empty: the whole line
    /// @param message  text with the found and the expected value
    RequestError(const char* code, std::string at, const std::string& message)
        : std::runtime_error(message), code_(code), at_(std::move(at)) {}
    const char* code() const { return code_; }
    const std::string& at() const { return at_; }

  private:
    const char* code_;
    std::string at_;
};

/// Request "hello": the controller takes control of robots.
struct HelloRequest {
    std::string name;            ///< name of the controller; empty: the name of its first robot
    std::vector<NodeId> robots;  ///< robots to control: at least one, each once
    Duration step{};             ///< simulated time between a request and its answer [ns], > 0
    bool observes_pose = true, observes_heard = true, observes_neighbors = false,
         observes_scan = false;
    bool columns = false;  ///< true: states of robots are sent as lists, one list per quantity
    std::optional<std::uint64_t> seed = {};
};

/// Request "step" of a controller: robot commands that take effect now, then a step of simulated
/// time.
struct StepRequest {
    /// Number chosen by the controller, greater than in the previous request.
    std::uint64_t number = 0;
    /// Commands for robots: movements, then messages in the order of the request.
    std::vector<std::pair<NodeId, RobotCommand>> commands = {};
};

/// Request "reset": the run starts again.
struct ResetRequest {
    std::optional<std::uint64_t> seed = {};  ///< new seed; none: the same seed
};

/// Request "bye": the controller leaves.
struct ByeRequest {};

using Request = std::variant<HelloRequest, StepRequest, ResetRequest, ByeRequest>;

/// Reader of request lines that reuses its memory. A line is checked completely before any of its
/// commands is returned.
///
/// Limits of a line: 32 nesting levels, 100,000 robots or messages, names of 64 bytes, messages of
/// 65,535 bytes, 1,000 m/s and 1,000 rad/s.
class RequestReader {
  public:
    RequestReader();
    RequestReader(RequestReader&&) noexcept;
    ~RequestReader();

    /// Reads the request in a line (without the line's end).
    /// @param network  network with the robots' names
    /// @param own      robots of the controller, in ascending order; empty before its "hello"
    /// @throws RequestError
    Request read(std::string_view line, const Network& network, std::span<const NodeId> own);
    /// Value of the key "n" of the last request line, for error answers; none: the key is missing.
    std::optional<std::uint64_t> number() const { return number_; }

  private:
    struct Parser;
    std::unique_ptr<Parser> parser_;
    std::optional<std::uint64_t> number_;
};

}  // namespace rovernet
