// SPDX-License-Identifier: MIT
#pragma once

#include "files/temporary_directory.hpp"
#include "study/write_lock.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <memory>
#include <string>

// Opening the SQLite file of a store. The method depends on the file system, see
// docs/guide/slurm.md:
//
//   local, with locks and shared mappings         journal WAL: readers work while a process writes
//   shared by hosts, or no shared mappings        rollback journal: readers wait for a moment
//   no range locks                                rollback journal, without SQLite's locks: no
//                                                 reading during a write

namespace rovernet {

/// Connection to the SQLite file of a study's store.
struct StoreConnection {
    /// Opens a connection for writing; creates the file if missing.
    /// @throws RunError if another process writes to the file; SQLite::Exception
    static StoreConnection to_write(const std::string& path);
    /// Opens a connection for reading. If a killed process left a journal that cannot be recovered
    /// in place, the connection is to a copy of the file in a temporary folder.
    /// @throws RunError if another process writes to the file, and SQLite's locks do not allow
    /// reading meanwhile; SQLite::Exception
    static StoreConnection to_read(const std::string& path);

    /// Copy of the store's file in a temporary folder.
    struct Copy {
        /// @throws RunError if the file cannot be copied
        explicit Copy(const std::string& path);
        std::string file() const { return folder.path() + "/store.db"; }
        TemporaryDirectory folder;
    };

    std::unique_ptr<Copy> copy = {};
    std::unique_ptr<WriteLock> lock = {};  ///< lock of a writer; outlives `sqlite`, see flock(2)
    std::unique_ptr<SQLite::Database> sqlite;
};

}  // namespace rovernet
