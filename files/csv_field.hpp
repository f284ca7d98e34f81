// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace rovernet {

/// Text as a field of a CSV line: in quotes if it contains a comma, a quote or a line break.
/// Source: RFC 4180, section 2.
inline std::string csv_field(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string field = "\"";
    for (const char c : text) field += c == '"' ? std::string("\"\"") : std::string(1, c);
    return field + '"';
}

}  // namespace rovernet
