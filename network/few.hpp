// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace rovernet {

/// A list that is mostly empty: takes a pointer's size until there is something in it.
template <class T>
class Few {
  public:
    bool empty() const { return !values_; }
    std::size_t size() const { return values_ ? values_->size() : 0; }
    const T& operator[](std::size_t i) const { return (*values_)[i]; }
    void push_back(T value) {
        if (!values_) values_ = std::make_unique<std::vector<T>>();
        values_->push_back(std::move(value));
    }

    /// Removes those of which gone(value) is true.
    template <class Gone>
    void erase_if(Gone gone) {
        if (!values_) return;
        std::erase_if(*values_, gone);
        if (values_->empty()) values_.reset();
    }

  private:
    std::unique_ptr<std::vector<T>> values_;
};

}  // namespace rovernet
