// SPDX-License-Identifier: MIT
#include "sim/sieve.hpp"

#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

using namespace rovernet;

TEST_CASE("sieve: what is to be kept is, in order, however much there is and however often") {
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
