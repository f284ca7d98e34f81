// SPDX-License-Identifier: MIT
#include "study/store.hpp"

#include "experiment/json.hpp"
#include "sim/error.hpp"

#include <fmt/format.h>

#include <SQLiteCpp/SQLiteCpp.h>
#include <SQLiteCpp/VariadicBind.h>
#include <chrono>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <map>
#include <sqlite3.h>
#include <sys/file.h>
#include <thread>
#include <unistd.h>

namespace rovernet {
namespace {

constexpr int application = 0x726f766e;  // "rovn"
constexpr int format = 1;

constexpr const char* schema = R"(
CREATE TABLE study (key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE point (key INTEGER PRIMARY KEY, number INTEGER NOT NULL, id TEXT NOT NULL UNIQUE,
                    settings TEXT NOT NULL);
CREATE INDEX point_number ON point (number);
CREATE TABLE run (key INTEGER PRIMARY KEY, id TEXT NOT NULL UNIQUE,
                  point INTEGER NOT NULL REFERENCES point, replication INTEGER NOT NULL,
                  error TEXT NOT NULL, fingerprint TEXT NOT NULL, cpu_s REAL NOT NULL,
                  wall_s REAL NOT NULL, started TEXT NOT NULL, host TEXT NOT NULL,
                  UNIQUE (point, replication));
CREATE TABLE metric_name (key INTEGER PRIMARY KEY, name TEXT NOT NULL UNIQUE);
CREATE TABLE metric (run INTEGER NOT NULL REFERENCES run, name INTEGER NOT NULL REFERENCES metric_name,
                     value REAL, PRIMARY KEY (run, name)) WITHOUT ROWID;
CREATE VIEW result AS
    SELECT point.number AS point, point.settings, run.replication, metric_name.name AS metric,
           metric.value
    FROM metric JOIN run ON run.key = metric.run JOIN point ON point.key = run.point
         JOIN metric_name ON metric_name.key = metric.name;
)";

/// The right to write, held until the file is closed.
class WriteLock {
  public:
    explicit WriteLock(const std::string& path)
        : file_(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
        if (file_ < 0) {
            throw RunError(
                fmt::format("{}: cannot be written ({}); check the folder and its "
                            "permissions, or give another with --store",
                            path, std::strerror(errno)));
        }
        using namespace std::chrono_literals;
        // The workers of a sweep that was killed may hold it for a moment longer.
        for (int i = 0; flock(file_, LOCK_EX | LOCK_NB) != 0; ++i) {
            if (i == 100) {
                close(file_);
                throw RunError(path +
                               ": another sweep is writing to this store; wait for its end, "
                               "or give another with --store");
            }
            std::this_thread::sleep_for(10ms);
        }
    }
    ~WriteLock() { close(file_); }
    WriteLock(const WriteLock&) = delete;
    WriteLock& operator=(const WriteLock&) = delete;

  private:
    int file_;
};

/// Runs `act`; what SQLite throws becomes an error that a user can mend.
auto told(const std::string& path, auto&& act) {
    try {
        return act();
    } catch (const SQLite::Exception& error) {
        switch (error.getErrorCode()) {
            case SQLITE_NOTADB:
            case SQLITE_CORRUPT: throw InputError({path}, "no store of a study, or a damaged one");
            case SQLITE_FULL:
                throw RunError(path +
                               ": the disk is full; what was finished is kept: make room "
                               "and go on with the same command");
            case SQLITE_READONLY:
            case SQLITE_CANTOPEN:
            case SQLITE_PERM:
                throw RunError(path +
                               ": cannot be written; check the permissions of the file and "
                               "of its folder, or give another with --store");
            default:
                throw RunError(fmt::format("{}: {} (SQLite {}); what was finished is kept", path,
                                           error.what(), error.getExtendedErrorCode()));
        }
    }
}

void bind_value(SQLite::Statement& statement, int index, const std::optional<double>& value) {
    if (value) {
        statement.bind(index, *value);
    } else {
        statement.bind(index);
    }
}

std::optional<double> value_in(const SQLite::Column& column) {
    return column.isNull() ? std::nullopt : std::optional(column.getDouble());
}

}  // namespace

struct Store::Database {
    Database(const std::string& path, int flags) : sqlite(path, flags, 5000) {}

    void make_schema();
    std::int64_t metric_key(const std::string& name);

