// SPDX-License-Identifier: MIT
#include "study/store.hpp"

#include "files/input_file.hpp"
#include "files/kept_inputs.hpp"
#include "scenario/document/json.hpp"
#include "sim/error.hpp"
#include "study/only_reading.hpp"
#include "study/store_connection.hpp"
#include "study/stored_row.hpp"

#include <fmt/format.h>

#include <SQLiteCpp/SQLiteCpp.h>
#include <SQLiteCpp/VariadicBind.h>
#include <map>
#include <sqlite3.h>

namespace rovernet {
namespace {

constexpr int application = 0x726f766e;  // "rovn"
constexpr int format = 1;

constexpr const char* property_query =
    "SELECT key AS \"study.key\", value AS \"study.value\" FROM study WHERE key = ?";

/// Calls visit(field) for each member of a measurement that is a column of the table run.
template <class Visit>
void for_each_column(Visit visit) {
    for_each_field<Measurement>([&]<class T>(const Field<Measurement, T>& field) {
        if constexpr (!std::is_integral_v<T>) visit(field);  // not Measurement::searches
    });
}

/// Columns of a measurement, as `pattern` writes each: {0} is its name, {1} its type in SQL.
std::string columns(fmt::string_view pattern) {
    std::vector<std::string> all;
    for_each_column([&]<class T>(const Field<Measurement, T>& field) {
        const char* const type = std::is_same_v<T, std::string> ? "TEXT" : "REAL";
        all.push_back(fmt::format(fmt::runtime(pattern), field.name, type));
    });
    return fmt::format("{}", fmt::join(all, ", "));
}

/// Statements that make the tables; {} are the columns of a measurement.
constexpr const char* schema = R"(
CREATE TABLE study (key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE point (key INTEGER PRIMARY KEY, number INTEGER NOT NULL, id TEXT NOT NULL UNIQUE,
                    settings TEXT NOT NULL);
CREATE INDEX point_number ON point (number);
CREATE TABLE run (key INTEGER PRIMARY KEY, id TEXT NOT NULL UNIQUE,
                  point INTEGER NOT NULL REFERENCES point, replication INTEGER NOT NULL,
                  error TEXT NOT NULL, {}, UNIQUE (point, replication));
CREATE TABLE metric_name (key INTEGER PRIMARY KEY, name TEXT NOT NULL UNIQUE);
CREATE TABLE metric (run INTEGER NOT NULL REFERENCES run, name INTEGER NOT NULL REFERENCES metric_name,
                     value REAL, PRIMARY KEY (run, name)) WITHOUT ROWID;
CREATE VIEW result AS
    SELECT point.number AS point, point.settings, run.replication, metric_name.name AS metric,
           metric.value
    FROM metric JOIN run ON run.key = metric.run JOIN point ON point.key = run.point
         JOIN metric_name ON metric_name.key = metric.name;
)";

/// Runs `act`, and converts exceptions of SQLite to errors with a remedy.
auto told(const std::string& path, auto&& act) {
    try {
        return act();
    } catch (const SQLite::Exception& error) {
        switch (error.getErrorCode()) {
            case SQLITE_NOTADB:
            case SQLITE_CORRUPT:
                throw InputError({path},
                                 "this file is not a store of a study, or the store is damaged; "
                                 "give a different file, or restore a copy of the store");
            case SQLITE_ERROR:  // a statement of ours does not fit the tables that there are
            case SQLITE_MISMATCH: throw damaged_store(path, error.what());
            case SQLITE_FULL:
                throw RunError(path +
                               ": the disk is full; finished runs are kept: free some "
                               "space and run the same command again");
            case SQLITE_READONLY:
            case SQLITE_CANTOPEN:
            case SQLITE_PERM:
                throw RunError(path +
                               ": cannot be written; check the permissions of the file and of "
                               "its folder, or give a different store with --store");
            default:
                throw RunError(fmt::format("{}: {} (SQLite error {}); finished runs are kept", path,
                                           error.what(), error.getExtendedErrorCode()));
        }
    }
}

/// Checks that points are numbered from 0 on and have the same keys, each with a value.
StoredPoint point_in(const StoredRow& row, const std::vector<StoredPoint>& before) {
    StoredPoint point{row.number(1), row.text(2), {}};
    if (point.number != before.size()) {
        row.refuse(1, fmt::format("the number {}", point.number),
                   fmt::format("{}, because the points are numbered from 0 on", before.size()));
    }
    const Value settings = row.document(3);
    if (!settings.table()) row.refuse(3, settings.description(), "an object");
    point.settings = *settings.table();
    const Table& first = before.empty() ? point.settings : before.front().settings;
    const bool alike = std::equal(first.entries.begin(), first.entries.end(),
                                  point.settings.entries.begin(), point.settings.entries.end(),
                                  [](const Entry& a, const Entry& b) { return a.key == b.key; });
    if (!alike) row.refuse(3, "other keys", "the keys of the first point, in the same order");
    for (const Entry& entry : point.settings.entries) {
        if (!std::holds_alternative<std::monostate>(entry.value.data)) continue;
        row.refuse(3, fmt::format("null for {}", entry.key), "a value");
    }
    return point;
}

}  // namespace

struct Store::Database {
    explicit Database(StoreConnection made)
        : connection(std::move(made)), sqlite(*connection.sqlite) {}

