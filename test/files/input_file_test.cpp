// SPDX-License-Identifier: MIT
#include "files/input_file.hpp"

#include "files/text_source.hpp"
#include "sim/error.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <sys/stat.h>
#include <thread>

namespace input_file_test {
using namespace rovernet;

namespace {

/// What is said of a path that is read; what was read if nothing.
std::string said(const std::string& path) {
    try {
        return "read: " + InputFile(path).read(100);
    } catch (const InputError& error) {
        CHECK(error.where().source == path);
        return error.message();
    }
}

}  // namespace

TEST_CASE(
    "input file: a path that is not a readable file is refused, and the error names its kind") {
    const test::TemporaryFolder folder;
    std::filesystem::create_symlink("loop", folder.path("loop"));
    std::filesystem::create_symlink("b", folder.path("a"));
    std::filesystem::create_symlink("a", folder.path("b"));
    std::filesystem::create_symlink("x.txt", folder.path("link"));
    folder.write("x.txt", "text");
    const std::string begin = "cannot read the file: ";
    CHECK(said(folder.path("x.txt")) == "read: text");
    CHECK(said(folder.path("link")) == "read: text");
    CHECK(said(folder.path("none")) == begin + "no such file");
    CHECK(said(folder.path("x.txt/y")) == begin + "no such file");
    CHECK(said(folder.path("loop")) == begin + "its path is a loop of symbolic links");
    CHECK(said(folder.path("a")) == begin + "its path is a loop of symbolic links");
    CHECK(said(folder.path(".")) == begin + "it is a folder");
    CHECK(said(folder.path(std::string(300, 'x'))) ==
          begin + "its folder cannot be entered, or its name is too long");
    for (const char* endless : {"/dev/zero", "/dev/full", "/dev/urandom"}) {
        CHECK(said(endless) == begin + "it is a device, not a regular file");
    }
    CHECK(said("/dev/null") == "read: ");
    CHECK(said("") == begin + "no such file");
}

TEST_CASE(
    "input file: a FIFO is read once a writer opens it, and refused if none does within 5 s") {
    const test::TemporaryFolder folder;
    const std::string path = folder.path("fifo");
    REQUIRE(mkfifo(path.c_str(), 0600) == 0);
    std::thread writer([&] { std::ofstream(path) << "late"; });
    CHECK(said(path) == "read: late");
    writer.join();
    CHECK(said(path) ==
          "cannot read the file: it is a FIFO into which no program has written for "
          "5 s");
}

TEST_CASE("input file: a pipe is refused where a regular file is needed") {
    const test::TemporaryFolder folder;
    const std::string path = folder.path("fifo");
    REQUIRE(mkfifo(path.c_str(), 0600) == 0);
    CHECK_THROWS_WITH_AS(
        need_file(path),
        (path + ": cannot read the file: it is a pipe, not a regular file").c_str(), InputError);
    CHECK_THROWS_AS(TextSource(path, TextSource::Reads::twice), InputError);
    need_file(folder.write("x.txt", ""));
}

TEST_CASE(
    "input file: if a path has a wrong folder, the file of the same name in the given folder is "
    "found") {
    const test::TemporaryFolder folder;
    const std::string here = folder.path("");
    folder.write("room.pgm", "");
    std::filesystem::create_directory(folder.path("maps"));
    folder.write("maps/room.pgm", "");
    for (const char* name :
         {"/home/x/room.pgm", "~/maps/room.pgm", "a/room.pgm", "C:\\m\\room.pgm"})
        CHECK_MESSAGE(named_beside(here, name) == "room.pgm", name);
    CHECK(named_beside(here, "maps/room.pgm") == "");  // it is where it is said to be
    CHECK(named_beside(here, folder.path("room.pgm")) == "");
    for (const char* name : {"gone.pgm", "~/gone.pgm", "x/", "x/maps", ""})
        CHECK_MESSAGE(named_beside(here, name) == "", name);
}

}  // namespace input_file_test
