// SPDX-License-Identifier: MIT
#include "study/only_reading.hpp"

#include <sqlite3.h>
#include <string_view>

namespace rovernet {
namespace {

/// Rule of what a question may do. @param denied  a bool, set where it may not
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

}  // namespace

OnlyReading::OnlyReading(sqlite3* database) : database_(database) {
    sqlite3_set_authorizer(database_, allow, &denied_);
}
OnlyReading::~OnlyReading() { sqlite3_set_authorizer(database_, nullptr, nullptr); }

}  // namespace rovernet
