// SPDX-License-Identifier: MIT
#include "network/name_table.hpp"

#include "sim/random.hpp"

#include <bit>
#include <cassert>
#include <limits>
#include <stdexcept>

namespace rovernet {

/// Entry of the index that has the name, or where it has to be inserted.
std::size_t NameTable::place(std::string_view name) const {
    const std::size_t last = index_.size() - 1;
    std::size_t place = static_cast<std::size_t>(name_key(name)) & last;
    while (index_[place] != none && (*this)[index_[place]] != name) place = (place + 1) & last;
    return place;
}

/// Builds an index for this many names, with the existing ones.
void NameTable::lay_index(std::size_t names) {
    index_.assign(std::bit_ceil(names + names / 4 + 1), none);
    for (std::uint32_t i = 0; i < size(); ++i) index_[place((*this)[i])] = i;
}

void NameTable::reserve(std::size_t names) {
    ends_.reserve(names);
    if (names + names / 4 + 1 > index_.size()) lay_index(names);
}

void NameTable::add(std::string_view name) {
    assert(!find(name));
    if (name.size() > std::numeric_limits<std::uint32_t>::max() - characters_.size()) {
        throw std::length_error(
            "the names of all robots together are longer than 4 GB; expected shorter names or "
            "fewer robots");
    }
    const std::size_t names = size() + 1;
    if (names + names / 4 + 1 > index_.size()) lay_index(names);
    const std::size_t free = place(name);
    characters_ += name;
    ends_.push_back(static_cast<std::uint32_t>(characters_.size()));
    index_[free] = static_cast<std::uint32_t>(names - 1);
}

std::optional<std::uint32_t> NameTable::find(std::string_view name) const {
    const std::uint32_t found = index_[place(name)];
    if (found == none) return std::nullopt;
    return found;
}

}  // namespace rovernet
