// SPDX-License-Identifier: MIT
#include "models/rough_ranks.hpp"

#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

using namespace rovernet;

TEST_CASE("rough ranks: a number's rank is how many sit before it, whoever came first") {
    test::Draw draw(5);
    for (int round = 0; round < 300; ++round) {
        const auto count = static_cast<std::size_t>(draw.uniform(0, 1 + RoughRanks::most));
        // Some rounds crowd into few seats, at the end of the row.
        const double lowest = round % 3 == 0 ? 1.0 * RoughRanks::seats - 1 - round % 7 : 0;
        RoughRanks ranks;
        std::vector<std::uint32_t> seats;
        for (std::size_t i = 0; i < count; ++i) {
            const auto wanted = static_cast<std::uint32_t>(draw.uniform(lowest, RoughRanks::seats));
            const std::uint32_t seat = ranks.take(wanted);
            REQUIRE(seat >= wanted);
            // Whoever was pushed on, was so by those who sit in between.
            for (std::uint32_t between = wanted; between < seat; ++between) {
                REQUIRE(std::count(seats.begin(), seats.end(), between) == 1);
            }
            REQUIRE(std::count(seats.begin(), seats.end(), seat) == 0);
            seats.push_back(seat);
        }
        ranks.count();
        for (const std::uint32_t seat : seats) {
            const auto before = std::count_if(seats.begin(), seats.end(),
                                              [&](std::uint32_t other) { return other < seat; });
            REQUIRE(ranks.rank(seat) == before);
        }
    }
}
