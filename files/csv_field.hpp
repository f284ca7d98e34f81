// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace rovernet {

/// Text converted to a field of a CSV line. A text with a comma, a quote or a line break is quoted.
/// Source: RFC 4180, section 2.
inline std::string csv_field(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string field = "\"";
    for (const char c : text) field += c == '"' ? std::string("\"\"") : std::string(1, c);
    return field + '"';
}

}  // namespace rovernet
