// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/propagation.hpp"
#include "scenario/document/value.hpp"
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
struct LoadedRun;
class Network;
class RecordedIndex;

/// Recorded trace and its index. With the index, only the needed parts of the trace are read for
/// each question.
struct IndexedTrace {
    std::string path;
    std::shared_ptr<const RecordedIndex> index = nullptr;  ///< null: none
};

/// Answers to the questions of the viewer's page about a run (docs/formats/view-format.md): why a
/// robot received a message or did not receive it, link budgets, link tables, coverage. Each answer
/// is computed by the function that the command line calls for the same question.
class ViewerAnswers {
  public:
    /// Answers about a recorded run, at any of its times.
    /// @param other  trace of the second run, to which questions with "run": 1 refer; empty path:
    /// no second run
    /// @throws InputError if a trace has no scenario
    explicit ViewerAnswers(IndexedTrace trace, const IndexedTrace& other = {});
    /// History of a running network, as recorded traces.
    struct History {
        /// Returns a trace with all records of the message. Its path is empty if the records are no
        /// longer kept.
        std::function<IndexedTrace(std::uint64_t uid)> of_message;
        /// Returns a trace of the last seconds.
        std::function<IndexedTrace()> of_present;
    };
    /// Answers about a running network at its present time. The answers contain this time as
    /// `t_ns`.
    ViewerAnswers(std::shared_ptr<const Network> network, History history);
    ~ViewerAnswers();

    /// From now on, refuses questions whose answers show walls (`pair`, `coverage` and `svg`), and
    /// leaves out the walls in answers to `why`.
    void hide_map();

    /// Function that answers further questions; returns an empty result for an unknown question.
    using Others =
        std::function<std::optional<Table>(std::string_view op, const JsonElement& question)>;
    /// Answer to a question, both as JSON. If an error occurs, the answer has the key `error`.
    std::string answer(std::string_view question, const Others& others = {});

  private:
    Table answer_of(std::string_view op, const JsonElement& question);
    Table why(const JsonElement& question);
    Table air(const JsonElement& question) const;
    Table pair(const JsonElement& question) const;
    Table link_table(const JsonElement& question);
    Table links(const JsonElement& question);
    Table coverage(const JsonElement& question);
    Table svg(const JsonElement& question) const;
    const LoadedRun& loaded(const IndexedTrace& trace);
    NodeId robot(const JsonElement& question, std::string_view key) const;
    const std::string& name_of(NodeId robot) const { return robots_[robot.index()]; }
    /// Propagation model of a robot's transmissions under the assignments in the question's key
    /// `with`; empty if the question has no such key.
    std::optional<Propagation> other_model(const JsonElement& question, NodeId robot) const;
    Time time(const JsonElement& question) const;
    /// Running network, or network of the recorded run at the time of the question. The network of
    /// a recorded run is kept, because the next question is often about the same or a slightly
    /// later time.
    const Network& network(const JsonElement& question);

    IndexedTrace trace_;                      // empty path: the answers are about a running network
    std::shared_ptr<const Network> running_;  // null: the answers are about a trace
    History history_;                         // history of running_
    std::vector<std::string> robots_;         // names by NodeId
    std::unique_ptr<LoadedRun> run_;  // null: about a running network, and no "why" was asked yet
    std::unique_ptr<Network> network_;
    std::unique_ptr<JsonParser> parser_;
    std::unique_ptr<ViewerAnswers> other_;  // answers about the second run; null: none
    bool hides_map_ = false;
};

}  // namespace rovernet
