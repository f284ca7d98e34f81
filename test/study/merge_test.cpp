// SPDX-License-Identifier: MIT
#include "study/merge.hpp"

#include "sim/error.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <filesystem>

namespace merge_test {
using namespace rovernet;
using namespace rovernet::test;
namespace fs = std::filesystem;

namespace {

/// A store of a study with two points, each of them run once.
Store store_with(const std::string& path, std::uint32_t replication) {
    Store store = Store::open_to_write(path);
    store.set_points({{0, "p0", {}}, {1, "p1", {}}});
    store.set_property("version", "1");
    for (std::uint32_t point = 0; point < 2; ++point) {
        StoredRun run{.id = std::to_string(point) + "/" + std::to_string(replication),
                      .point = point,
                      .replication = replication,
                      .error = {},
                      .measurement = {}};
        run.measurement.metrics = {{"m", point + 0.5}};
        store.record(run);
    }
    return store;
}

bool throws_input_error(Store& store, const std::string& shard) {
    try {
        merge_and_remove(store, shard);
    } catch (const InputError&) {
        return true;
    }
    return false;
}

}  // namespace

TEST_CASE(
    "merge: runs of a shard (part of a study) are copied with their values, and the shard is "
    "removed") {
    const TemporaryFolder folder;
    Store store = store_with(folder.path("s.db"), 0);
    store_with(folder.path("1.db"), 1);
    merge_and_remove(store, folder.path("1.db"));
    CHECK(store.runs().size() == 4);
    const auto values = store.values("m", 1);
    REQUIRE(values.size() == 2);
    CHECK(values[1].replication == 1);
    CHECK(values[1].value == 1.5);
    CHECK_FALSE(fs::exists(folder.path("1.db")));
}

TEST_CASE("merge: runs that a killed process left in the journal of its store are merged") {
    const TemporaryFolder folder;
    Store store = store_with(folder.path("s.db"), 0);
    {
        const Store open = store_with(folder.path("1.db"), 1);
        for (const char* ending : {"", "-wal"}) {
            fs::copy_file(folder.path("1.db") + ending, folder.path("2.db") + ending);
        }
    }
    REQUIRE(fs::file_size(folder.path("2.db-wal")) > 0);
    merge_and_remove(store, folder.path("2.db"));
    CHECK(store.runs().size() == 4);
    for (const char* ending : {"", "-wal", "-shm"}) {
        CHECK_FALSE(fs::exists(folder.path("2.db") + ending));
    }
}

TEST_CASE(
    "merge: a shard (part of a study) that is still being written is not merged, and stays "
    "unchanged") {
    const TemporaryFolder folder;
    Store store = store_with(folder.path("s.db"), 0);
    const Store shard = store_with(folder.path("1.db"), 1);
    CHECK_THROWS_AS(merge_and_remove(store, folder.path("1.db")), RunError);
    CHECK(store.runs().size() == 2);
    CHECK(shard.runs().size() == 2);
    CHECK(fs::exists(folder.path("1.db")));
    CHECK_THROWS_AS(merge_and_remove(store, store.path()), RunError);
    CHECK(fs::exists(store.path()));
}

TEST_CASE("merge: a shard (part of a study) without runs is removed silently") {
    const TemporaryFolder folder;
    Store store = store_with(folder.path("s.db"), 0);
    merge_and_remove(store, folder.write("1.db", ""));
    CHECK_FALSE(fs::exists(folder.path("1.db")));
    CHECK(store.runs().size() == 2);
}

TEST_CASE("merge: a file that is not a shard of this study is refused and not removed") {
    const TemporaryFolder folder;
    Store store = store_with(folder.path("s.db"), 0);
    CHECK(throws_input_error(store, folder.path("none.db")));
    CHECK_FALSE(fs::exists(folder.path("none.db")));
    store_with(folder.path("version.db"), 1).set_property("version", "2");
    {
        Store other = store_with(folder.path("study.db"), 1);
        other.set_points({{0, "p0", {}}, {1, "p1", {}}, {2, "q", {}}});
    }
    folder.write("noise.db", std::string(5000, 'x'));
    fs::create_directory(folder.path("folder.db"));
    for (const char* name : {"version.db", "study.db", "noise.db", "folder.db"}) {
        CAPTURE(name);
        CHECK(throws_input_error(store, folder.path(name)));
        CHECK(fs::exists(folder.path(name)));
    }
    CHECK(store.runs().size() == 2);
}

}  // namespace merge_test
