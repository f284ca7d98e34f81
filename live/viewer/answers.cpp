// SPDX-License-Identifier: MIT
#include "live/viewer/answers.hpp"

#include "experiment/replay/air_at_robot.hpp"
#include "experiment/replay/loaded_run.hpp"
#include "experiment/replay/message_at_robot.hpp"
#include "experiment/reports/link_report.hpp"
#include "experiment/reports/link_table.hpp"
#include "experiment/reports/network_at.hpp"
#include "live/carriers/json_object.hpp"
#include "live/viewer/network_answers.hpp"
#include "models/medium/medium.hpp"
#include "pictures/map/picture.hpp"
#include "scenario/document/json.hpp"
#include "traces/recorded/recorded_index.hpp"
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

bool has_member(const JsonElement& object, std::string_view key) {
    simdjson::dom::element value;
    return object.object()[key].get(value) == simdjson::SUCCESS;
}

/// Link report as `rovernet link --json` prints it, with all terms of the budget: the power and all
/// gains and losses add up to the received power.
Table budget_document(const LinkReport& report) {
    const Table link = link_document(report);
    if (report.range) return link;
    Table all;
    for (const auto& [key, value, where] : link.entries) {
        if (key == "path_loss_db") {
            all.set("power_dbm", report.sender.power.value);
            all.set("sender_gain_db", report.sender.antenna_gain.value);
            all.set("sender_cable_loss_db", report.sender.cable_loss.value);
            all.set("receiver_gain_db", report.receiver.antenna_gain.value);
            all.set("receiver_cable_loss_db", report.receiver.cable_loss.value);
        }
        if (key == "margin_db") all.set("sensitivity_dbm", report.receiver.sensitivity.value);
        all.set(key, value);
    }
    return all;
}

}  // namespace

ViewerAnswers::ViewerAnswers(IndexedTrace trace, const IndexedTrace& other)
    : trace_(std::move(trace)), parser_(std::make_unique<JsonParser>()) {
    robots_ = loaded(trace_).names;
    if (!other.path.empty()) other_ = std::make_unique<ViewerAnswers>(other);
}

ViewerAnswers::ViewerAnswers(std::shared_ptr<const Network> network, History history)
    : running_(std::move(network)),
      history_(std::move(history)),
      parser_(std::make_unique<JsonParser>()) {
    for (std::uint32_t i = 0; i < running_->size(); ++i)
        robots_.push_back(running_->name(NodeId{i}));
}

ViewerAnswers::~ViewerAnswers() = default;

void ViewerAnswers::hide_map() {
    hides_map_ = true;
    if (other_) other_->hide_map();
}

std::string ViewerAnswers::answer(std::string_view question, const Others& others) {
    Table answer;
    Value id;
    try {
        const JsonElement asked{parser_->parse(question), {}};
        id = Value(member(asked, "id").whole_number(0, 1U << 31U));
        if (question.size() > longest_question) {
            throw RequestError(
                "too_long", "",
                fmt::format(
                    "found a request of {} bytes from a page; expected at most {} bytes (64 KiB)",
                    question.size(), longest_question));
        }
        const std::string_view op = member(asked, "op").text();
        const bool is_other =
            has_member(asked, "run") && member(asked, "run").whole_number(0, other_ ? 1 : 0) == 1;
        const std::optional<Table> told = others ? others(op, asked) : std::nullopt;
        answer = told ? *told : (is_other ? *other_ : *this).answer_of(op, asked);
        if (running_) answer.set("t_ns", (running_->now() - start_of_run).count());
    } catch (const std::exception& error) {
        answer = {};
        answer.set("error", error.what());
    }
    answer.set("id", id);
    return to_json_line(std::move(answer));
}

Table ViewerAnswers::answer_of(std::string_view op, const JsonElement& question) {
    if (hides_map_ && (op == "pair" || op == "coverage" || op == "svg")) {
        throw RequestError("hidden", "op",
                           "the server does not show the map (--no-map), and this answer would "
                           "show walls");
    }
    if (op == "why") return why(question);
    if (op == "air") return air(question);
    if (op == "pair") return pair(question);
    if (op == "robot") return link_table(question);
    if (op == "links") return links(question);
    if (op == "coverage") return coverage(question);
    if (op == "svg") return svg(question);
    throw RequestError(
        "unknown_op", "op",
        fmt::format("found \"{}\"; expected \"why\", \"air\", \"pair\", \"robot\", \"links\", "
                    "\"coverage\" or \"svg\"",
                    op));
}

NodeId ViewerAnswers::robot(const JsonElement& question, std::string_view key) const {
    return NodeId{
        static_cast<std::uint32_t>(member(question, key).whole_number(0, robots_.size() - 1))};
}

Time ViewerAnswers::time(const JsonElement& question) const {
    const auto end = static_cast<std::uint64_t>(run_->scenario.scenario.duration.count());
    const std::uint64_t t = member(question, "t_ns").whole_number(0, end);
    return start_of_run + Duration{static_cast<std::int64_t>(t)};
}

