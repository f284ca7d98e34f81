// SPDX-License-Identifier: MIT
#include "files/part_file.hpp"

#include "sim/error.hpp"
#include "test/files/no_room.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <iterator>
#include <optional>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace part_file_test {
using namespace rovernet;
using test::TemporaryFolder;

namespace {

std::string content(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> names_in(const TemporaryFolder& folder) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path(""))) {
        names.push_back(entry.path().filename());
    }
    std::sort(names.begin(), names.end());
    return names;
}

/// A process that begins a file and is killed.
void write_and_die(const std::string& path) {
    const pid_t child = fork();
    if (child == 0) {
        PartFile file(path);
        file.write("half");
        std::raise(SIGKILL);
    }
    waitpid(child, nullptr, 0);
}

}  // namespace

TEST_CASE("part file: the file gets its final name only when it is complete") {
    const TemporaryFolder folder;
    const std::string path = folder.write("f", "yesterday's");
    PartFile file(path);
    file.write("to");
    file.write("day's");
    file.close();
    CHECK(content(path) == "yesterday's");
    CHECK(names_in(folder).size() == 2);
    file.give_name();
    CHECK(content(path) == "today's");
    CHECK(names_in(folder) == std::vector<std::string>{"f"});
}

TEST_CASE(
    "part file: if a new file is not completed, the old file stays, and no partial file remains") {
    const TemporaryFolder folder;
    const std::string path = folder.write("f", "yesterday's");
    { PartFile(path).write("half"); }
    CHECK(content(path) == "yesterday's");
    CHECK(names_in(folder) == std::vector<std::string>{"f"});
}

TEST_CASE(
    "part file: if two writers write a file simultaneously, the last to complete determines its "
    "text") {
    const TemporaryFolder folder;
    PartFile first(folder.path("f")), second(folder.path("f"));
    first.write("first");
    second.write("second");
    CHECK(names_in(folder).size() == 2);
    second.give_name();
    CHECK(content(folder.path("f")) == "second");
    first.give_name();
    CHECK(content(folder.path("f")) == "first");
    CHECK(names_in(folder) == std::vector<std::string>{"f"});
}

TEST_CASE(
    "part file: the next writer removes the partial file of a killed process, and no other files") {
    const TemporaryFolder folder;
    write_and_die(folder.path("f"));
    REQUIRE(names_in(folder).size() == 1);
    for (const char* other : {"f.part", "f.1x.part", "ff.1.part", "f.1.parts"}) {
        folder.write(other, "");
    }
    const PartFile alive(folder.path("f"));
    std::optional<PartFile> file(folder.path("f"));
    CHECK(names_in(folder).size() == 6);
    file.reset();
    CHECK(names_in(folder).size() == 5);
}

TEST_CASE("part file: a full disk is reported, and no partial file remains") {
    const TemporaryFolder folder;
    const test::NoRoom none;
    PartFile file(folder.path("f"));
    CHECK_THROWS_WITH_AS(file.write("x"),
                         (folder.path("f") + ": cannot be written: File too large").c_str(),
                         RunError);
    CHECK(names_in(folder).empty());
    CHECK_THROWS_AS(file.write("x"), RunError);
    CHECK_THROWS_AS(file.give_name(), RunError);
}

TEST_CASE("part file: a path that cannot be written is reported immediately") {
    const TemporaryFolder folder;
    CHECK_THROWS_WITH_AS(
        PartFile(folder.path("no/f")),
        (folder.path("no/f") + ": cannot be written: No such file or directory").c_str(), RunError);
    CHECK_THROWS_WITH_AS(
        PartFile("/dev/null"),
        "/dev/null: cannot be written: a file of this name exists, and it is not a regular file",
        RunError);
}

}  // namespace part_file_test
