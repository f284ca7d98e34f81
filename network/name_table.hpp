// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// Names that all differ, numbered in the order in which they came, and found again.
///
/// The characters lie in one pool; the index is an open-addressed table of numbers (linear probing
/// by XXH64), at most four fifths full. A name takes its characters and ten bytes or so.
class NameTable {
  public:
    /// Room for `names` names, apart from their characters.
    void reserve(std::size_t names);
    /// Adds the next name, which must not be there yet.
    /// @throws std::length_error if all names together are longer than 4 GB
    void add(std::string_view name);

    std::size_t size() const { return ends_.size(); }
    /// The number of a name, if it is there.
    std::optional<std::uint32_t> find(std::string_view name) const;
    /// The name of that number, which must be there; good until the next add().
    std::string_view operator[](std::uint32_t number) const {
        const std::size_t begin = number == 0 ? 0 : ends_[number - 1];
        return std::string_view(characters_).substr(begin, ends_[number] - begin);
    }

  private:
    static constexpr std::uint32_t none = 0xffffffff;

    std::size_t place(std::string_view name) const;
    void lay_index(std::size_t names);

    std::string characters_;
    std::vector<std::uint32_t> ends_;            // in characters_, by number
    std::vector<std::uint32_t> index_ = {none};  // numbers; a power of two, one at least is free
};

}  // namespace rovernet