/// Scenario of the run, loaded with the first trace of it.
const LoadedRun& ViewerAnswers::loaded(const IndexedTrace& trace) {
    if (!run_) run_ = std::make_unique<LoadedRun>(RecordedReader(trace.path).run(), trace.path);
    return *run_;
}

Table ViewerAnswers::why(const JsonElement& question) {
    const std::uint64_t uid = member(question, "uid").whole_number(0, 1ULL << 53U);
    const NodeId node = robot(question, "robot");
    const IndexedTrace trace = running_ ? history_.of_message(uid) : trace_;
    if (trace.path.empty()) {
        throw RequestError("not_kept", "uid",
                           fmt::format("there are no records of message {}: the message was sent "
                                       "before a page was connected, or too long ago",
                                       uid));
    }
    if (trace.index && !trace.index->has(uid)) {
        throw RequestError("unknown_message", "uid",
                           fmt::format("there is no message {} in this run", uid));
    }
    MessageAtRobot message =
        message_at_robot(trace.path, loaded(trace), uid, node, trace.index.get());
    message.tells_walls = !hides_map_;
    return document_of(message);
}

Table ViewerAnswers::air(const JsonElement& question) const {
    const NodeId node = robot(question, "robot");
    const IndexedTrace trace = running_ ? history_.of_present() : trace_;
    const Time at = running_ ? running_->now() : time(question);
    return document_of(air_at_robot(trace.path, node, at, trace.index.get()));
}

Table ViewerAnswers::pair(const JsonElement& question) const {
    const NodeId a = robot(question, "a"), b = robot(question, "b");
    const auto link = [&](NodeId from, NodeId to) {
        return budget_document(
            running_ ? report_link(*running_, from, to)
                     : report_link(run_->scenario, name_of(from), name_of(to), time(question)));
    };
    Table answer;
    answer.set("links", Array{link(a, b), link(b, a)});
    return answer;
}

/// Network at the time of a question, or the one that runs.
const Network& ViewerAnswers::network(const JsonElement& question) {
    if (running_) return *running_;
    const Time at = time(question);
    if (!network_ || network_->now() > at) {
        network_ = network_at(run_->scenario, at);
    } else if (network_->now() < at) {
        play_until(*network_, at, {});
    }
    return *network_;
}

Table ViewerAnswers::links(const JsonElement& question) {
    const Network& then = network(question);
    if (question.object().at_key("robot").error() != simdjson::SUCCESS)
        return answer_links(then, {});
    return answer_links(then, robot(question, "robot"));
}

Table ViewerAnswers::link_table(const JsonElement& question) {
    const NodeId node = robot(question, "robot");
    const Network& network = this->network(question);
    Table answer;
    for_each_link_table(network, name_of(node), [&](const LinkTable& table) {
        answer = link_table_document(table);
        Array& links = *answer.find("links")->array();
        for (std::size_t i = 0; i < links.size(); ++i) {
            const std::optional<NodeId> from = network.find(table.rows[i].neighbour.robot);
            if (table.rows[i].range || !from) continue;
            const Db margin =
                network.medium().links().margin(*from, node, network.now(), network.legs());
            links[i].table()->set("margin_db", margin.value);
        }
    });
    return answer;
}

Table ViewerAnswers::svg(const JsonElement& question) const {
    if (running_)
        throw RequestError("not_recorded", "op",
                           "the SVG of a run can be made only after the end of the run");
    const std::size_t storeys = 1000;
    PictureOptions options{
        .at = time(question),
        .links = has_member(question, "links") && member(question, "links").truth(),
        .trails = has_member(question, "trails") && member(question, "trails").truth(),
        .storey = 1 + static_cast<int>(member(question, "storey").whole_number(0, storeys))};
    if (has_member(question, "coverage")) options.coverage = {name_of(robot(question, "coverage"))};
    Table answer;
    answer.set("svg", draw_svg(run_->scenario, options));
    return answer;
}

std::optional<Propagation> ViewerAnswers::other_model(const JsonElement& question,
                                                      NodeId robot) const {
    if (!has_member(question, "with")) return {};
    if (running_) {
        throw RequestError("not_recorded", "with",
                           "a different propagation model can be shown only after the end of "
                           "the run, and only if the run is recorded");
    }
    const std::string with(member(question, "with").text());
    if (!with.starts_with("propagation."))
        throw RequestError("bad_value", "with",
                           "expected KEY=VALUE, such as \"propagation.model=friis\"");
    const auto network = network_at(run_->replayed.with({with}), start_of_run);
    return network->medium().stations().model(robot).median();
}

Table ViewerAnswers::coverage(const JsonElement& question) {
    const NodeId node = robot(question, "robot");
    const std::uint64_t cells = member(question, "cells").whole_number(1, most_cells);
    const Network& then = network(question);
    const std::size_t storeys = then.scene().storeys().size();
    return answer_coverage(then, {.robot = node,
                                  .storey = member(question, "storey").whole_number(0, storeys - 1),
                                  .cells = static_cast<int>(cells),
                                  .other = other_model(question, node)});
}

}  // namespace rovernet
