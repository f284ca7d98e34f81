// SPDX-License-Identifier: MIT
#pragma once

#include <string>

struct sqlite3;

namespace rovernet {

/// While it lives, statements of a connection may read, and nothing else: whatever is asked, no
/// file is attached or written, no setting changed, no library loaded.
class OnlyReading {
  public:
    explicit OnlyReading(sqlite3* database);
    ~OnlyReading();
    OnlyReading(const OnlyReading&) = delete;
    OnlyReading& operator=(const OnlyReading&) = delete;

    bool denied() const { return denied_; }  ///< something but reading was asked for

  private:
    sqlite3* database_;
    bool denied_ = false;
};

/// Checks that a question is one statement. @throws std::invalid_argument
void need_one_statement(sqlite3* database, const std::string& sql);

}  // namespace rovernet
