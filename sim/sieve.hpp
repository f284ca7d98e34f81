// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>

namespace rovernet {

/// List of the values that pass a test, filled without a branch: where half of the values pass in
/// no order, a branch would be mispredicted for many of them. Every value is written, and the end
/// moves on by 0 or 1.
///
///   Sieve<int> odd;
///   odd.clear();
///   for (int i : numbers) odd.put(i, i % 2 == 1);
///   use(odd.kept());
///
/// A Sieve is kept from one use to the next for its memory, which grows to the most ever kept and
/// is never given back. The medium finds receivers with it, a flood the copies that are news.
///
/// @tparam T  default-constructible and copyable, small
template <class T>
class Sieve {
  public:
    /// Forgets the values; their memory stays for the next use.
    void clear() { next_ = values_.get(); }
    /// Adds `value` behind the kept ones if `keep` is true.
    void put(const T& value, bool keep) {
        if (next_ == end_) [[unlikely]]
            grow(1);
        *next_ = value;
        next_ += keep;
    }
    /// Makes room for `count` more values behind the kept ones, for a loop that writes there itself
    /// and needs no check of room for each. keep_to() ends it.
    /// @return where the next value goes
    T* room(std::size_t count) {
        if (end_ - next_ < static_cast<std::ptrdiff_t>(count)) grow(count);
        return next_;
    }
    /// Keeps all values before `end`, which lies in what room() gave. Keeps all values before
    /// `end`, which lies in what room() gave: the second half of such a loop.
    void keep_to(T* end) { next_ = end; }
    /// Kept values, in the order in which they came. Good until the next put(), room() or clear().
    std::span<T> kept() const { return {values_.get(), next_}; }

  private:
    // Doubles the memory, with room for `more` values. Out of line, as it is rare: put() and room()
    // take fewer registers.
    [[gnu::noinline]] void grow(std::size_t more) {
        const std::span<T> old = kept();
        const std::size_t size = 2 * (old.size() + more) + 16;
        auto values = std::make_unique<T[]>(size);
        next_ = std::copy(old.begin(), old.end(), values.get());
        end_ = values.get() + size;
        values_ = std::move(values);
    }

    std::unique_ptr<T[]> values_;
    // Place behind the kept values, and the end of the memory.
    T* next_ = nullptr;
    T* end_ = nullptr;
};

}  // namespace rovernet
