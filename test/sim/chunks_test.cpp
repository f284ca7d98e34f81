// SPDX-License-Identifier: MIT
#include "sim/chunks.hpp"

#include "sim/slots.hpp"

#include <doctest/doctest.h>

#include <memory>
#include <stdexcept>
#include <vector>

namespace chunks_test {
using namespace rovernet;

TEST_CASE("chunks: values are found by their index and never move in memory") {
    Chunks<std::unique_ptr<int>> list;
    std::vector<const std::unique_ptr<int>*> places;
    for (int i = 0; i < 1000; ++i) {
        list.push_back(std::make_unique<int>(i));
        places.push_back(&list[static_cast<std::size_t>(i)]);
    }
    CHECK(list.size() == 1000);
    for (std::size_t i = 0; i < 1000; ++i) {
        CHECK(*list[i] == static_cast<int>(i));
        CHECK(&list[i] == places[i]);
    }
}

TEST_CASE(
    "chunks: at() refuses an index beyond the last value, even if the last chunk has room for more "
    "values") {
    Chunks<int> list;
    CHECK_THROWS_AS(list.at(0), std::out_of_range);
    list.push_back(7);
    CHECK(list.at(0) == 7);
    CHECK_THROWS_AS(list.at(1), std::out_of_range);
}

TEST_CASE("chunks: a list and its copy can be changed independently of each other") {
    Chunks<int> list;
    for (int i = 0; i < 100; ++i) list.push_back(i);
    Chunks<int> copy = list;
    list[70] = -1;
    copy.push_back(100);
    CHECK(list.size() == 100);
    REQUIRE(copy.size() == 101);
    for (std::size_t i = 0; i < 101; ++i) CHECK(copy[i] == static_cast<int>(i));
    list = copy;
    CHECK(list[70] == 70);
    CHECK(list.size() == 101);
}

TEST_CASE(
    "memory slots: a freed slot is reused with its old value, and values never move in memory") {
    Slots<std::vector<int>> slots;
    std::vector<const std::vector<int>*> places;
    for (std::size_t i = 0; i < 200; ++i) {
        REQUIRE(slots.take() == i);
        slots[i].assign(1, static_cast<int>(i));
        places.push_back(&slots[i]);
    }
    for (std::size_t i = 0; i < 200; ++i) CHECK(&slots[i] == places[i]);
    slots.release(70);
    slots.release(3);
    CHECK(slots.take() == 3);
    CHECK(slots.take() == 70);
    CHECK(slots[70] == std::vector{70});
    CHECK(slots.take() == 200);
}

}  // namespace chunks_test
