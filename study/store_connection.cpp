// SPDX-License-Identifier: MIT
#include "study/store_connection.hpp"

#include "sim/error.hpp"

#include <filesystem>
#include <sqlite3.h>
#include <system_error>

namespace rovernet {
namespace {

constexpr int patience = 5000;          // [ms] for a lock of somebody who reads or writes
constexpr int long_patience = 600'000;  // [ms] for those who read while a run is kept
constexpr const char* without_locks = "unix-none";  // a VFS of SQLite's

const int to_read_only = SQLite::OPEN_READONLY;
const int to_read_and_write = SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE;

std::unique_ptr<SQLite::Database> connect(const std::string& path, int flags, bool has_locks) {
    return std::make_unique<SQLite::Database>(path, flags, patience,
                                              has_locks ? "" : without_locks);
}

/// Makes a first query, since SQLite opens the file only then.
void touch(SQLite::Database& sqlite) { sqlite.execAndGet("PRAGMA schema_version"); }

/// Whether a journal is kept beside the file, WAL. It needs memory that processes share.
bool keeps_wal(SQLite::Database& sqlite) {
    try {
        const std::string mode = sqlite.execAndGet("PRAGMA journal_mode = WAL").getString();
        if (mode != "wal") return false;
        sqlite.exec("BEGIN IMMEDIATE; ROLLBACK");
        return true;
    } catch (const SQLite::Exception& error) {
        const int code = error.getErrorCode();
        if (code != SQLITE_IOERR && code != SQLITE_CANTOPEN && code != SQLITE_PROTOCOL) throw;
        return false;
    }
}

/// A connection that rolls back; a WAL that is there comes into the file, by memory of its own.
std::unique_ptr<SQLite::Database> connect_to_roll_back(const std::string& path, bool has_locks) {
    auto sqlite = connect(path, to_read_and_write, has_locks);
    sqlite->exec("PRAGMA locking_mode = EXCLUSIVE");
    sqlite->exec("PRAGMA journal_mode = DELETE");
    sqlite->exec("PRAGMA locking_mode = NORMAL");
    touch(*sqlite);  // gives the lock back
    std::error_code ignored;
    std::filesystem::remove(path + "-shm", ignored);  // of the attempt with WAL
    sqlite->setBusyTimeout(long_patience);
    return sqlite;
}

/// A connection for reading in place. Without locks of ranges SQLite says that the file is busy.
std::unique_ptr<SQLite::Database> connect_to_read(const std::string& path) {
    auto sqlite = connect(path, to_read_only, true);
    sqlite->setBusyTimeout(0);
    try {
        touch(*sqlite);
    } catch (const SQLite::Exception& error) {
        const int code = error.getErrorCode();
        if (code != SQLITE_BUSY && code != SQLITE_IOERR) throw;
        if (!has_range_locks(path)) {
            need_no_writer(path);
            sqlite = connect(path, to_read_only, false);
        }
    }
    sqlite->setBusyTimeout(patience);
    touch(*sqlite);
    return sqlite;
}

/// Whether a copy may be readable after this error of reading in place.
bool is_mended_by_copy(const SQLite::Exception& error) {
    switch (error.getErrorCode()) {
        case SQLITE_IOERR:
        case SQLITE_CANTOPEN:
        case SQLITE_READONLY:
        case SQLITE_PROTOCOL: return true;
        default: return false;
    }
}

}  // namespace

StoreConnection::Copy::Copy(const std::string& path) {
    namespace fs = std::filesystem;
    try {
        for (const char* ending : {"", "-wal", "-journal"})
            if (fs::exists(path + ending)) fs::copy_file(path + ending, file() + ending);
    } catch (const fs::filesystem_error& error) {
        throw RunError(path + ": cannot be copied to a temporary folder for reading (" +
                       error.code().message() + ")");
    }
}

StoreConnection StoreConnection::to_write(const std::string& path) {
    StoreConnection made;
    made.lock = std::make_unique<WriteLock>(path);
    const bool has_locks = has_range_locks(path);
    // Processes of several hosts share files, but no memory: WAL is for one host.
    const bool may_keep_wal = has_locks && made.lock->is_whole() && !is_shared_by_hosts(path);
    if (may_keep_wal) made.sqlite = connect(path, to_read_and_write, true);
    if (!may_keep_wal || !keeps_wal(*made.sqlite)) {
        made.sqlite.reset();
        made.sqlite = connect_to_roll_back(path, has_locks);
    }
    // Against kill -9; a power cut may take the last runs, but never the file's order.
    made.sqlite->exec("PRAGMA synchronous = NORMAL");
    return made;
}

StoreConnection StoreConnection::to_read(const std::string& path) {
    StoreConnection made;
    try {
        made.sqlite = connect_to_read(path);
        return made;
    } catch (const SQLite::Exception& error) {
        if (!is_mended_by_copy(error)) throw;
    }
    need_no_writer(path);
    made.copy = std::make_unique<Copy>(path);
    made.sqlite = connect_to_roll_back(made.copy->file(), false);  // nobody else knows it
    made.sqlite->exec("PRAGMA query_only = ON");
    return made;
}

}  // namespace rovernet
