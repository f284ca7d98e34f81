// SPDX-License-Identifier: MIT
#include "sim/sieve.hpp"

#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

namespace sieve_test {
using namespace rovernet;

TEST_CASE("sieve: exactly the selected values are kept, in order, for any number of values") {
    test::Draw draw(3);
    Sieve<int> sieve;
    CHECK(sieve.kept().empty());
    for (int round = 0; round < 40; ++round) {
        sieve.clear();
        std::vector<int> expected;
        const int values = draw.below(1 + 20 * round);
        for (int value = 0; value < values; ++value) {
            const bool keep = draw.below(3) > 0;
            sieve.put(value, keep);
            if (keep) expected.push_back(value);
        }
        const auto kept = sieve.kept();
        REQUIRE(std::equal(kept.begin(), kept.end(), expected.begin(), expected.end()));
    }
}

TEST_CASE(
    "sieve: values written into the memory of room() are kept up to the end passed to keep_to()") {
    Sieve<int> sieve;
    for (const std::size_t room : {0UL, 1UL, 5UL, 100UL, 3UL, 1000UL}) {
        sieve.put(-1, true);
        const std::size_t before = sieve.kept().size();
        int* next = sieve.room(room);
        for (std::size_t i = 0; i < room; ++i) *next++ = static_cast<int>(i);
        sieve.keep_to(next);
        const auto kept = sieve.kept();
        REQUIRE(kept.size() == before + room);
        CHECK(kept[before - 1] == -1);
        for (std::size_t i = 0; i < room; ++i) REQUIRE(kept[before + i] == static_cast<int>(i));
    }
}

}  // namespace sieve_test
