// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/recorded_scenario.hpp"
#include "models/propagation/propagation.hpp"
#include "scenario/document/value.hpp"
#include "scenario/scenario.hpp"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

struct JsonElement;
class JsonParser;
class Network;

/// Answers to the questions of the viewer's page about a recorded run (docs/view-format.md): why a
/// robot has a message, link budgets, link tables, coverage. Each answer is computed by the
/// function that the command line calls for the same question.
class ViewerAnswers {
  public:
    /// @param trace  path of the recorded trace
    /// @throws InputError if the trace has no scenario
    explicit ViewerAnswers(const std::string& trace);
    ~ViewerAnswers();

    /// Answer to a question, both as JSON. An error is an answer with the key `error`.
    std::string answer(std::string_view question);

  private:
    Table answer_of(const JsonElement& question);
    Table why(const JsonElement& question) const;
    Table pair(const JsonElement& question) const;
    Table link_table(const JsonElement& question) const;
    Table links(const JsonElement& question);
    Table coverage(const JsonElement& question);
    const std::string& robot(const JsonElement& question, std::string_view key) const;
    /// Model of what a robot sends under the assignment of the key `with`, if the question has it.
    std::optional<Propagation> other_model(const JsonElement& question, NodeId robot) const;
    Time time(const JsonElement& question) const;
    /// Network of the scenario at a time. It is kept, since the next question is often about the
    /// same time, or a little later.
    const Network& network(Time at);

    std::string trace_;
    std::vector<std::string> robots_;  // names by NodeId
    std::unique_ptr<ReplayedScenario> replayed_;
    Scenario scenario_;
    std::unique_ptr<Network> network_;
    std::unique_ptr<JsonParser> parser_;
};

}  // namespace rovernet
