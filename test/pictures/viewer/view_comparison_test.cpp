// SPDX-License-Identifier: MIT
#include "pictures/viewer/view_comparison.hpp"

#include "pictures/viewer/view_file.hpp"
#include "test/pictures/viewer/view_reader.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <string>
#include <vector>

namespace view_comparison_test {
using namespace rovernet;
using namespace std::chrono_literals;

namespace {

/// Comparison of a run with messages 0 and 1 of robot 0 with a run that has message 1, a control
/// packet, and message 2.
ViewComparison comparison() {
    ViewComparison made{.names = {"one", "other"}, .result = {}, .messages = {{0, 0}, {0, 1}}};
    made.result.gained = 1;
    made.result.lost = 2;
    made.result.same = 4;
    made.result.changes = {
        {{NodeId{0}, 0, NodeId{1}, Time(1s)}, false, Time(2s), {}},
        {{NodeId{0}, 1, NodeId{2}, Time(2s)}, false, Time(3s), Fate::collided},
        {{NodeId{0}, 2, NodeId{1}, Time(3s)}, true, Time(4s), {}},
    };
    made.result.first.is_equal = false;
    made.result.first.field = "time";
    made.result.first.a = {{7, "s 1"}};
    return made;
}

test::ViewReader written(const ViewComparison& made) {
    ViewFile file;
    Table head;
    write_comparison(made, {{0, 1}, {0, no_index}, {0, 2}}, 3, file, head);
    return test::ViewReader(file.bytes(std::move(head)));
}

}  // namespace

TEST_CASE("view of a comparison: messages of the two traces are matched by origin and number") {
    const test::ViewReader view = written(comparison());
    constexpr double nobody = 4'294'967'295;
    CHECK(view.numbers("compare.messages") == std::vector<double>{1, nobody, nobody});
    CHECK(view.numbers("compare.first") == std::vector<double>{0, 1, nobody});
    CHECK(view.numbers("compare.second") == std::vector<double>{nobody, 0, 2});
}

TEST_CASE(
    "view of a comparison: the file has a row for each gained or lost delivery, and the totals") {
    const test::ViewReader view = written(comparison());
    CHECK(view.numbers("compare.time") == std::vector<double>{2e9, 3e9, 4e9});
    CHECK(view.numbers("compare.robot") == std::vector<double>{1, 2, 1});
    CHECK(view.numbers("compare.gained") == std::vector<double>{0, 0, 1});
    CHECK(view.numbers("compare.outcome") ==
          std::vector<double>{255, 2.0 * static_cast<int>(Fate::collided), 255});
    const Table& told = *view.head().find("compare")->table();
    CHECK(*(*told.find("runs")->array())[1].string() == "other");
    CHECK(test::ViewReader::integer(told, "gained") == 1);
    CHECK(test::ViewReader::integer(told, "lost") == 2);
    CHECK(test::ViewReader::integer(told, "same") == 4);
}

TEST_CASE(
    "view of a comparison: the file has the first difference, with null for a trace that has "
    "already ended") {
    const test::ViewReader view = written(comparison());
    const Table& first = *view.head().find("compare")->table()->find("first")->table();
    CHECK(*first.find("field")->string() == "time");
    CHECK(*first.find("a")->string() == "s 1");
    CHECK(first.find("b")->string() == nullptr);
    ViewComparison equal = comparison();
    equal.result.first = {};
    CHECK(written(equal).head().find("compare")->table()->find("first") == nullptr);
}

}  // namespace view_comparison_test
