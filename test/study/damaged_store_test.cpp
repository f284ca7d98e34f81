// SPDX-License-Identifier: MIT
#include "sim/error.hpp"
#include "study/advise/compare.hpp"
#include "study/advise/study_chart.hpp"
#include "study/explain.hpp"
#include "study/merge.hpp"
#include "study/results.hpp"
#include "study/results_csv.hpp"
#include "study/sweep.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sqlite3.h>
#include <string>
#include <vector>

namespace damaged_store_test {
using namespace rovernet;
using namespace rovernet::test;

namespace {

namespace fs = std::filesystem;

const std::string scenario = R"([scenario]
duration = "100 ms"
[propagation]
model = "disc"
range = "10 m"
[[robot]]
name = "A"
at = ["0 m", "0 m"]
[[robot]]
name = "B"
at = ["5 m", "0 m"]
[[traffic]]
from = "A"
payload = "F"
[study]
replications = 2
metrics = ["delivery_ratio", "transmissions"]
vary.propagation.model = ["disc", "friis"]
)";

void exec(const std::string& path, const std::string& sql) {
    sqlite3* database = nullptr;
    REQUIRE(sqlite3_open(path.c_str(), &database) == SQLITE_OK);
    const int code = sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr);
    CHECK_MESSAGE(code == SQLITE_OK, sql << ": " << sqlite3_errmsg(database));
    sqlite3_close(database);
}

/// The columns of a store's tables.
struct Columns {
    const char* table;
    std::vector<std::string> names;
};
const std::vector<Columns> tables = {{"study", {"key", "value"}},
                                     {"point", {"key", "number", "id", "settings"}},
                                     {"run",
                                      {"key", "id", "point", "replication", "error", "fingerprint",
                                       "cpu_s", "wall_s", "started", "host"}},
                                     {"metric_name", {"key", "name"}},
                                     {"metric", {"run", "name", "value"}}};

/// A finished study of two points, and stores that are like its own but for one thing.
class Workshop {
  public:
    Workshop() {
        folder_.write("s.toml", scenario);
        Study study = this->study();
        Store store = open_store(whole(), study);
        REQUIRE(sweep(study, store, {}).progress.finished == 4);
    }

    std::string whole() const { return folder_.path("s.db"); }
    Study study() const { return Study(folder_.path("s.toml"), {}); }

    /// A copy to which `sql` was done; its columns take any value.
    std::string tampered(const std::string& sql) const {
        const std::string path = folder_.path("t.db");
        fs::copy_file(whole(), path, fs::copy_options::overwrite_existing);
        std::string loosen = "PRAGMA synchronous = OFF; BEGIN; DROP VIEW result;";
        for (const Columns& each : tables) {
            std::string names;
            for (const auto& name : each.names) names += (names.empty() ? "" : ", ") + name;
            const std::string table = each.table;
            loosen += "CREATE TABLE loose (" + names + "); INSERT INTO loose SELECT * FROM " +
                      table + "; DROP TABLE " + table + "; ALTER TABLE loose RENAME TO " + table +
                      ";";
        }
        exec(path, loosen + sql + "; COMMIT");
        return path;
    }

    /// What those say who read the store or write to it; "" for one that is content. Anything but
    /// an error that a user can read fails the test.
    std::vector<std::string> errors(const std::string& path) const {
        const std::vector<std::function<void()>> readers = {
            [&] { answers(Store::open(path), {}); },
            [&] { write_csv(Store::open(path), {}, [](std::string_view) {}); },
            [&] { write_provenance_csv(Store::open(path), {}, [](std::string_view) {}); },
            [&] {
                study_chart(Store::open(path), {.x = "propagation.model", .y = "delivery_ratio"});
            },
            [&] { compare_models(Store::open(path), "delivery_ratio", ""); },
            [&] {
                const Store store = Store::open(path);
                const FoundRun found = find_run(store, "0/1");
                run_command(store, found.point, found.run.replication);
            },
            [&] {
                Study study = this->study();
                const Store store = open_store(path, study);
                finished_runs(store);
                run_states(study, store);
            },
            [&] {
                Study study = this->study();
                Store store = open_store(folder_.path("new.db"), study);
                merge(store, path);
            }};
        std::vector<std::string> texts;
        for (const auto& read : readers) {
            texts.emplace_back();
            try {
                read();
            } catch (const InputError& error) {
                texts.back() = error.what();
            } catch (const RunError& error) {
                texts.back() = error.what();
            } catch (const std::invalid_argument& error) {
                texts.back() = error.what();
            }
            fs::remove(folder_.path("new.db"));
        }
        return texts;
    }

  private:
    TemporaryFolder folder_;
};

std::string joined(const std::vector<std::string>& texts) {
    std::string text;
    for (const auto& each : texts) text += each + "\n";
    return text;
}

}  // namespace

TEST_CASE("damaged stores: an intact store with untyped columns is read without an error") {
    const Workshop workshop;
    std::vector<std::string> errors = workshop.errors(workshop.whole());
    CHECK(joined(errors) == std::string(errors.size(), '\n'));
    errors = workshop.errors(workshop.tampered(""));
    errors[6] = "";  // who writes misses the tables' constraints
    CHECK(joined(errors) == std::string(errors.size(), '\n'));
}

