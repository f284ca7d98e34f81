// SPDX-License-Identifier: MIT
#include "study/store.hpp"

#include "sim/error.hpp"
#include "study/merge.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <sqlite3.h>

namespace store_test {
using namespace rovernet;
using namespace rovernet::test;

namespace {

StoredPoint point(std::uint32_t number, const std::string& id) {
    Table settings;
    settings.set("routing.ttl", static_cast<int>(number));
    settings.set("radio.power", "15 dBm");
    return {number, id, settings};
}

StoredRun run(const std::string& id, std::uint32_t point, std::uint32_t replication,
              std::optional<double> value) {
    return {.id = id,
            .point = point,
            .replication = replication,
            .error = {},
            .measurement = {.metrics = {{"reach", value}, {"hops", 0.1 + point}},
                            .fingerprint = "f" + id,
                            .cpu_s = 0.5,
                            .wall_s = 0.25,
                            .started = "2025-01-02T03:04:05Z",
                            .host = "h"}};
}

StoredRun failed_run(const std::string& id, std::uint32_t point, std::uint32_t replication) {
    StoredRun failed = run(id, point, replication, {});
    failed.error = "it failed";
    failed.measurement.metrics.clear();
    return failed;
}

std::string all_values(const Store& store) {
    std::string text;
    store.for_each_value([&](const StoredValue& v, const std::string& metric) {
        text += std::to_string(v.point) + "/" + std::to_string(v.replication) + " " + metric + " " +
                (v.value ? std::to_string(*v.value) : "none") + "\n";
    });
    return text;
}

Store two_points(const std::string& path) {
    Store store = Store::open_to_write(path);
    store.set_points({point(0, "aa"), point(1, "bb")});
    store.set_property("version", "1");
    return store;
}

std::string error_of(const std::string& path) {
    try {
        Store::open(path);
    } catch (const std::exception& error) {
        return error.what();
    }
    return "no error";
}

void exec(const std::string& path, const char* sql) {
    sqlite3* database = nullptr;
    REQUIRE(sqlite3_open(path.c_str(), &database) == SQLITE_OK);
    REQUIRE(sqlite3_exec(database, sql, nullptr, nullptr, nullptr) == SQLITE_OK);
    sqlite3_close(database);
}

}  // namespace

TEST_CASE("store: recorded runs are read back, to the last digit and in order") {
    const TemporaryFolder folder;
    const std::string path = folder.path("s.db");
    {
        Store store = two_points(path);
        store.record(run("r3", 1, 0, 1.0 / 3));
        store.record(run("r1", 0, 1, {}));
        store.record(run("r0", 0, 0, 0.25));
    }
    const Store store = Store::open(path);
    CHECK(store.property("version") == "1");
    CHECK(store.property("nothing").empty());
    const auto points = store.points();
    REQUIRE(points.size() == 2);
    CHECK(points[1].id == "bb");
    CHECK(std::get<std::int64_t>(points[1].settings.find("routing.ttl")->data) == 1);
    CHECK(*points[1].settings.find("radio.power")->string() == "15 dBm");
    const auto runs = store.runs();
    REQUIRE(runs.size() == 3);
    CHECK(runs[0].id == "r0");
    CHECK(runs[2].id == "r3");
    CHECK(runs[2].measurement.fingerprint == "fr3");
    CHECK(runs[2].measurement.cpu_s == 0.5);
    CHECK(runs[2].measurement.wall_s == 0.25);
    CHECK(runs[2].measurement.host == "h");
    const auto values = store.values("reach");
    REQUIRE(values.size() == 3);
    CHECK(values[0].value == 0.25);
    CHECK_FALSE(values[1].value);
    CHECK(values[2].value == 1.0 / 3);
    CHECK(store.values("reach", 1).size() == 1);
    CHECK(store.values("unheard of").empty());
    CHECK(all_values(store) ==
          "0/0 hops 0.100000\n0/0 reach 0.250000\n0/1 hops 0.100000\n0/1 reach none\n"
          "1/0 hops 1.100000\n1/0 reach 0.333333\n");
    CHECK(std::distance(
              std::filesystem::directory_iterator(std::filesystem::path(path).parent_path()), {}) ==
          1);  // one plain file is left
}

TEST_CASE("store: a failed run may be replaced, a finished run may not") {
    const TemporaryFolder folder;
    Store store = two_points(folder.path("s.db"));
    store.record(failed_run("r0", 0, 0));
    CHECK(store.runs()[0].error == "it failed");
    CHECK(store.values("reach").empty());
    store.record(run("r0", 0, 0, 0.5));
    REQUIRE(store.runs().size() == 1);
    CHECK(store.runs()[0].error.empty());
    CHECK_THROWS_AS(store.record(run("r0", 0, 0, 0.7)), RunError);
    CHECK(store.values("reach")[0].value == 0.5);
}

TEST_CASE("store: if the study grows, its points keep their runs but get new numbers") {
    const TemporaryFolder folder;
    Store store = two_points(folder.path("s.db"));
    store.record(run("r0", 0, 0, 0.5));
    store.record(run("r1", 1, 0, 0.7));
    store.set_points({point(0, "bb"), point(1, "cc"), point(2, "aa")});
    const auto values = store.values("reach");
    CHECK(values[0].point == 0);
    CHECK(values[0].value == 0.7);
    CHECK(values[1].point == 2);
    store.record(run("r2", 2, 1, 0.9));
    CHECK(store.values("reach", 2).size() == 2);
}

TEST_CASE("store: other processes may read a store that is being written, but not write to it") {
    const TemporaryFolder folder;
    const std::string path = folder.path("s.db");
    Store store = two_points(path);
    store.record(run("r0", 0, 0, 0.5));
    const Store reader = Store::open(path);
    CHECK(reader.values("reach").size() == 1);
    store.record(run("r1", 0, 1, 0.5));
    CHECK(reader.values("reach").size() == 2);
    CHECK_THROWS_WITH_AS(Store::open_to_write(path), doctest::Contains("a different sweep"),
                         RunError);
}

TEST_CASE("store: a file that is not a store is refused") {
    const TemporaryFolder folder;
    CHECK(error_of(folder.path("none.db")).find("no such store") != std::string::npos);
    CHECK(error_of(folder.path("")).find("it is a folder") != std::string::npos);
    const std::string text = folder.write("t.db", "this is a text and not a store of anything");
    CHECK(error_of(text) == text +
                                ": this file is not a store of a study, or the store is damaged; "
                                "give a different file, or restore a copy of the store");
    CHECK_THROWS_AS(Store::open_to_write(text), InputError);
    CHECK_THROWS_AS(Store::open_to_write(folder.path("")), InputError);
    const std::string other = folder.path("other.db");
    exec(other, "CREATE TABLE t (x)");
    CHECK(error_of(other).find("this file is not a store of a study") != std::string::npos);
    CHECK_THROWS_AS(Store::open_to_write(other), InputError);
    CHECK_THROWS_WITH_AS(Store::open_to_write(folder.path("no/folder/s.db")),
                         doctest::Contains("cannot be written"), RunError);
}

TEST_CASE("store: a file whose creation was interrupted is created again") {
    const TemporaryFolder folder;
    const std::string path = folder.path("s.db");
    exec(path, "PRAGMA user_version = 0; CREATE TABLE t (x); DROP TABLE t");  // pages, no tables
    REQUIRE(std::filesystem::file_size(path) > 0);
    two_points(path).record(run("r0", 0, 0, 0.5));
    CHECK(Store::open(path).values("reach").size() == 1);
}

TEST_CASE("store: a store of a newer format is refused") {
    const TemporaryFolder folder;
    const std::string path = folder.path("s.db");
    { two_points(path); }
    exec(path, "PRAGMA user_version = 2");
    CHECK(error_of(path).find("newer rovernet") != std::string::npos);
    CHECK_THROWS_AS(Store::open_to_write(path), InputError);
}

TEST_CASE("store: an SQL query is answered, and may not change anything") {
    const TemporaryFolder folder;
    const std::string path = folder.path("s.db");
    {
        Store store = two_points(path);
        store.record(run("r0", 0, 0, 0.5));
    }
    const Store store = Store::open(path);
    std::vector<std::vector<std::string>> rows;
    const auto keep = [&](const std::vector<std::string>& row) { rows.push_back(row); };
    store.query("SELECT point, metric, value FROM result ORDER BY metric", keep);
    CHECK(rows == std::vector<std::vector<std::string>>{
                      {"point", "metric", "value"}, {"0", "hops", "0.1"}, {"0", "reach", "0.5"}});
    CHECK_THROWS_WITH_AS(store.query("SELECT nothing", keep), doctest::Contains("--sql"),
                         std::invalid_argument);
    CHECK_THROWS_AS(store.query("DELETE FROM run", keep), std::invalid_argument);
    CHECK(store.runs().size() == 1);
}

TEST_CASE("store: an SQL query can read, but cannot write, attach a file or change a setting") {
    const TemporaryFolder folder;
    const std::string path = folder.path("s.db"), other = folder.path("other.db");
    { two_points(path); }
    const Store store = Store::open(path);
    const auto ignore = [](const std::vector<std::string>&) {};
    for (const std::string& question :
         {"VACUUM INTO '" + other + "'", "ATTACH '" + other + "' AS o", std::string("VACUUM"),
          std::string("PRAGMA user_version = 9"), std::string("PRAGMA journal_mode = WAL"),
          std::string("CREATE TEMP TABLE t (x)"), std::string("INSERT INTO study VALUES (1, 2)"),
          std::string("SELECT load_extension('x')"), std::string("BEGIN IMMEDIATE")}) {
        CAPTURE(question);
        CHECK_THROWS_WITH_AS(store.query(question, ignore),
                             doctest::Contains("only reading is allowed"), std::invalid_argument);
        CHECK_FALSE(std::filesystem::exists(other));
    }
    for (const char* question :
         {"WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n LIMIT 3) SELECT * FROM n",
          "EXPLAIN SELECT * FROM result", "PRAGMA table_info(run)",
          "SELECT group_concat(value) FROM study"}) {
        CAPTURE(question);
        CHECK_NOTHROW(store.query(question, ignore));
    }
    CHECK(store.points().size() == 2);
}

TEST_CASE(
    "merge: runs that the target lacks, or that failed there, are copied; finished runs of the "
    "target stay") {
    const TemporaryFolder folder;
    const std::string shard = folder.path("shard.db");
    {
        Store store = Store::open_to_write(shard);
        store.set_points({point(0, "bb"), point(1, "aa")});  // in another order
        store.set_property("version", "1");
        store.record(run("r0", 1, 0, 0.1));
        store.record(run("r1", 1, 1, 0.2));
        store.record(run("r2", 0, 0, 0.3));
        store.record(failed_run("r3", 0, 1));
        store.record(failed_run("r4", 0, 2));
    }
    Store store = two_points(folder.path("s.db"));
    store.record(run("r0", 0, 0, 0.9));
    store.record(failed_run("r1", 0, 1));
    store.record(run("r3", 1, 1, 0.8));
    for (int twice = 0; twice < 2; ++twice) {
        merge(store, shard);
        REQUIRE(store.runs().size() == 5);
        const auto values = store.values("reach");
        REQUIRE(values.size() == 4);
        CHECK(values[0].value == 0.9);  // its own
        CHECK(values[1].value == 0.2);  // in place of a failure
        CHECK(values[2].value == 0.3);  // new
        CHECK(values[3].value == 0.8);  // not replaced by a failure
        CHECK(store.runs()[4].error == "it failed");
    }
}

TEST_CASE("merge: runs of another version or study are refused") {
    const TemporaryFolder folder;
    Store store = two_points(folder.path("s.db"));
    const std::string shard = folder.path("shard.db");
    {
        Store other = two_points(shard);
        other.set_property("version", "2");
    }
    CHECK_THROWS_WITH_AS(merge(store, shard), doctest::Contains("version 2"), InputError);
    {
        Store other = Store::open_to_write(shard);
        other.set_property("version", "1");
        other.set_points({point(2, "xx")});
    }
    CHECK_THROWS_WITH_AS(merge(store, shard), doctest::Contains("a different study"), InputError);
}

}  // namespace store_test
