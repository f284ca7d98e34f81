// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

// List that grows without moving its values: references to the values stay valid.

namespace rovernet {

/// List that only grows. References to its values stay valid while values are added.
///
/// The values lie in chunks of 64. Growing copies nothing, so a list of a million values needs
/// little more memory than the values; a std::vector needs up to twice as much, and three times as
/// much while it grows. The costs are one more load per access, and a whole chunk for the first
/// value.
///
/// Used by Timeline (entries), Motion (state of each node) and Slots.
///
/// @tparam T  default-constructible and movable; copyable if the list is copied
template <class T>
class Chunks {
  public:
    Chunks() = default;
    Chunks(Chunks&&) = default;
    /// Copy constructor: copies every value, so that the two lists share no memory.
    Chunks(const Chunks& other) : size_(other.size_) {
        for (const auto& chunk : other.chunks_) chunks_.push_back(std::make_unique<Chunk>(*chunk));
    }
    /// Assignment by copy and swap; also moves.
    Chunks& operator=(Chunks other) {
        std::swap(chunks_, other.chunks_);
        std::swap(size_, other.size_);
        return *this;
    }

    /// Number of values in the list.
    std::size_t size() const { return size_; }
    /// Appends a value. Every 64th call allocates memory.
    void push_back(T value) {
        if (size_ == chunks_.size() * chunk_size) chunks_.push_back(std::make_unique<Chunk>());
        (*this)[size_] = std::move(value);
        ++size_;
    }

    /// Value number `i` < size(); not checked.
    T& operator[](std::size_t i) { return (*chunks_[i / chunk_size])[i % chunk_size]; }
    const T& operator[](std::size_t i) const { return (*chunks_[i / chunk_size])[i % chunk_size]; }
    /// Value number `i`, checked: for an index that a caller passes.
    /// @throws std::out_of_range unless i < size()
    T& at(std::size_t i) {
        if (i >= size_) throw std::out_of_range("no such value in a list");
        return (*this)[i];
    }

  private:
    // Chunk size: a power of two, so that [] divides by shifting.
    static constexpr std::size_t chunk_size = 64;
    // Chunk of values, all default-constructed at first.
    using Chunk = std::array<T, chunk_size>;

    // Chunks of values; every chunk but the last is full.
    std::vector<std::unique_ptr<Chunk>> chunks_;
    // Number of values; the last chunk may have room for more.
    std::size_t size_ = 0;
};

}  // namespace rovernet
