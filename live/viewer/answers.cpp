// SPDX-License-Identifier: MIT
#include "live/viewer/answers.hpp"

#include "experiment/replay/message_at_robot.hpp"
#include "experiment/reports/link_report.hpp"
#include "experiment/reports/link_table.hpp"
#include "experiment/reports/network_at.hpp"
#include "live/carriers/json_object.hpp"
#include "live/viewer/network_answers.hpp"
#include "models/medium/medium.hpp"
#include "scenario/document/json.hpp"
#include "traces/recorded/recorded_reader.hpp"

#include <fmt/format.h>

#include <exception>

namespace rovernet {
namespace {

constexpr std::uint64_t most_cells = 250'000;
constexpr std::size_t longest_question = 65'536;

/// Member of a JSON object. @throws RequestError "missing_key"
JsonElement member(const JsonElement& object, std::string_view key) {
    simdjson::dom::element value;
    if (object.object()[key].get(value) != simdjson::SUCCESS)
        fail_missing_key(object.path, key, "0");
    return {value, {.above = nullptr, .key = key}};
}

}  // namespace

ViewerAnswers::ViewerAnswers(const std::string& trace)
    : trace_(trace), parser_(std::make_unique<JsonParser>()) {
    const RecordedReader reader(trace);
    robots_ = reader.run().robots;
    replayed_ = std::make_unique<ReplayedScenario>(reader.run(), trace);
    scenario_ = replayed_->with({});
}

ViewerAnswers::~ViewerAnswers() = default;

std::string ViewerAnswers::answer(std::string_view question) {
    Table answer;
    Value id;
    try {
        if (question.size() > longest_question)
            throw RequestError("too_long", "", "a question has at most 64 KiB");
        const JsonElement asked{parser_->parse(question), {}};
        id = Value(member(asked, "id").whole_number(0, 1U << 31U));
        answer = answer_of(asked);
    } catch (const std::exception& error) {
        answer = {};
        answer.set("error", error.what());
    }
    answer.set("id", id);
    return to_json_line(std::move(answer));
}

Table ViewerAnswers::answer_of(const JsonElement& question) {
    const std::string op(member(question, "op").text());
    if (op == "why") return why(question);
    if (op == "pair") return pair(question);
    if (op == "robot") return link_table(question);
    if (op == "links") return links(question);
    if (op == "coverage") return coverage(question);
    throw RequestError(
        "unknown_op", "op",
        fmt::format("found \"{}\", expected why, pair, robot, links or coverage", op));
}

const std::string& ViewerAnswers::robot(const JsonElement& question, std::string_view key) const {
    return robots_[member(question, key).whole_number(0, robots_.size() - 1)];
}

Time ViewerAnswers::time(const JsonElement& question) const {
    const auto end = static_cast<std::uint64_t>(scenario_.scenario.duration.count());
    const std::uint64_t t = member(question, "t_ns").whole_number(0, end);
    return start_of_run + Duration{static_cast<std::int64_t>(t)};
}

Table ViewerAnswers::why(const JsonElement& question) const {
    const std::uint64_t uid = member(question, "uid").whole_number(0, 1ULL << 53U);
    const std::uint64_t robot = member(question, "robot").whole_number(0, robots_.size() - 1);
    return document_of(message_at_robot(trace_, uid, NodeId{static_cast<std::uint32_t>(robot)}));
}

Table ViewerAnswers::pair(const JsonElement& question) const {
    const std::string &a = robot(question, "a"), &b = robot(question, "b");
    const Time at = time(question);
    Table answer;
    answer.set("links", Array{link_document(report_link(scenario_, a, b, at)),
                              link_document(report_link(scenario_, b, a, at))});
    return answer;
}

const Network& ViewerAnswers::network(Time at) {
    if (!network_ || network_->now() > at) {
        network_ = network_at(scenario_, at);
    } else if (network_->now() < at) {
        play_until(*network_, at, {});
    }
    return *network_;
}

Table ViewerAnswers::links(const JsonElement& question) {
    const Network& then = network(time(question));
    if (question.object().at_key("robot").error() != simdjson::SUCCESS)
        return answer_links(then, {});
    const std::uint64_t robot = member(question, "robot").whole_number(0, robots_.size() - 1);
    return answer_links(then, NodeId{static_cast<std::uint32_t>(robot)});
}

Table ViewerAnswers::link_table(const JsonElement& question) const {
    const std::string& name = robot(question, "robot");
    const auto network = network_at(scenario_, time(question));
    Table answer;
    for_each_link_table(*network, name,
                        [&](const LinkTable& table) { answer = link_table_document(table); });
    return answer;
}

std::optional<Propagation> ViewerAnswers::other_model(const JsonElement& question,
                                                      NodeId robot) const {
    if (question.object().at_key("with").error() != simdjson::SUCCESS) return {};
    const std::string with(member(question, "with").text());
    if (!with.starts_with("propagation."))
        throw RequestError("bad_value", "with", "expected such as \"propagation.model=friis\"");
    const auto network = network_at(replayed_->with({with}), start_of_run);
    return network->medium().stations().model(robot).median();
}

Table ViewerAnswers::coverage(const JsonElement& question) {
    const std::uint64_t robot = member(question, "robot").whole_number(0, robots_.size() - 1);
    const std::uint64_t cells = member(question, "cells").whole_number(1, most_cells);
    const Network& then = network(time(question));
    const std::size_t storeys = then.scene().storeys().size();
    const NodeId node{static_cast<std::uint32_t>(robot)};
    return answer_coverage(then, {.robot = node,
                                  .storey = member(question, "storey").whole_number(0, storeys - 1),
                                  .cells = static_cast<int>(cells),
                                  .other = other_model(question, node)});
}

}  // namespace rovernet
