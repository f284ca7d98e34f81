// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <new>

// Counter of the allocations of a test program. This header replaces operator new, so only one file
// of a program may include it.

namespace rovernet::test {

/// Number of allocations so far.
inline std::size_t& allocations() {
    static std::size_t count = 0;
    return count;
}

inline void* counted(void* memory) {
    ++allocations();
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}

}  // namespace rovernet::test

[[gnu::noinline]] void* operator new(std::size_t size) {
    return rovernet::test::counted(std::malloc(std::max(size, std::size_t{1})));
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
    const auto a = static_cast<std::size_t>(alignment);
    return rovernet::test::counted(std::aligned_alloc(a, (size + a - 1) / a * a));
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    ++rovernet::test::allocations();
    return std::malloc(std::max(size, std::size_t{1}));
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept {
    std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    std::free(memory);
}
