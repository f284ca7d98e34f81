// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// Table of distinct names, numbered in the order of insertion, with search by name. For the names
/// of robots the number is the NodeId.
///
/// All characters are in one pool; the index is an open-addressed hash table of numbers (linear
/// probing with XXH64), at most 4/5 full. A name needs its characters and about ten bytes.
class NameTable {
  public:
    /// Reserves memory for `names` names, without their characters.
    void reserve(std::size_t names);
    /// Adds the next name, which must not be in the table.
    /// @throws std::length_error if the total length of all names exceeds 4 GB
    void add(std::string_view name);

    /// Number of names.
    std::size_t size() const { return ends_.size(); }
    /// Number of a name; empty if the name is not in the table.
    std::optional<std::uint32_t> find(std::string_view name) const;
    /// Name with the number `number`, which must be < size(); the view is valid until the next
    /// add().
    std::string_view operator[](std::uint32_t number) const {
        const std::size_t begin = number == 0 ? 0 : ends_[number - 1];
        return std::string_view(characters_).substr(begin, ends_[number] - begin);
    }

  private:
    // Value of a free entry of the index.
    static constexpr std::uint32_t none = 0xffffffff;

    // Place in the index of the entry for `name`; if there is none, place at which to insert the
    // entry.
    std::size_t place(std::string_view name) const;
    // Builds an index with room for `names` names, and enters the existing names.
    void lay_index(std::size_t names);

    // Characters of all names.
    std::string characters_;
    // End of each name in characters_, by number.
    std::vector<std::uint32_t> ends_;
    // Hash table of the numbers of names, by the hash of the name; the size is a power of two, and
    // at least one entry is free.
    std::vector<std::uint32_t> index_ = {none};
};

}  // namespace rovernet
