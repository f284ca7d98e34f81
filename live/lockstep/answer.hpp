// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/session.hpp"
#include "live/carriers/json_line.hpp"
#include "live/carriers/request.hpp"
#include "scenario/scenario.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Answers of the lock-step protocol: one JSON object per line, without the line end. Numbers have
// the fewest digits that read back as the same value.

namespace rovernet {

/// Message that a robot sent: uid of the message, and the robot.
struct SentMessage {
    std::uint64_t uid;
    NodeId robot;
};

/// Writer of answers to a controller (external program) of a lock-step run. Each line is valid
/// until the next call.
class AnswerWriter {
  public:
    /// @param session, scenario  must outlive the writer
    AnswerWriter(Session& session, const Scenario& scenario);

    /// Answer "welcome": time, end and map of the run, and the controller's robots.
    std::string_view welcome(const HelloRequest& hello);
    /// Answer "state": measurements and received messages of the controller's robots at the end of
    /// a step.
    /// @param number  number of the step
    /// @param sent    messages sent in the step
    /// @param heard   messages received since the last state
    std::string_view state(const HelloRequest& hello, std::uint64_t number,
                           const std::vector<SentMessage>& sent,
                           const std::vector<HeardMessage>& heard);

  private:
    void put(std::string_view text) { line_.put(text); }
    void put(double number);  // writes null for a number that is not finite
    void put(std::int64_t number) { line_.put_number(number); }
    void put(std::uint64_t number) { line_.put_number(number); }
    /// Appends several pieces to the line, such as a key and its value.
    template <class... Pieces>
    requires(sizeof...(Pieces) > 1) void put(const Pieces&... pieces) { (put(pieces), ...); }
    static std::string_view truth(bool is_true) { return is_true ? "true" : "false"; }
    const std::string& name(NodeId robot) const { return names_[robot.index()]; }
    bool tells_height(Vec3 at) const;
    void put_place(Vec3 at);
    void put_robot(NodeId robot);
    void put_columns(const std::vector<NodeId>& robots);
    template <class Items, class PutOne>
    void put_list(const Items& items, PutOne put_one);
    template <class PutOne>
    void put_column(std::string_view key, const std::vector<NodeId>& robots, PutOne put_one);
    void put_heard(const HeardMessage& heard);
    void put_neighbors(NodeId robot);
    void put_scanners(NodeId robot);
    void put_scans(NodeId robot);
    void put_map();

    Session& session_;
    const Scenario& scenario_;
    std::vector<std::string> names_;  // names of robots in quotes
    JsonLine line_;
};

/// Answer "error": a line of a controller was rejected. @param number  `n` of that line
std::string error_line(const RequestError& fault, std::optional<std::uint64_t> number);
/// Answer "end": the last line to a controller.
/// @param reason   reason of the end: bye, done, stopped, lost (a controller) or patience (timeout)
/// @param metrics  metrics of the run, as in summary.json
std::string end_line(std::string_view reason, std::string_view fingerprint, const Table& metrics);

}  // namespace rovernet
