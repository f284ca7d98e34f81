// SPDX-License-Identifier: MIT
#include "scene/counted_bits.hpp"

#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <cstddef>
#include <iterator>
#include <set>
#include <vector>

namespace counted_bits_test {
using namespace rovernet;

TEST_CASE("counted bits: below(n) returns how many members of the set are smaller than n") {
    test::Draw draw(41);
    for (const int end : {0, 1, 63, 64, 65, 1000}) {
        std::set<std::size_t> members;
        for (int i = 0; i < end / 3; ++i) members.insert(static_cast<std::size_t>(draw.below(end)));
        if (end > 0) members.insert(static_cast<std::size_t>(end) - 1);
        const CountedBits bits(static_cast<std::size_t>(end),
                               std::vector(members.begin(), members.end()));
        for (std::size_t n = 0; n <= static_cast<std::size_t>(end); ++n) {
            const auto below = std::distance(members.begin(), members.lower_bound(n));
            REQUIRE(bits.below(n) == static_cast<std::size_t>(below));
        }
    }
}

}  // namespace counted_bits_test
