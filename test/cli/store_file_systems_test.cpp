// SPDX-License-Identifier: MIT
// Stores on the file systems of clusters: without shared mappings, without locks.
#include "study/store.hpp"
#include "test/cli/process.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace store_file_systems_test {
using namespace rovernet;
using namespace rovernet::test;
namespace fs = std::filesystem;

namespace {

const std::string pair = R"([scenario]
duration = "1 s"
[[robot]]
name = "A"
at = ["0 m", "0 m"]
[[robot]]
name = "B"
place = { model = "uniform", area = [["0 m", "0 m"], ["500 m", "500 m"]] }
[[traffic]]
from = "A"
size = "20 B"
every = "100 ms"
[study]
replications = 30
)";

/// What file_system_lacks.cpp takes away, and what an error then says of another writer.
struct Kind {
    const char* lacks;
    const char* refusal;
    bool has_readers;  // while one writes
    bool has_wal = false;
};
constexpr const char* flocked = "a different sweep is writing";
constexpr const char* named = "writes to this store, as the file";
constexpr Kind kinds[] = {{"nothing", flocked, true, true},
                          {"shared", flocked, true},
                          {"maps", flocked, true},
                          {"whole", named, true},
                          {"nfs maps", named, true},
                          {"ranges", flocked, false},
                          {"maps whole ranges", named, false}};

struct Place {
    TemporaryFolder folder{};
    std::string file = folder.write("s.toml", pair);
    std::string store = folder.path("s.db");

