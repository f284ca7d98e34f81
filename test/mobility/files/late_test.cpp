// SPDX-License-Identifier: MIT
// Movement files that end after the longest run tell where.
#include "mobility/files/movement_file.hpp"
#include "sim/error.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <string>

namespace late_test {
using namespace rovernet;

namespace {

/// Place of the command that ends last.
Location place(const std::string& name, const std::string& text) {
    const test::TemporaryFolder folder;
    Location where = MovementFile(folder.write(name, text)).end_where();
    CHECK(where.source == folder.path(name));
    return where;
}

void check_place(const std::string& name, const std::string& text, int line, int column) {
    CAPTURE(text);
    const Location where = place(name, text);
    CHECK(where.line == line);
    CHECK(where.column == column);
}

const std::string starts = "$node_(0) set X_ 1\n$node_(1) set X_ 1\n";

}  // namespace

TEST_CASE(
    "movement file: for an ns-2 motion that begins or ends after 1e9 s, the error names the line") {
    const std::string at_late = "$ns_ at 2e9 \"$node_(0) setdest 5 5 1\"\n",
                      at_five = "$ns_ at 5 \"$node_(1) setdest 5 5 1\"\n",
                      slow = "$ns_ at 1 \"$node_(0) setdest 500 500 1e-7\"\n",
                      stop = "$ns_ at 4 \"$node_(0) setdest 2 2 1\"\n";
    check_place("a.tcl", starts + at_late, 3, 1);
    check_place("a.tcl", starts + at_five + at_late, 4, 1);
    check_place("a.tcl", starts + at_late + at_five, 3, 1);
    check_place("a.tcl", starts + slow + at_five, 3, 1);
    check_place("a.tcl", starts + at_five + slow, 4, 1);
    check_place("a.tcl", starts + slow + stop + at_five, 0, 0);
    check_place("a.tcl", starts + at_five, 0, 0);
}

TEST_CASE("movement file: for a BonnMotion waypoint after 1e9 s, the error names line and column") {
    check_place("a.movements", "0 0 0 2e9 5 5\n", 1, 7);
    check_place("a.movements", "0 0 0 5 5 5\n0 1 1 7 8 8 1.5e9 9 9 2e9 1 1\n0 0 0 4 4 4\n", 2, 23);
    check_place("a.movements", "0 0 0 1e9 5 5\n", 0, 0);
}

TEST_CASE("movement file: for a SUMO timestep after 1e9 s, the error names the line") {
    const auto step = [](const std::string& time) {
        return "<timestep time=\"" + time +
               "\">\n<vehicle id=\"a\" x=\"1\" y=\"2\"/>\n</timestep>\n";
    };
    const std::string begin = "<fcd-export>\n", end = "</fcd-export>\n";
    check_place("a.xml", begin + step("0") + step("2e9") + end, 5, 17);
    check_place("a.xml", begin + step("0") + step("1e9") + end, 0, 0);
}

}  // namespace late_test
