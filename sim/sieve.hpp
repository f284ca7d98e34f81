// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>

namespace rovernet {

/// List of the values that pass a test, filled without a branch: a branch would often be
/// mispredicted if about half of the values pass in random order. Every value is written, and the
/// end advances by 0 or 1.
///
///   Sieve<int> odd;
///   odd.clear();
///   for (int i : numbers) odd.put(i, i % 2 == 1);
///   use(odd.kept());
///
/// Reuse a Sieve for its memory, which grows to the largest number of kept values and is never
/// freed. The medium finds receivers with a Sieve; a flood finds the copies that were not received
/// before.
///
/// @tparam T  default-constructible and copyable, small
template <class T>
class Sieve {
  public:
    /// Removes all values; the memory stays for reuse.
    void clear() { next_ = values_.get(); }
    /// Appends `value` if `keep` is true.
    void put(const T& value, bool keep) {
        if (next_ == end_) [[unlikely]]
            grow(1);
        *next_ = value;
        next_ += keep;
    }
    /// Reserves memory for `count` more values, for a loop that writes values itself without a
    /// check of memory. Call keep_to() after the loop.
    /// @return pointer to the place of the next value
    T* room(std::size_t count) {
        if (end_ - next_ < static_cast<std::ptrdiff_t>(count)) grow(count);
        return next_;
    }
    /// Ends a loop that writes into room(): keeps all values before `end`.
    void keep_to(T* end) { next_ = end; }
    /// Kept values, in the order of their addition. Valid until the next put(), room() or clear().
    std::span<T> kept() const { return {values_.get(), next_}; }

  private:
    // Doubles the memory, with space for `more` values. Not inlined, because it is rare: put() and
    // room() then need fewer registers.
    [[gnu::noinline]] void grow(std::size_t more) {
        const std::span<T> old = kept();
        const std::size_t size = 2 * (old.size() + more) + 16;
        auto values = std::make_unique<T[]>(size);
        next_ = std::copy(old.begin(), old.end(), values.get());
        end_ = values.get() + size;
        values_ = std::move(values);
    }

    std::unique_ptr<T[]> values_;
    // End of the kept values, and end of the memory.
    T* next_ = nullptr;
    T* end_ = nullptr;
};

}  // namespace rovernet
