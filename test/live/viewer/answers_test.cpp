// SPDX-License-Identifier: MIT
#include "live/viewer/answers.hpp"

#include "experiment/replay/message_at_robot.hpp"
#include "experiment/replay/recorded_day.hpp"
#include "experiment/reports/link_report.hpp"
#include "experiment/reports/link_table.hpp"
#include "experiment/reports/network_at.hpp"
#include "experiment/run.hpp"
#include "pictures/map/coverage.hpp"
#include "pictures/map/picture.hpp"
#include "pictures/viewer/view_run.hpp"
#include "scenario/document/json.hpp"
#include "scenario/scenario_file.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace answers_test {
using namespace rovernet;
using namespace std::chrono_literals;

namespace {

const std::string rescue = std::string(ROVERNET_EXAMPLES) + "/rescue/rescue.toml";

/// Recorded trace of the rescue.
struct Recorded {
    explicit Recorded(std::vector<std::string> set = {}) {
        ScenarioOptions options;
        options.set = std::move(set);
        options.set.emplace_back("trace.record=true");
        RunOptions run;
        run.folder = folder.path("run");
        run_scenario(load_scenario(rescue, options), run);
    }
    std::string path() const { return folder.path("run/trace.mcap"); }
    test::TemporaryFolder folder;
};

Value ask(ViewerAnswers& answers, const std::string& question) {
    return parse_json(answers.answer(question));
}
std::string error_of(ViewerAnswers& answers, const std::string& question) {
    const Value answer = ask(answers, question);
    const Value* error = answer.table()->find("error");
    return error ? *error->string() : "";
}

std::string json(const Table& table) { return to_json(parse_json(to_json_line(table))); }
std::string json(const Value* value) { return to_json(*value); }

}  // namespace

TEST_CASE(
    "viewer answers: link budgets and reasons of missed messages equal those of the command line") {
    const Recorded run;
    ViewerAnswers answers({run.path()});
    const Scenario scenario = load_scenario(rescue, {});
    const Value pair =
        ask(answers, R"({"id": 7, "op": "pair", "a": 0, "b": 4, "t_ns": 10000000000})");
    const Array& links = *pair.table()->find("links")->array();
    REQUIRE(links.size() == 2);
    const auto equals = [](const Value& link, const Table& expected) {
        return std::all_of(expected.entries.begin(), expected.entries.end(),
                           [&](const Entry& entry) {
                               return json(link.table()->find(entry.key)) == json(&entry.value);
                           });
    };
    CHECK(equals(links[0], link_document(report_link(scenario, "A", "E", Time(10s)))));
    CHECK(equals(links[1], link_document(report_link(scenario, "E", "A", Time(10s)))));
    CHECK_FALSE(equals(links[0], link_document(report_link(scenario, "A", "E", Time(9s)))));
    CHECK(json(&links[0]) != json(&links[1]));
    CHECK(json(pair.table()->find("id")) == "7\n");

    const Value why = ask(answers, R"({"id": 8, "op": "why", "uid": 0, "robot": 4})");
    const Table expected = document_of(message_at_robot(run.path(), 0, NodeId{4}));
    for (const char* key : {"robot", "frames", "answer"})
        CHECK(json(why.table()->find(key)) == json(parse_json(json(expected)).table()->find(key)));

    const Value robot =
        ask(answers, R"({"id": 9, "op": "robot", "robot": 0, "t_ns": 10000000000})");
    CHECK(*robot.table()->find("robot")->string() == "A");
    CHECK(robot.table()->find("links")->array()->size() == 2);

    const Value map =
        ask(answers,
            R"({"id": 1, "op": "coverage", "robot": 1, "t_ns": 0, "storey": 0, "cells": 1000})");
    const auto number = [&](const char* key) {
        return std::get<std::int64_t>(map.table()->find(key)->data);
    };
    CHECK(number("columns") * number("rows") > 500);
    CHECK(map.table()->find("dbm")->array()->size() ==
          static_cast<std::size_t>(number("columns") * number("rows")));
}

