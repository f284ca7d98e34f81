// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

// Lists for a table with an entry for each robot, of which few have something: a million empty
// std::vectors would take 24 MB, as many of these take 8.

namespace rovernet {

/// List that is mostly empty: it takes a pointer's size until there is something in it.
/// Applications keep the callbacks of each node in one.
template <class T>
class Few {
  public:
    /// Whether there are no values; then there is no memory either.
    bool empty() const { return !values_; }
    /// Number of values.
    std::size_t size() const { return values_ ? values_->size() : 0; }
    /// Value number `i` < size().
    const T& operator[](std::size_t i) const { return (*values_)[i]; }
    /// Adds a value behind the others; references to them become void.
    void push_back(T value) {
        if (!values_) values_ = std::make_unique<std::vector<T>>();
        values_->push_back(std::move(value));
    }

    /// Removes the values for which gone(value) is true; the last one takes the memory with it. The
    /// order of the others stays.
    template <class Gone>
    void erase_if(Gone gone) {
        if (!values_) return;
        std::erase_if(*values_, gone);
        if (values_->empty()) values_.reset();
    }

  private:
    // Null if there are no values.
    std::unique_ptr<std::vector<T>> values_;
};

}  // namespace rovernet
