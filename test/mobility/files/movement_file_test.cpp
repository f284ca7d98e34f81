// SPDX-License-Identifier: MIT
#include "mobility/files/movement_file.hpp"

#include "sim/error.hpp"
#include "test/mobility/files/playback.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <string>
#include <utility>

namespace movement_file_test {
using namespace rovernet;
using test::movement_error;
using test::Playback;
using test::TemporaryFolder;

namespace {

std::string error_of(const std::string& text) {
    const TemporaryFolder folder;
    return movement_error(folder.write("file", text));
}
std::string first_robot(const std::string& name, const std::string& text) {
    const TemporaryFolder folder;
    return Playback(folder.write(name, text)).file.robots().at(0).name;
}

}  // namespace

TEST_CASE("movement file: the format is recognised by the first bytes, not by the name") {
    const std::string tcl = "# nodes: 1\n$node_(4) set X_ 1\n";
    const std::string bonnmotion = "\n# nodes: 1\n +0.5 1 2\n";
    const std::string fcd =
        "\n<fcd-export><timestep time='0'><vehicle id='v' x='0' y='0'/></timestep></fcd-export>";
    for (const std::string name : {"a.tcl", "a.movements", "a.xml", "a.gz", "a"}) {
        CHECK(first_robot(name, tcl) == "n4");
        CHECK(first_robot(name, bonnmotion.substr(1)) == "n0");
        CHECK(first_robot(name, fcd) == "v");
        CHECK(first_robot(name, "\xef\xbb\xbf" + tcl) == "n4");
        CHECK(first_robot(name, "\xef\xbb\xbf" + fcd) == "v");
    }
}

TEST_CASE(
    "movement file: a file of an unknown format is refused; the error lists the known formats") {
    const std::string kinds =
        "a movement file: of ns-2 (setdest), of BonnMotion (.movements) or of SUMO (FCD, XML)";
    CHECK(error_of("") == "file: the file is empty, expected " + kinds);
    CHECK(error_of(" \n\t\r\n") == "file: the file is empty, expected " + kinds);
    CHECK(error_of("# c\n  \x01") == "file:2:3: found \"?\", expected " + kinds);
    CHECK(error_of("{}") == "file:1:1: found \"{\", expected " + kinds);
    CHECK(error_of("\x1f\x8b").starts_with("file: cannot read the file"));
    CHECK(error_of("# a comment only\n") == "");
    const TemporaryFolder folder;
    CHECK(movement_error(folder.path("missing")) == "missing: cannot read the file: no such file");
    CHECK(movement_error(folder.path("missing/file")) != "");
    CHECK_THROWS_AS(MovementFile(folder.path("")), InputError);
    CHECK_THROWS_AS(MovementFile(""), InputError);
    CHECK_THROWS_AS(MovementFile("/dev/null"), InputError);
}

TEST_CASE(
    "movement file: a reader that is moved to another object (std::move) continues at its place in "
    "the file") {
    const TemporaryFolder folder;
    const auto path = folder.write(
        "a", "$ns_ at 1 \"$node_(0) setdest 1 0 1\"\n$ns_ at 2 \"$node_(0) setdest 2 0 1\"\n");
    MovementFile a(path);
    CHECK(a.next()->to == Vec3{1, 0, 0});
    MovementFile b(std::move(a));
    CHECK(b.next()->to == Vec3{2, 0, 0});
    CHECK_FALSE(b.next());
    CHECK_FALSE(b.next());
    CHECK(b.robots().size() == 1);
}

TEST_CASE("movement file: if a file changes while it is read, this is an input error") {
    const TemporaryFolder folder;
    const std::string line = "$ns_ at 1 \"$node_(0) setdest 1 0 1\"\n";
    // Longer than what is read ahead.
    std::string text;
    while (text.size() < 1'000'000) text += line;
    MovementFile file(folder.write("a", text));
    REQUIRE(file.next());
    std::string other = "$ns_ at 1 \"$node_(9) setdest 1 0 1\"\n";
    while (other.size() < 1'000'000) other += other.substr(0, 36);
    folder.write("a", other);
    CHECK_THROWS_AS(
        [&] {
            while (file.next()) continue;
        }(),
        InputError);
}

}  // namespace movement_file_test