    static std::vector<std::string> on(const std::string& lacks, std::vector<std::string> words) {
        // The sanitizers want to be the first library, without need.
        const std::vector<std::string> begin{"LD_PRELOAD=" ROVERNET_LACKS, "LACKS=" + lacks,
                                             "ASAN_OPTIONS=verify_asan_link_order=0",
                                             ROVERNET_COMMAND};
        words.insert(words.begin(), begin.begin(), begin.end());
        return words;
    }
    std::vector<std::string> sweep(const std::string& lacks, const char* duration = "1 s") const {
        return on(lacks, {"sweep", file, "--workers", "2", "--set",
                          std::string("scenario.duration=") + duration, "--set",
                          "scenario.event_limit=1000000000000"});
    }
    /// Runs the command in a folder of its own for what it prints.
    static Ended run(const std::vector<std::string>& words) {
        const TemporaryFolder other;
        return Process(other, words, "/usr/bin/env").wait();
    }
    Ended results(const std::string& lacks) const {
        return run(on(lacks, {"results", store, "--csv"}));
    }
    /// Names of the store and of the files beside it, with blanks between them.
    std::string files() const {
        std::set<std::string> names;
        for (const auto& each : fs::directory_iterator(folder.path("")))
            if (each.path().filename().string().starts_with("s.db"))
                names.insert(each.path().filename());
        return fmt::format("{}", fmt::join(names, " "));
    }
    /// Number of finished runs, when nobody writes any more; 0 if the sweep was killed before it
    /// had made its store.
    std::size_t finished() const {
        for (int i = 0;; ++i) {
            try {
                return Store::open(store).runs().size();
            } catch (const std::exception& error) {
                if (std::string(error.what()).find("has no runs yet") != std::string::npos)
                    return 0;
                if (i == 500) throw;
                wait_a_moment();
            }
        }
    }
    static void wait_a_moment() { usleep(10'000); }
};

}  // namespace

TEST_CASE("store: a sweep on any file system gives the same results, and leaves one file") {
    std::string expected;
    for (const Kind& kind : kinds) {
        CAPTURE(kind.lacks);
        const Place place;
        const Ended swept = Place::run(place.sweep(kind.lacks));
        CAPTURE(swept.err);
        CHECK(swept.exit == 0);
        CHECK(place.files() == "s.db");
        const Ended read = place.results(kind.lacks);
        CHECK(read.exit == 0);
        if (expected.empty()) expected = read.out;
        CHECK(read.out == expected);
        CHECK(place.results("nothing").out == expected);
    }
}

TEST_CASE("store: on any file system, while one sweep writes a store, a second sweep is refused") {
    for (const Kind& kind : kinds) {
        CAPTURE(kind.lacks);
        const Place place;
        const Process first(place.folder, place.sweep(kind.lacks, "1e8 s"), "/usr/bin/env");
        while (!fs::exists(place.store) || fs::file_size(place.store) == 0) Place::wait_a_moment();
        const Ended second = Place::run(place.sweep(kind.lacks, "1e8 s"));
        CHECK(fs::exists(place.store + "-wal") == kind.has_wal);
        CHECK(second.exit == 1);
        CHECK_MESSAGE(second.err.find(kind.refusal) != std::string::npos, second.err);
        const Ended reader = Place::run(Place::on(kind.lacks, {"results", place.store}));
        CAPTURE(reader.err);
        if (kind.has_readers) {
            CHECK(reader.err.find("lock") == std::string::npos);
        } else {
            CHECK(reader.exit == 1);
            CHECK(reader.err.find("no locks") != std::string::npos);
        }
        CHECK(first.stop().exit == 130);
        CHECK(place.files() == "s.db");
    }
}

TEST_CASE(
    "store: on any file system, a killed sweep keeps its finished runs, and the same command "
    "continues the sweep") {
    const Place undisturbed;
    REQUIRE(Place::run(undisturbed.sweep("nothing", "20 s")).exit == 0);
    for (const Kind& kind : kinds) {
        CAPTURE(kind.lacks);
        const Place place;
        std::size_t kept = 0;
        for (int kills = 0; kills < 4; ++kills) {
            {
                const Process sweep(place.folder, place.sweep(kind.lacks, "20 s"), "/usr/bin/env");
                for (int i = 0; i < 15 + 5 * kills; ++i) Place::wait_a_moment();
                kill(sweep.pid(), SIGKILL);
            }
            if (!fs::exists(place.store) || fs::file_size(place.store) == 0) continue;
            const std::size_t now = place.finished();
            CHECK(now >= kept);
            kept = now;
        }
        const Ended last = Place::run(place.sweep(kind.lacks, "20 s"));
        CAPTURE(last.err);
        CHECK(last.exit == 0);
        CHECK(place.finished() == 30);
        CHECK(place.files() == "s.db");
        CHECK(place.results(kind.lacks).out == undisturbed.results("nothing").out);
    }
}

TEST_CASE(
    "store: on any file system, a killed sweep's runs can be read, and the sweep can be "
    "completed") {
    for (const Kind& kind : kinds) {
        CAPTURE(kind.lacks);
        const Place place;
        {
            const Process sweep(place.folder, place.sweep("nothing", "100 s"), "/usr/bin/env");
            while (!fs::exists(place.store) || fs::file_size(place.store) == 0 ||
                   place.finished() < 5)
                Place::wait_a_moment();
            kill(sweep.pid(), SIGKILL);
        }
        fs::remove(place.store + "-shm");  // it belongs to a machine
        Ended read = place.results(kind.lacks);
        for (int i = 0; i < 200 && read.exit != 0; ++i) {  // its workers hold the lock a while
            Place::wait_a_moment();
            read = place.results(kind.lacks);
        }
        CAPTURE(read.err);
        CHECK(read.exit == 0);
        CHECK(std::count(read.out.begin(), read.out.end(), '\n') > 1);
        const Ended last = Place::run(place.sweep(kind.lacks, "100 s"));
        CAPTURE(last.err);
        CHECK(last.exit == 0);
        CHECK(place.finished() == 30);
    }
}

TEST_CASE(
    "store: a lock file of another machine blocks the store; the error says which file to remove") {
    const Place place;
    const std::string lock = place.folder.write("s.db.lock", "12 34 elsewhere\n");
    for (const char* lacks : {"nothing", "whole"}) {
        const Ended refused = Place::run(place.sweep(lacks));
        CHECK(refused.exit == 1);
        CHECK(refused.err.find("process 12 on elsewhere") != std::string::npos);
        CHECK(refused.err.find("remove the file " + lock) != std::string::npos);
    }
    fs::remove(lock);
    CHECK(Place::run(place.sweep("whole")).exit == 0);
}

}  // namespace store_file_systems_test
