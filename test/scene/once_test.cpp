// SPDX-License-Identifier: MIT
#include "scene/once.hpp"

#include <doctest/doctest.h>

#include <stdexcept>
#include <thread>
#include <vector>

namespace once_test {
using namespace rovernet;

TEST_CASE("once: if threads request a piece of work at the same time, it is done exactly once") {
    for (int turn = 0; turn < 100; ++turn) {
        Once once;
        int works = 0;  // without a lock: whoever asked may read it
        std::vector<int> seen(4);
        std::vector<std::thread> threads;
        for (int& mine : seen)
            threads.emplace_back([&once, &works, &mine] {
                once([&works] { ++works; });
                mine = works;
            });
        for (std::thread& thread : threads) thread.join();
        REQUIRE(seen == std::vector{1, 1, 1, 1});
    }
}

TEST_CASE("once: work that failed is done again at the next request") {
    Once once;
    CHECK_THROWS_AS(once([] { throw std::runtime_error("no memory"); }), std::runtime_error);
    int works = 0;
    for (int i = 0; i < 3; ++i) once([&] { ++works; });
    CHECK(works == 1);
}

}  // namespace once_test
