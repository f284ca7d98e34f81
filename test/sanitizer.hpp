// SPDX-License-Identifier: MIT
#pragma once

namespace rovernet::test {

/// Whether this program is built with the address sanitizer, which keeps freed memory for a while.
/// gcc defines __SANITIZE_ADDRESS__; clang before 22 has __has_feature.
#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool has_address_sanitizer = true;
#elif defined(__has_feature)
inline constexpr bool has_address_sanitizer = __has_feature(address_sanitizer);
#else
inline constexpr bool has_address_sanitizer = false;
#endif

}  // namespace rovernet::test
