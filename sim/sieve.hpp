// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>

namespace rovernet {

/// Values of which some are kept, decided without a branch: where it cannot be foretold which, a
/// branch would be mispredicted.
template <class T>
class Sieve {
  public:
    void clear() { next_ = values_.get(); }
    /// Keeps `value` behind the others, or not.
    void put(const T& value, bool keep) {
        if (next_ == end_) [[unlikely]]
            grow(1);
        *next_ = value;
        next_ += keep;
    }
    /// Space behind those kept for `count` more, to be filled without put(); then keep_to() is
    /// told where they end.
    T* room(std::size_t count) {
        if (end_ - next_ < static_cast<std::ptrdiff_t>(count)) grow(count);
        return next_;
    }
    void keep_to(T* end) { next_ = end; }
    /// Good until the next put() or room().
    std::span<T> kept() const { return {values_.get(), next_}; }

  private:
    // Out of line, as it is rare: put() and room() take fewer registers.
    [[gnu::noinline]] void grow(std::size_t more) {
        const std::span<T> old = kept();
        const std::size_t size = 2 * (old.size() + more) + 16;
        auto values = std::make_unique<T[]>(size);
        next_ = std::copy(old.begin(), old.end(), values.get());
        end_ = values.get() + size;
        values_ = std::move(values);
    }

    std::unique_ptr<T[]> values_;
    T* next_ = nullptr;  // behind those that are kept
    T* end_ = nullptr;
};

}  // namespace rovernet