    int tables() { return sqlite.execAndGet("SELECT count(*) FROM sqlite_master").getInt(); }
    void make_schema();
    std::int64_t metric_key(const std::string& name);

    StoreConnection connection;
    SQLite::Database& sqlite;                          // of the connection
    std::map<std::uint32_t, std::int64_t> point_keys;  // by number
    std::map<std::string, std::int64_t> metric_keys;
    std::optional<SQLite::Statement> insert_run, insert_metric;
};

void Store::Database::make_schema() {
    SQLite::Transaction transaction(sqlite);
    sqlite.exec(fmt::format(schema, columns("{} {} NOT NULL")));
    sqlite.exec(
        fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {}", application, format));
    transaction.commit();
}

std::int64_t Store::Database::metric_key(const std::string& name) {
    const auto [found, is_new] = metric_keys.try_emplace(name);
    if (is_new) {
        SQLite::Statement insert(sqlite, "INSERT OR IGNORE INTO metric_name (name) VALUES (?)");
        insert.bind(1, name);
        insert.exec();
        SQLite::Statement select(sqlite, "SELECT key FROM metric_name WHERE name = ?");
        select.bind(1, name);
        select.executeStep();
        found->second = select.getColumn(0).getInt64();
    }
    return found->second;
}

Store::Store(std::string path, std::unique_ptr<Database> database)
    : path_(std::move(path)), database_(std::move(database)) {
    const int made_by = database_->sqlite.execAndGet("PRAGMA application_id").getInt();
    const int version = database_->sqlite.execAndGet("PRAGMA user_version").getInt();
    if (made_by == 0 && database_->tables() == 0)
        throw InputError({path_},
                         "this store has no runs yet; if the sweep that wrote this store was "
                         "killed, run that sweep again");
    if (made_by != application) throw InputError({path_}, "this file is not a store of a study");
    if (version > format) {
        throw InputError({path_},
                         fmt::format("this store has format {}, which a newer rovernet wrote; this "
                                     "version reads formats up to {}; update rovernet",
                                     version, format));
    }
}

Store Store::open(const std::string& path) {
    if (input_kind(path) == InputKind::nothing) {
        throw InputError({path}, "there is no such store; rovernet sweep FILE writes a store");
    }
    need_file(path);
    note_input(path);
    return told(path, [&] {
        return Store(path, std::make_unique<Database>(StoreConnection::to_read(path)));
    });
}

Store Store::open_to_write(const std::string& path) {
    const InputKind kind = input_kind(path);
    if (kind == InputKind::folder) throw InputError({path}, "this is a directory, not a store");
    if (kind != InputKind::nothing) need_file(path);
    return told(path, [&] {
        auto database = std::make_unique<Database>(StoreConnection::to_write(path));
        // A process killed at its beginning leaves a file without tables.
        if (database->tables() == 0) database->make_schema();
        return Store(path, std::move(database));
    });
}

Store::~Store() {
    if (!database_ || !database_->connection.lock) return;
    database_->insert_run.reset();
    database_->insert_metric.reset();
    try {  // one plain file, that can be read where nothing can be written
        database_->sqlite.exec("PRAGMA journal_mode = DELETE");
    } catch (const SQLite::Exception&) {
        // If there is a reader, the file stays unchanged, which is equally readable.
    }
}
Store::Store(Store&&) noexcept = default;
Store& Store::operator=(Store&&) noexcept = default;

std::string Store::property(const std::string& key) const {
    return told(path_, [&] {
        SQLite::Statement select(database_->sqlite, property_query);
        select.bind(1, key);
        return select.executeStep() ? StoredRow(path_, select, 1).text(1) : std::string();
    });
}

Value Store::document(const std::string& key) const {
    return told(path_, [&] {
        SQLite::Statement select(database_->sqlite, property_query);
        select.bind(1, key);
        if (!select.executeStep()) return Value();
        const StoredRow row(path_, select, 1);
        return row.text(1).empty() ? Value() : row.document(1);
    });
}

void Store::set_property(const std::string& key, const std::string& value) {
    told(path_, [&] {
        SQLite::Statement replace(database_->sqlite, "REPLACE INTO study VALUES (?, ?)");
        replace.bind(1, key);
        replace.bind(2, value);
        replace.exec();
    });
}

std::vector<StoredPoint> Store::points() const {
    return told(path_, [&] {
        std::vector<StoredPoint> points;
        SQLite::Statement select(
            database_->sqlite,
            R"(SELECT key AS "point.key", number AS "point.number", id AS "point.id",
               settings AS "point.settings" FROM point ORDER BY number, key)");
        const StoredRow row(path_, select, 1);
        while (select.executeStep()) points.push_back(point_in(row, points));
        return points;
    });
}

void Store::set_points(const std::vector<StoredPoint>& points) {
    told(path_, [&] {
        SQLite::Transaction transaction(database_->sqlite);
        SQLite::Statement insert(
            database_->sqlite,
            "INSERT INTO point (number, id, settings) VALUES (?, ?, ?) ON CONFLICT (id) DO UPDATE "
            "SET number = excluded.number, settings = excluded.settings");
        for (const StoredPoint& point : points) {
            insert.bind(1, point.number);
            insert.bind(2, point.id);
            insert.bind(3, to_json_line(point.settings));
            insert.exec();
            insert.reset();
        }
        transaction.commit();
        SQLite::Statement select(database_->sqlite, "SELECT number, key FROM point");
        while (select.executeStep()) {
            database_->point_keys[select.getColumn(0).getUInt()] = select.getColumn(1).getInt64();
        }
    });
}

std::vector<StoredRun> Store::runs() const {
    return told(path_, [&] {
        std::vector<StoredRun> runs;
        SQLite::Statement select(
            database_->sqlite,
            fmt::format(
                R"(SELECT run.key AS "run.key", run.id AS "run.id", point.number AS "run.point",
               replication AS "run.replication", error AS "run.error", {}
               FROM run LEFT JOIN point ON point.key = run.point
               ORDER BY point.number, replication)",
                columns("{0} AS \"run.{0}\"")));
        const StoredRow row(path_, select, 1);
        while (select.executeStep()) {
            runs.push_back({row.text(1), row.number(2), row.number(3), row.text(4), {}});
            int column = 5;
            for_each_column([&]<class T>(const Field<Measurement, T>& field) {
                T& value = runs.back().measurement.*field.member;
                if constexpr (std::is_same_v<T, std::string>)
                    value = row.text(column++);
                else
                    value = row.real(column++);
            });
        }
        return runs;
    });
}

void Store::record(const StoredRun& run) {
    told(path_, [&] {
        Database& d = *database_;
        if (!d.insert_run) {
            d.insert_run.emplace(d.sqlite,
                                 fmt::format("INSERT INTO run (id, point, replication, error, {}) "
                                             "VALUES (?, ?, ?, ?, {})",
                                             columns("{}"), columns("?")));
            d.insert_metric.emplace(d.sqlite, "INSERT INTO metric VALUES (?, ?, ?)");
        }
        SQLite::Transaction transaction(d.sqlite);
        SQLite::Statement remove(d.sqlite, "DELETE FROM run WHERE id = ? AND error != ''");
        remove.bind(1, run.id);
        remove.exec();
        const Measurement& m = run.measurement;
        d.insert_run->reset();
        SQLite::bind(*d.insert_run, run.id, d.point_keys.at(run.point), run.replication, run.error);
        int column = 5;
        for_each_column([&](const auto& field) { d.insert_run->bind(column++, m.*field.member); });
        d.insert_run->exec();
        const std::int64_t key = d.sqlite.getLastInsertRowid();
        for (const MetricValue& metric : m.metrics) {
            const std::int64_t name = d.metric_key(metric.name);
            d.insert_metric->reset();
            d.insert_metric->bind(1, key);
            d.insert_metric->bind(2, name);
            if (metric.value)
                d.insert_metric->bind(3, *metric.value);
            else
                d.insert_metric->bind(3);
            d.insert_metric->exec();
        }
        transaction.commit();
    });
}

std::vector<StoredValue> Store::values(const std::string& metric,
                                       std::optional<std::uint32_t> point) const {
    return told(path_, [&] {
        std::vector<StoredValue> values;
        SQLite::Statement select(database_->sqlite,
                                 R"(SELECT metric.run AS "metric.run", metric.name AS "metric.name",
               point.number AS "point.number", replication AS "run.replication",
               value AS "metric.value"
               FROM run JOIN point ON point.key = run.point
               JOIN metric ON metric.run = run.key
               AND metric.name = (SELECT key FROM metric_name WHERE name = ?)
               WHERE error = '' AND point.number BETWEEN ? AND ?
               ORDER BY point.number, replication)");
        select.bind(1, metric);
        select.bind(2, point.value_or(0));
        select.bind(3, point.value_or(UINT32_MAX));
        const StoredRow row(path_, select, 2);
        while (select.executeStep()) {
            values.push_back({row.number(2), row.number(3), row.optional_real(4)});
        }
        return values;
    });
}

std::vector<std::string> Store::metric_names() const {
    return told(path_, [&] {
        std::vector<std::string> names;
        SQLite::Statement select(database_->sqlite, "SELECT name FROM metric_name ORDER BY key");
        while (select.executeStep()) names.push_back(select.getColumn(0).getString());
        return names;
    });
}

void Store::for_each_value(
    const std::function<void(const StoredValue&, const std::string& metric)>& visit) const {
    told(path_, [&] {
        SQLite::Statement select(database_->sqlite,
                                 R"(SELECT metric.run AS "metric.run", metric.name AS "metric.name",
               point.number AS "point.number", replication AS "run.replication",
               value AS "metric.value", metric_name.name AS "metric_name.name"
               FROM run JOIN point ON point.key = run.point JOIN metric ON metric.run = run.key
               JOIN metric_name ON metric_name.key = metric.name WHERE error = ''
               ORDER BY point.number, replication, metric_name.name)");
        const StoredRow row(path_, select, 2);
        while (select.executeStep()) {
            visit({row.number(2), row.number(3), row.optional_real(4)}, row.text(5));
        }
    });
}

void Store::query(const std::string& sql,
                  const std::function<void(const std::vector<std::string>&)>& row) const {
    const OnlyReading guard(database_->sqlite.getHandle());
    need_one_statement(database_->sqlite.getHandle(), sql);
    try {
        SQLite::Statement select(database_->sqlite, sql);
        std::vector<std::string> cells;
        for (int i = 0; i < select.getColumnCount(); ++i) cells.push_back(select.getColumnName(i));
        row(cells);
        while (select.executeStep()) {
            for (int i = 0; i < select.getColumnCount(); ++i) {
                cells[static_cast<std::size_t>(i)] = select.getColumn(i).getString();
            }
            row(cells);
        }
    } catch (const SQLite::Exception& error) {
        throw std::invalid_argument(fmt::format(
            "--sql: {}; the tables are study, point, run, metric_name and metric; there is also a "
            "view named \"result\"",
            guard.denied() ? "only reading is allowed; expected SELECT ..." : error.what()));
    }
}

}  // namespace rovernet
