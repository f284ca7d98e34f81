// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

// Long lists that grow while references to their values are kept.

namespace rovernet {

/// A list that only grows, whose values never move: references stay valid while others are added.
///
/// The values lie in chunks of 64. Growing moves no value and frees none, so that a list of a
/// million values takes hardly more memory than they do; a std::vector takes up to twice as much,
/// and thrice while it grows. The price is one more load for each access, and a whole chunk for the
/// first value.
///
/// Timeline keeps its entries in one, Motion what it knows of each node; Slots is made of it.
///
/// @tparam T  default-constructible and movable; copyable if the list is copied
template <class T>
class Chunks {
  public:
    Chunks() = default;
    Chunks(Chunks&&) = default;
    /// Copy of the list and of each value; nothing is shared.
    Chunks(const Chunks& other) : size_(other.size_) {
        for (const auto& chunk : other.chunks_) chunks_.push_back(std::make_unique<Chunk>(*chunk));
    }
    /// Assignment of a copy, or of a list that is moved from.
    Chunks& operator=(Chunks other) {
        std::swap(chunks_, other.chunks_);
        std::swap(size_, other.size_);
        return *this;
    }

    /// Number of values.
    std::size_t size() const { return size_; }
    /// Adds a value behind the others. Every 64th call allocates.
    void push_back(T value) {
        if (size_ == chunks_.size() * chunk_size) chunks_.push_back(std::make_unique<Chunk>());
        (*this)[size_] = std::move(value);
        ++size_;
    }

    /// Value number `i` < size(); not checked.
    T& operator[](std::size_t i) { return (*chunks_[i / chunk_size])[i % chunk_size]; }
    const T& operator[](std::size_t i) const { return (*chunks_[i / chunk_size])[i % chunk_size]; }
    /// Value number `i`, checked: for numbers that come from a caller.
    /// @throws std::out_of_range unless i < size()
    T& at(std::size_t i) {
        if (i >= size_) throw std::out_of_range("no such value in a list");
        return (*this)[i];
    }

  private:
    // A power of two, so that [] divides by shifting.
    static constexpr std::size_t chunk_size = 64;
    // Chunk of values, all default-constructed at first.
    using Chunk = std::array<T, chunk_size>;

    // Every chunk but the last is full.
    std::vector<std::unique_ptr<Chunk>> chunks_;
    // Values so far; the last chunk has room for more.
    std::size_t size_ = 0;
};

}  // namespace rovernet
