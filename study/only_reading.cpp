// SPDX-License-Identifier: MIT
#include "study/only_reading.hpp"

#include <sqlite3.h>
#include <string_view>

namespace rovernet {
namespace {

int allow(void*, int action, const char* first, const char* second, const char*, const char*) {
    const auto is = [](const char* name, std::string_view word) { return name && name == word; };
    switch (action) {
        case SQLITE_SELECT:
        case SQLITE_READ:
        case SQLITE_RECURSIVE: return SQLITE_OK;
        case SQLITE_FUNCTION: return is(second, "load_extension") ? SQLITE_DENY : SQLITE_OK;
        case SQLITE_PRAGMA:
            return is(first, "table_info") || is(first, "table_list") ? SQLITE_OK : SQLITE_DENY;
        default: return SQLITE_DENY;
    }
}

}  // namespace

OnlyReading::OnlyReading(sqlite3* database) : database_(database) {
    sqlite3_set_authorizer(database_, allow, nullptr);
}
OnlyReading::~OnlyReading() { sqlite3_set_authorizer(database_, nullptr, nullptr); }

}  // namespace rovernet
