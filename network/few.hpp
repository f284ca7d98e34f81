// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

// Lists for a table with an entry for each robot, most of them empty: a million empty std::vectors
// take 24 MB, a million empty Few take 8 MB.

namespace rovernet {

/// List that is usually empty: an empty Few has the size of a pointer. Applications store the
/// callbacks of each node in a Few.
template <class T>
class Few {
  public:
    /// Whether the list is empty; an empty list has no allocated memory.
    bool empty() const { return !values_; }
    /// Number of values in the list.
    std::size_t size() const { return values_ ? values_->size() : 0; }
    /// Value with index `i`, 0 ... size() - 1.
    const T& operator[](std::size_t i) const { return (*values_)[i]; }
    /// Appends a value; references to the values become invalid.
    void push_back(T value) {
        if (!values_) values_ = std::make_unique<std::vector<T>>();
        values_->push_back(std::move(value));
    }

    /// Removes the values for which gone(value) is true and keeps the order of the rest; an empty
    /// list frees its memory.
    template <class Gone>
    void erase_if(Gone gone) {
        if (!values_) return;
        std::erase_if(*values_, gone);
        if (values_->empty()) values_.reset();
    }

  private:
    // Values of the list; null if the list is empty.
    std::unique_ptr<std::vector<T>> values_;
};

}  // namespace rovernet
