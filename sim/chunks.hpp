// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

namespace rovernet {

/// A list that only grows, whose values stay where they are: chunks of 64, so that a long one
/// takes hardly more memory than its values.
template <class T>
class Chunks {
  public:
    Chunks() = default;
    Chunks(Chunks&&) = default;
    Chunks(const Chunks& other) : size_(other.size_) {
        for (const auto& chunk : other.chunks_) chunks_.push_back(std::make_unique<Chunk>(*chunk));
    }
    Chunks& operator=(Chunks other) {
        std::swap(chunks_, other.chunks_);
        std::swap(size_, other.size_);
        return *this;
    }

    std::size_t size() const { return size_; }
    void push_back(T value) {
        if (size_ == chunks_.size() * chunk_size) chunks_.push_back(std::make_unique<Chunk>());
        (*this)[size_] = std::move(value);
        ++size_;
    }

    T& operator[](std::size_t i) { return (*chunks_[i / chunk_size])[i % chunk_size]; }
    const T& operator[](std::size_t i) const { return (*chunks_[i / chunk_size])[i % chunk_size]; }
    /// @throws std::out_of_range if there is no such value
    T& at(std::size_t i) {
        if (i >= size_) throw std::out_of_range("no such value in a list");
        return (*this)[i];
    }

  private:
    static constexpr std::size_t chunk_size = 64;
    using Chunk = std::array<T, chunk_size>;

    std::vector<std::unique_ptr<Chunk>> chunks_;
    std::size_t size_ = 0;
};

}  // namespace rovernet
