// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace rovernet {

/// Base64 encoding of bytes (RFC 4648, section 4), with padding, in one line.
std::string base64(std::string_view bytes);

/// Bytes of a base64 text; empty optional unless base64() could have produced exactly this text.
std::optional<std::string> from_base64(std::string_view text);

}  // namespace rovernet
