// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/recorded_scenario.hpp"
#include "models/propagation/propagation.hpp"
#include "scenario/document/value.hpp"
#include "scenario/scenario.hpp"
#include "sim/ids.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

struct JsonElement;
class JsonParser;
class Network;

/// Answers to the questions of the viewer's page about a run (docs/formats/view-format.md): why a
/// robot has a message, link budgets, link tables, coverage. Each answer is computed by the
/// function that the command line calls for the same question.
class ViewerAnswers {
  public:
    /// Answers about a recorded run, at any of its times.
    /// @param trace  path of the recorded trace
    /// @param other  path of a second trace, for questions with "run": 1; empty: none
    /// @throws InputError if a trace has no scenario
    explicit ViewerAnswers(const std::string& trace, const std::string& other = {});
    /// Answers about a running network at its present time, which each answer contains as `t_ns`.
    explicit ViewerAnswers(std::shared_ptr<const Network> network);
    ~ViewerAnswers();

    /// Function that answers further questions; returns an empty result for an unknown question.
    using Others =
        std::function<std::optional<Table>(std::string_view op, const JsonElement& question)>;
    /// Answer to a question, both as JSON. If an error occurs, the answer has the key `error`.
    std::string answer(std::string_view question, const Others& others = {});

  private:
    Table answer_of(std::string_view op, const JsonElement& question);
    Table why(const JsonElement& question) const;
    Table pair(const JsonElement& question) const;
    Table link_table(const JsonElement& question);
    Table links(const JsonElement& question);
    Table coverage(const JsonElement& question);
    Table svg(const JsonElement& question) const;
    NodeId robot(const JsonElement& question, std::string_view key) const;
    const std::string& name_of(NodeId robot) const { return robots_[robot.index()]; }
    /// Propagation model of a robot's transmissions under the assignments in the question's key
    /// `with`; empty if the question has no such key.
    std::optional<Propagation> other_model(const JsonElement& question, NodeId robot) const;
    Time time(const JsonElement& question) const;
    /// Running network, or network of the recorded run at the time of the question. The latter is
    /// kept, because the next question is often about the same or a slightly later time.
    const Network& network(const JsonElement& question);

    std::string trace_;                       // path of the trace; empty for a running network
    std::shared_ptr<const Network> running_;  // running network; null for a trace
    std::vector<std::string> robots_;         // names of the robots, by NodeId
    std::unique_ptr<ReplayedScenario> replayed_;
    Scenario scenario_;
    std::unique_ptr<Network> network_;
    std::unique_ptr<JsonParser> parser_;
    std::unique_ptr<ViewerAnswers> other_;  // answers about the second run; null: none
};

}  // namespace rovernet