TEST_CASE("viewer answers: links equal the robots' link tables, also at earlier times") {
    const Recorded run;
    ViewerAnswers answers({run.path()});
    const Scenario scenario = load_scenario(rescue, {});
    for (const std::int64_t s : {10, 40, 0, 41}) {
        CAPTURE(s);
        const auto network = network_at(scenario, Time(std::chrono::seconds(s)));
        std::map<std::pair<std::string, std::string>, double> expected, found;  // levels [dBm]
        for_each_link_table(*network, {}, [&](const LinkTable& table) {
            for (const LinkTable::Row& row : table.rows)
                expected[{row.neighbour.robot, table.device.robot}] = row.level.value;
        });
        const Value all = ask(
            answers, fmt::format(R"({{"id": 1, "op": "links", "t_ns": {}}})", s * 1'000'000'000));
        const auto column = [&](const char* key) { return *all.table()->find(key)->array(); };
        const Array from = column("from"), to = column("to"), two_way = column("two_way"),
                    level = column("level_dbm"), margin = column("margin_db"),
                    back = column("back_level_dbm");
        const auto name = [&](const Value& robot) {
            return network->name(
                NodeId{static_cast<std::uint32_t>(std::get<std::int64_t>(robot.data))});
        };
        for (std::size_t i = 0; i < from.size(); ++i) {
            const std::string a = name(from[i]), b = name(to[i]);
            found[{a, b}] = std::get<double>(level[i].data);
            if (std::get<bool>(two_way[i].data)) found[{b, a}] = std::get<double>(back[i].data);
            const LinkReport report = report_link(scenario, a, b, network->now());
            CHECK(std::abs(std::get<double>(margin[i].data) - report.margin.value) < 1e-9);
        }
        CHECK(found.size() > 4);
        CHECK(found.size() == expected.size());
        for (const auto& [link, dbm] : expected) CHECK(std::abs(found[link] - dbm) < 1e-9);
    }
    const Value one = ask(answers, R"({"id": 1, "op": "links", "t_ns": 10000000000, "robot": 0})");
    CHECK(one.table()->find("from")->array()->size() == 2);
    CHECK(error_of(answers, R"({"id": 1, "op": "links", "t_ns": 0, "robot": 5})") != "");
}

TEST_CASE("viewer answers: terms of a link budget add up to the received power and the margin") {
    const Recorded run({"radio.antenna_gain=2.1 dB", "radio.cable_loss=0.7 dB"});
    ViewerAnswers answers({run.path()});
    const Value pair =
        ask(answers, R"({"id": 7, "op": "pair", "a": 0, "b": 4, "t_ns": 10000000000})");
    for (const Value& link : *pair.table()->find("links")->array()) {
        const auto of = [&](const char* key) {
            return std::get<double>(link.table()->find(key)->data);
        };
        CHECK(of("sender_gain_db") == 2.1);
        CHECK(of("receiver_cable_loss_db") == 0.7);
        const double received = of("power_dbm") + of("sender_gain_db") -
                                of("sender_cable_loss_db") - of("path_loss_db") +
                                of("receiver_gain_db") - of("receiver_cable_loss_db");
        CHECK(std::abs(received - of("rx_power_dbm")) < 1e-9);
        CHECK(std::abs(received - of("sensitivity_dbm") - of("margin_db")) < 1e-9);
    }
}

TEST_CASE(
    "viewer answers: neighbours of a robot have margins, which equal those of rovernet link") {
    const Recorded run;
    ViewerAnswers answers({run.path()});
    const Scenario scenario = load_scenario(rescue, {});
    const Value robot =
        ask(answers, R"({"id": 9, "op": "robot", "robot": 0, "t_ns": 10000000000})");
    const Array& links = *robot.table()->find("links")->array();
    REQUIRE(!links.empty());
    for (const Value& link : links) {
        const LinkReport report =
            report_link(scenario, *link.table()->find("robot")->string(), "A", Time(10s));
        const double margin = std::get<double>(link.table()->find("margin_db")->data);
        CHECK(std::abs(margin - report.margin.value) < 1e-9);
    }
}

TEST_CASE("viewer answers: if the map is hidden, answers that would show walls are refused") {
    const Recorded run;
    ViewerAnswers answers({run.path()}, {run.path()});
    answers.hide_map();
    for (const char* question :
         {R"({"id": 1, "op": "pair", "a": 0, "b": 4, "t_ns": 0})",
          R"({"id": 1, "op": "pair", "a": 0, "b": 4, "t_ns": 0, "run": 1})",
          R"({"id": 1, "op": "svg", "t_ns": 0, "storey": 0})",
          R"({"id": 1, "op": "coverage", "robot": 1, "t_ns": 0, "storey": 0, "cells": 100})"}) {
        CAPTURE(question);
        CHECK(error_of(answers, question).find("--no-map") != std::string::npos);
    }
    const char* const why = R"({"id": 1, "op": "why", "uid": 0, "robot": 4})";
    CHECK(answers.answer(why).find("wall") == std::string::npos);
    CHECK(ViewerAnswers({run.path()}).answer(why).find("wall_m") != std::string::npos);
    CHECK(error_of(answers, R"({"id": 1, "op": "links", "t_ns": 0})").empty());
    CHECK(error_of(answers, R"({"id": 1, "op": "robot", "robot": 1, "t_ns": 0})").empty());
}

TEST_CASE("viewer answers: links under the model `disc` have neither level nor margin") {
    const Recorded run({"propagation.model=disc", "propagation.range=30 m"});
    ViewerAnswers answers({run.path()});
    const Value all = ask(answers, R"({"id": 1, "op": "links", "t_ns": 0})");
    const Array& margins = *all.table()->find("margin_db")->array();
    REQUIRE(!margins.empty());
    for (const Value& margin : margins) CHECK(std::holds_alternative<std::monostate>(margin.data));
}

TEST_CASE("viewer answers: a question with run number 1 is answered for the second run") {
    const Recorded run;
    const std::string path = run.folder.path("other.mcap");
    RecordedDay(run.path()).record(path, {"propagation.model=friis"});
    ViewerAnswers both({run.path()}, {path}), first({run.path()}), second({path});
    const std::string pair = R"({"id": 1, "op": "pair", "a": 0, "b": 4, "t_ns": 10000000000)";
    CHECK(both.answer(pair + "}") == first.answer(pair + "}"));
    CHECK(both.answer(pair + R"(, "run": 0})") == first.answer(pair + "}"));
    CHECK(both.answer(pair + R"(, "run": 1})") == second.answer(pair + "}"));
    CHECK(first.answer(pair + "}") != second.answer(pair + "}"));
    CHECK(error_of(first, pair + R"(, "run": 1})") != "");
    CHECK(error_of(both, pair + R"(, "run": 2})") != "");
}

TEST_CASE(
    "viewer answers: coverage, contours and the difference of two models equal those computed "
    "directly") {
    const Recorded run;
    ViewerAnswers answers({run.path()});
    const auto levels_under = [&](std::vector<std::string> set) {
        ScenarioOptions options;
        options.set = std::move(set);
        const auto network = network_at(load_scenario(rescue, options), Time(10s));
        const NodeId b{1};
        const Scene& scene = network->scene();
        return coverage(transmitter(*network, b, b, 0, network->now()), scene.lower_left(),
                        scene.upper_right(), 2000);
    };
    const CoverageMap own = levels_under({}), other = levels_under({"propagation.model=friis"});
    const Value answer =
        ask(answers, R"({"id": 1, "op": "coverage", "robot": 1, "t_ns": 10000000000, "storey": 0,
                         "cells": 2000, "with": "propagation.model=friis"})");
    const Array& dbm = *answer.table()->find("dbm")->array();
    const Array& difference = *answer.table()->find("difference_db")->array();
    REQUIRE(dbm.size() == own.dbm.size());
    REQUIRE(difference.size() == own.dbm.size());
    constexpr double half_digit = 0.5001e-3;  // of three decimals
    double most = 0;
    const auto number = [](const Value& value) {
        const auto* whole = std::get_if<std::int64_t>(&value.data);
        return whole ? static_cast<double>(*whole) : std::get<double>(value.data);
    };
    for (std::size_t i = 0; i < dbm.size(); ++i) {
        CHECK(std::abs(number(dbm[i]) - own.dbm[i]) < half_digit);
        CHECK(std::abs(number(difference[i]) - (other.dbm[i] - own.dbm[i])) < half_digit);
        most = std::max(most, number(difference[i]));
    }
    CHECK(most > 10);
    const Array& contours = *answer.table()->find("contours")->array();
    REQUIRE(contours.size() == 2);
    const Array& lines = *contours[0].table()->find("lines")->array();
    const Array& points = *lines[0].array();
    CHECK(points.size() > 10);
    CHECK(points.size() % 2 == 0);
    for (const char* with : {"radio.power=1 dBm", "propagation.model=nothing",
                             "scene.map=/etc/passwd", "propagation.model=disc"}) {
        CAPTURE(with);
        const std::string question = fmt::format(
            R"({{"id": 1, "op": "coverage", "robot": 1, "t_ns": 0, "storey": 0, "cells": 100, "with": "{}"}})",
            with);
        CHECK(error_of(answers, question) != "");
    }
}

TEST_CASE(
    "viewer answers: with the model `disc`, coverage is the range of the disc, without levels") {
    const Recorded run({"propagation.model=disc", "propagation.range=12 m"});
    ViewerAnswers answers({run.path()});
    const Value answer =
        ask(answers,
            R"({"id": 1, "op": "coverage", "robot": 1, "t_ns": 0, "storey": 0, "cells": 1000})");
    for (const Value& level : *answer.table()->find("dbm")->array())
        CHECK(std::holds_alternative<std::monostate>(level.data));
    const Table& contour = *(*answer.table()->find("contours")->array())[0].table();
    CHECK(json(contour.find("range_m")) == "12.0\n");
    CHECK(!contour.find("lines")->array()->empty());
}

TEST_CASE("viewer answers: the drawing equals that of the command `draw`") {
    const Recorded run;
    ViewerAnswers answers({run.path()});
    const Value answer = ask(answers, R"({"id": 1, "op": "svg", "t_ns": 10000000000, "storey": 0,
                                          "links": true})");
    const PictureOptions options{.at = Time(10s), .links = true};
    CHECK(*answer.table()->find("svg")->string() == draw_svg(load_scenario(rescue, {}), options));
    CHECK(error_of(answers, R"({"id": 1, "op": "svg", "t_ns": 0, "storey": 1})") != "");
}

