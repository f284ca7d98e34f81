// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// Names that all differ, numbered in the order in which they came, and found again: the names of
/// robots, whose number is their NodeId.
///
/// The characters lie in one pool; the index is an open-addressed table of numbers (linear probing
/// by XXH64), at most four fifths full. A name takes its characters and ten bytes or so.
class NameTable {
  public:
    /// Makes room for `names` names, apart from their characters.
    void reserve(std::size_t names);
    /// Adds the next name, which must not be there yet.
    /// @throws std::length_error if all names together are longer than 4 GB
    void add(std::string_view name);

    /// Number of names.
    std::size_t size() const { return ends_.size(); }
    /// Number of a name, if it is there.
    std::optional<std::uint32_t> find(std::string_view name) const;
    /// Name of that number, which must be there; good until the next add().
    std::string_view operator[](std::uint32_t number) const {
        const std::size_t begin = number == 0 ? 0 : ends_[number - 1];
        return std::string_view(characters_).substr(begin, ends_[number] - begin);
    }

  private:
    // Place of the index that is free.
    static constexpr std::uint32_t none = 0xffffffff;

    // Place in the index where the name is, or where it belongs.
    std::size_t place(std::string_view name) const;
    // Makes an index for so many names, with those that are there.
    void lay_index(std::size_t names);

    // Names, one behind the other.
    std::string characters_;
    // End of each name in characters_, by its number.
    std::vector<std::uint32_t> ends_;
    // Numbers by the hash of their names; its size is a power of two, and one place at least is
    // free.
    std::vector<std::uint32_t> index_ = {none};
};

}  // namespace rovernet
