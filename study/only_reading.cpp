// SPDX-License-Identifier: MIT
#include "study/only_reading.hpp"

#include <fmt/format.h>

#include <sqlite3.h>
#include <stdexcept>
#include <string_view>

namespace rovernet {
namespace {

/// SQLite authorizer: decides which actions a query may perform. @param denied  a bool, set where
/// it may not
int allow(void* denied, int action, const char* first, const char* second, const char*,
          const char*) {
    const auto is = [](const char* name, std::string_view word) { return name && name == word; };
    const auto allowed_if = [denied](bool good) {
        if (good) return SQLITE_OK;
        *static_cast<bool*>(denied) = true;
        return SQLITE_DENY;
    };
    switch (action) {
        case SQLITE_SELECT:
        case SQLITE_READ:
        case SQLITE_RECURSIVE: return SQLITE_OK;
        case SQLITE_FUNCTION: return allowed_if(!is(second, "load_extension"));
        case SQLITE_PRAGMA: return allowed_if(is(first, "table_info") || is(first, "table_list"));
        default: return allowed_if(false);
    }
}

/// Number of statements in `sql`, at most 2; one that is wrong counts, and ends the count.
int statements_in(sqlite3* database, const char* sql) {
    int count = 0;
    while (*sql != '\0' && count < 2) {
        sqlite3_stmt* statement = nullptr;
        const char* rest = sql;
        const int code = sqlite3_prepare_v2(database, sql, -1, &statement, &rest);
        if (code != SQLITE_OK || statement) ++count;  // none: blanks and comments alone
        sqlite3_finalize(statement);
        if (code != SQLITE_OK || rest == sql) break;
        sql = rest;
    }
    return count;
}

}  // namespace

void need_one_statement(sqlite3* database, const std::string& sql) {
    const int count = statements_in(database, sql.c_str());
    if (count == 1) return;
    throw std::invalid_argument(
        fmt::format("--sql: found {}; expected one statement, such as SELECT * FROM result",
                    count == 0 ? "no statement" : "more than one statement"));
}

OnlyReading::OnlyReading(sqlite3* database) : database_(database) {
    sqlite3_set_authorizer(database_, allow, &denied_);
}
OnlyReading::~OnlyReading() { sqlite3_set_authorizer(database_, nullptr, nullptr); }

}  // namespace rovernet
