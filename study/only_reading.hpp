// SPDX-License-Identifier: MIT
#pragma once

#include <string>

struct sqlite3;

namespace rovernet {

/// Guard that makes an SQLite connection read-only during the guard's lifetime. SQL statements
/// cannot attach or write files, change settings or load libraries.
class OnlyReading {
  public:
    explicit OnlyReading(sqlite3* database);
    ~OnlyReading();
    OnlyReading(const OnlyReading&) = delete;
    OnlyReading& operator=(const OnlyReading&) = delete;

    /// Whether an SQL statement was denied, because the statement would not only read.
    bool denied() const { return denied_; }

  private:
    sqlite3* database_;
    bool denied_ = false;
};

/// Checks that an SQL text is a single statement. @throws std::invalid_argument if it is not
void need_one_statement(sqlite3* database, const std::string& sql);

}  // namespace rovernet