TEST_CASE(
    "viewer answers: an invalid question gets an error with its id, the next question an answer") {
    const Recorded run;
    ViewerAnswers answers({run.path()});
    CHECK(error_of(answers, "no json") != "");
    CHECK(error_of(answers, "[]") != "");
    CHECK(error_of(answers, R"({"id": 1})") != "");
    CHECK(error_of(answers, R"({"id": 1, "op": "stop"})").find("expected \"why\", \"air\"") !=
          std::string::npos);
    CHECK(error_of(answers, R"({"id": 1, "op": "pair", "a": 0, "b": 0, "t_ns": 0})") != "");
    CHECK(error_of(answers, R"({"id": 1, "op": "pair", "a": 0, "b": 5, "t_ns": 0})") != "");
    CHECK(error_of(answers, R"({"id": 1, "op": "robot", "robot": 0, "t_ns": 90000000001})") != "");
    CHECK(error_of(answers, R"({"id": 1, "op": "why", "uid": -1, "robot": 0})") != "");
    ViewerAnswers of_index({run.path(), view_of_trace(run.path(), {}).index});
    CHECK(error_of(of_index, R"({"id": 1, "op": "why", "uid": 0, "robot": 0})") == "");
    CHECK(error_of(of_index, R"({"id": 1, "op": "why", "uid": 999, "robot": 0})")
              .find("there is no message 999 in this run") != std::string::npos);
    const char* many = R"({"id": 1, "op": "coverage", "robot": 0, "t_ns": 0, "storey": 0,
                           "cells": 250001})";
    CHECK(error_of(answers, many) != "");
    CHECK(error_of(answers, "{\"id\": 1, \"op\": \"" + std::string(70'000, 'x') + "\"}")
              .find("64 KiB") != std::string::npos);
    const Value too_long = ask(
        answers, "{\"id\": 5, \"op\": \"command\", \"do\": \"" + std::string(70'000, 'x') + "\"}");
    CHECK(json(too_long.table()->find("id")) == "5\n");
    const Value last = ask(answers, R"({"id": 3, "op": "robot", "robot": 9, "t_ns": 0})");
    CHECK(json(last.table()->find("id")) == "3\n");
    CHECK(error_of(answers, R"({"id": 1, "op": "robot", "robot": 0, "t_ns": 0})").empty());
}

TEST_CASE("viewer answers: any input of a page gets an answer in JSON") {
    const Recorded run;
    ViewerAnswers answers({run.path()});
    const std::vector<std::string> questions = {
        R"({"id": 1, "op": "pair", "a": 0, "b": 4, "t_ns": 10000000000})",
        R"({"id": 1, "op": "robot", "robot": 3, "t_ns": 0})",
        R"({"id": 1, "op": "links", "t_ns": 5000000000, "robot": 1})",
        R"({"id": 1, "op": "coverage", "robot": 1, "t_ns": 0, "storey": 0, "cells": 50})"};
    std::mt19937 draw(7);
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(draw() % n); };
    int errors = 0, rounds = 0;
    for (; rounds < 1500; ++rounds) {
        std::string question = questions[below(questions.size())];
        for (std::size_t changes = 1 + below(3); changes > 0; --changes) {
            const std::size_t at = below(question.size());
            switch (below(4)) {
                case 0: question[at] = static_cast<char>(below(256)); break;
                case 1: question.erase(at, 1 + below(8)); break;
                case 2:
                    question.insert(at, std::string(1 + below(5), "9[{\"-e.\\"[below(9)]));
                    break;
                default: question.insert(at, question.substr(below(question.size()), 12)); break;
            }
            if (question.empty()) question = "{";
        }
        CAPTURE(question);
        const Value answer = parse_json(answers.answer(question));
        REQUIRE(answer.table());
        errors += answer.table()->find("error") ? 1 : 0;
    }
    CHECK(errors > rounds / 2);
    CHECK(errors < rounds);
    CHECK(error_of(answers, questions[0]).empty());
}

}  // namespace answers_test