TEST_CASE("damaged stores: a wrong value in any column gives an error or does no harm") {
    const Workshop workshop;
    const std::vector<std::string> values = {
        "NULL", "5", "-1", "9e999", "x'00ff41'", "'x'", "'[1,[2,{\"a\":null}]]'", "'{\"a\":5}'"};
    for (const Columns& table : tables)
        for (const std::string& column : table.names)
            for (const std::string& value : values) {
                CAPTURE(table.table);
                CAPTURE(column);
                CAPTURE(value);
                const auto path = workshop.tampered("UPDATE " + std::string(table.table) + " SET " +
                                                    column + " = " + value + " WHERE rowid = 2");
                for (const std::string& error : workshop.errors(path)) {
                    CHECK(error.find("::") == std::string::npos);  // std::... of the library
                }
            }
}

TEST_CASE(
    "damaged stores: the error names table, row, column, the value found and the type expected") {
    const Workshop workshop;
    const auto error = [&](const std::string& sql, std::size_t reader) {
        return workshop.errors(workshop.tampered(sql))[reader];
    };
    const auto has = [](const std::string& text, const char* part) {
        CHECK_MESSAGE(text.find(part) != std::string::npos, text);
    };
    has(error("UPDATE point SET settings = 5 WHERE key = 2", 0),
        "t.db: the store is damaged: table \"point\", row with key \"2\", column \"settings\": "
        "found "
        "the number 5, "
        "expected a text; ");
    has(error("UPDATE point SET settings = '[1]' WHERE key = 2", 0), "expected an object");
    has(error("UPDATE point SET settings = '{' WHERE key = 2", 0), "expected JSON");
    has(error("UPDATE point SET settings = '{\"other\":1}' WHERE key = 2", 0),
        "found other keys, expected the keys of the first point");
    has(error("UPDATE point SET settings = '{\"propagation.model\":null}'", 0), "found null for");
    has(error("UPDATE point SET number = 7 WHERE key = 2", 0),
        "column \"number\": found the number 7, expected 1, because ");
    has(error("UPDATE point SET number = 0", 0), "points are numbered from 0 on");
    has(error("UPDATE run SET point = 77 WHERE key = 3", 2),
        "table \"run\", row with key \"3\", column \"point\": found nothing (NULL)");
    has(error("UPDATE run SET replication = 2000000 WHERE key = 3", 2),
        "column \"replication\": found the number 2000000, expected a whole number from 0 to "
        "999999");
    has(error("UPDATE run SET started = x'ff' WHERE key = 3", 2),
        "found 1 bytes that are not text");
    has(error("UPDATE metric SET value = 'many' WHERE run = 2", 1),
        ", column \"value\": found the text \"many\", expected a finite number");
    has(error("UPDATE metric SET value = 'many' WHERE run = 2", 1),
        "table \"metric\", row with run \"2\", name \"");
    has(error("UPDATE metric SET value = 9e999", 0), "expected a finite number");
    has(error("UPDATE study SET value = 5 WHERE key = 'study'", 0),
        "table \"study\", row with key \"study\", column \"value\": found the number 5");
    has(error("UPDATE study SET value = '{\"metrics\":5}' WHERE key = 'study'", 0),
        "table \"study\", row with key \"study\", column \"value\": metrics: found the number 5");
    has(error("UPDATE study SET value = '{}' WHERE key = 'options'", 5),
        "table \"study\", row with key \"options\", column \"value\": found a table, expected a "
        "list");
    has(error("UPDATE study SET value = '[1]' WHERE key = 'options'", 5),
        "found the number 1, expected texts");
    const std::string deep(200'000, '[');
    has(error("UPDATE point SET settings = '" + deep + "'", 0), "more than 100 levels");
    for (const Columns& table : tables) {
        if (std::string(table.table) == "metric_name") continue;
        has(joined(workshop.errors(workshop.tampered("DROP TABLE " + std::string(table.table)))),
            ("no such table: " + std::string(table.table)).c_str());
    }
}

TEST_CASE("damaged stores: a file that ends early, or has changed bytes, is an error") {
    const Workshop workshop;
    std::ifstream file(workshop.whole(), std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(file)), {});
    const std::string path = workshop.tampered("");
    const auto check = [&](const std::string& text) {
        std::ofstream(path, std::ios::binary | std::ios::trunc) << text;
        for (const auto& error : workshop.errors(path)) {
            CHECK(error.find("::") == std::string::npos);
        }
    };
    for (std::size_t size = 0; size < bytes.size(); size += 5000) check(bytes.substr(0, size));
    for (std::size_t at = 90; at < bytes.size(); at += 4003) {
        std::string other = bytes;
        for (std::size_t i = at; i < std::min(at + 40, other.size()); ++i) other[i] ^= 0x55;
        check(other);
    }
}

}  // namespace damaged_store_test
