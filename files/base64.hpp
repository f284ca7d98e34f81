// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace rovernet {

/// Base64 of bytes (RFC 4648, section 4), for data inside a document: with padding, in one line.
std::string base64(std::string_view bytes);

/// Bytes of a base64 text; nothing if it is not what base64() would have made of some bytes.
std::optional<std::string> from_base64(std::string_view text);

}  // namespace rovernet