    std::unique_ptr<WriteLock> lock;  // outlives the connection: see flock(2) and SQLite's locks
    SQLite::Database sqlite;
    std::map<std::uint32_t, std::int64_t> point_keys;  // by number
    std::map<std::string, std::int64_t> metric_keys;
    std::optional<SQLite::Statement> insert_run, insert_metric;
};

void Store::Database::make_schema() {
    SQLite::Transaction transaction(sqlite);
    sqlite.exec(schema);
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
    if (made_by != application) throw InputError({path_}, "not a store of a study");
    if (version > format) {
        throw InputError({path_},
                         fmt::format("a store of format {}, made by a newer rovernet; this "
                                     "one knows up to {}: update it",
                                     version, format));
    }
}

Store Store::open(const std::string& path) {
    if (!std::filesystem::is_regular_file(path)) {
        throw InputError({path}, "no such store; rovernet sweep FILE makes one");
    }
    return told(
        path, [&] { return Store(path, std::make_unique<Database>(path, SQLite::OPEN_READONLY)); });
}

Store Store::open_to_write(const std::string& path) {
    if (std::filesystem::is_directory(path)) throw InputError({path}, "a directory, not a store");
    auto lock = std::make_unique<WriteLock>(path);
    return told(path, [&] {
        auto database =
            std::make_unique<Database>(path, SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
        database->lock = std::move(lock);
        // Not the file's size: a process killed while it made the tables leaves some of them.
        const int tables =
            database->sqlite.execAndGet("SELECT count(*) FROM sqlite_master").getInt();
        if (tables == 0) database->make_schema();
        Store store(path, std::move(database));
        // Against kill -9; a power cut may take the last runs, but never the file's order.
        store.database_->sqlite.exec("PRAGMA journal_mode = WAL");
        store.database_->sqlite.exec("PRAGMA synchronous = NORMAL");
        return store;
    });
}

Store::~Store() {
    if (!database_ || !database_->lock) return;
    database_->insert_run.reset();
    database_->insert_metric.reset();
    try {  // one plain file, that can be read where nothing can be written
        database_->sqlite.exec("PRAGMA journal_mode = DELETE");
    } catch (const SQLite::Exception&) {
        // Somebody reads: it stays as it is, and can be read as well.
    }
}
Store::Store(Store&&) noexcept = default;
Store& Store::operator=(Store&&) noexcept = default;

std::string Store::property(const std::string& key) const {
    return told(path_, [&] {
        SQLite::Statement select(database_->sqlite, "SELECT value FROM study WHERE key = ?");
        select.bind(1, key);
        return select.executeStep() ? select.getColumn(0).getString() : std::string();
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
        SQLite::Statement select(database_->sqlite,
                                 "SELECT number, id, settings FROM point ORDER BY number");
        while (select.executeStep()) {
            const Value settings = parse_json(select.getColumn(2).getString());
            points.push_back({select.getColumn(0).getUInt(), select.getColumn(1).getString(),
                              settings.table() ? *settings.table() : Table{}});
        }
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
            "SELECT run.id, point.number, replication, error, fingerprint, cpu_s, wall_s, started, "
            "host FROM run JOIN point ON point.key = run.point ORDER BY point.number, replication");
        while (select.executeStep()) {
            runs.push_back({.id = select.getColumn(0).getString(),
                            .point = select.getColumn(1).getUInt(),
                            .replication = select.getColumn(2).getUInt(),
                            .error = select.getColumn(3).getString(),
                            .measurement = {.metrics = {},
                                            .fingerprint = select.getColumn(4).getString(),
                                            .cpu_s = select.getColumn(5).getDouble(),
                                            .wall_s = select.getColumn(6).getDouble(),
                                            .started = select.getColumn(7).getString(),
                                            .host = select.getColumn(8).getString()}});
        }
        return runs;
    });
}

void Store::record(const StoredRun& run) {
    told(path_, [&] {
        Database& d = *database_;
        if (!d.insert_run) {
            d.insert_run.emplace(
                d.sqlite,
                "INSERT INTO run (id, point, replication, error, fingerprint, "
                "cpu_s, wall_s, started, host) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)");
            d.insert_metric.emplace(d.sqlite, "INSERT INTO metric VALUES (?, ?, ?)");
        }
        SQLite::Transaction transaction(d.sqlite);
        SQLite::Statement remove(d.sqlite, "DELETE FROM run WHERE id = ? AND error != ''");
        remove.bind(1, run.id);
        remove.exec();
        const Measurement& m = run.measurement;
        d.insert_run->reset();
        SQLite::bind(*d.insert_run, run.id, d.point_keys.at(run.point), run.replication, run.error,
                     m.fingerprint, m.cpu_s, m.wall_s, m.started, m.host);
        d.insert_run->exec();
        const std::int64_t key = d.sqlite.getLastInsertRowid();
        for (const MetricValue& metric : m.metrics) {
            const std::int64_t name = d.metric_key(metric.name);
            d.insert_metric->reset();
            d.insert_metric->bind(1, key);
            d.insert_metric->bind(2, name);
            bind_value(*d.insert_metric, 3, metric.value);
            d.insert_metric->exec();
        }
        transaction.commit();
    });
}

std::vector<StoredValue> Store::values(const std::string& metric,
                                       std::optional<std::uint32_t> point) const {
    return told(path_, [&] {
        std::vector<StoredValue> values;
        SQLite::Statement select(
            database_->sqlite,
            "SELECT point.number, replication, value FROM run JOIN point ON point.key = run.point "
            "JOIN metric ON metric.run = run.key AND metric.name = (SELECT key FROM metric_name "
            "WHERE name = ?) WHERE error = '' AND point.number BETWEEN ? AND ? "
            "ORDER BY point.number, replication");
        select.bind(1, metric);
        select.bind(2, point.value_or(0));
        select.bind(3, point.value_or(UINT32_MAX));
        while (select.executeStep()) {
            values.push_back({select.getColumn(0).getUInt(), select.getColumn(1).getUInt(),
                              value_in(select.getColumn(2))});
        }
        return values;
    });
}

void Store::for_each_value(
    const std::function<void(const StoredValue&, const std::string& metric)>& visit) const {
    told(path_, [&] {
        SQLite::Statement select(
            database_->sqlite,
            "SELECT point.number, replication, metric_name.name, value FROM run "
            "JOIN point ON point.key = run.point JOIN metric ON metric.run = run.key "
            "JOIN metric_name ON metric_name.key = metric.name WHERE error = '' "
            "ORDER BY point.number, replication, metric_name.name");
        while (select.executeStep()) {
            visit({select.getColumn(0).getUInt(), select.getColumn(1).getUInt(),
                   value_in(select.getColumn(3))},
                  select.getColumn(2).getString());
        }
    });
}

void Store::query(const std::string& sql,
                  const std::function<void(const std::vector<std::string>&)>& row) const {
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
        throw std::invalid_argument(
            fmt::format("--sql: {}; the tables are study, point, run, metric_name, metric and the "
                        "view result",
                        error.what()));
    }
}

}  // namespace rovernet
