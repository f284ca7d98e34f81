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
#include <utility>
#include <vector>

// Answers of the lock-step protocol: one JSON object a line, without its end. Numbers are the
// shortest that read back as the same ones.

namespace rovernet {

/// Message that a robot sent: its number in the run.
struct SentMessage {
    std::uint64_t uid;
    NodeId robot;
};

/// Writer of what a controller is told of its session. Each line is good until the next one.
class AnswerWriter {
  public:
    /// @param session, scenario  of which it tells, which have to live as long
    AnswerWriter(Session& session, const Scenario& scenario);

    /// "welcome": time, end and map of the run, and the controller's robots.
    std::string_view welcome(const HelloRequest& hello);
    /// "state": what the controller's robots see and hear at the end of a step.
    /// @param number  of the step
    /// @param sent    messages of the step
    /// @param heard   since the last state
    std::string_view state(const HelloRequest& hello, std::uint64_t number,
                           const std::vector<SentMessage>& sent,
                           const std::vector<HeardMessage>& heard);

  private:
    void put(std::string_view text) { line_.put(text); }
    void put(double number);  // null if it is not finite
    void put(std::int64_t number) { line_.put_number(number); }
    void put(std::uint64_t number) { line_.put_number(number); }
    void put_truth(bool is_true) { put(is_true ? std::string_view("true") : "false"); }
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
    void put_map();

    Session& session_;
    const Scenario& scenario_;
    std::vector<std::string> names_;  // in quotes
    JsonLine line_;
};

/// "error": a line was not taken.
std::string error_line(const RequestError& fault, std::optional<std::uint64_t> number);
/// "end": the last line that a controller is told.
/// @param reason   bye, done, stopped, lost or patience
/// @param metrics  as summary.json has them
std::string end_line(std::string_view reason, std::string_view fingerprint, const Table& metrics);

}  // namespace rovernet
