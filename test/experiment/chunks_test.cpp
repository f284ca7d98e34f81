// SPDX-License-Identifier: MIT
#include "experiment/chunks.hpp"

#include "experiment/few.hpp"

#include <doctest/doctest.h>

#include <memory>
#include <stdexcept>
#include <vector>

using namespace rovernet;

TEST_CASE("chunks: values come back by number and stay where they are") {
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

TEST_CASE("chunks: at() refuses a number beyond the last value, also within a chunk") {
    Chunks<int> list;
    CHECK_THROWS_AS(list.at(0), std::out_of_range);
    list.push_back(7);
    CHECK(list.at(0) == 7);
    CHECK_THROWS_AS(list.at(1), std::out_of_range);
}

TEST_CASE("few: an empty list is as large as a pointer, and grows like any other") {
    CHECK(sizeof(Few<int>) == sizeof(void*));
    Few<int> list;
    CHECK(list.empty());
    CHECK(list.size() == 0);
    for (int i = 0; i < 10; ++i) list.push_back(i * i);
    CHECK_FALSE(list.empty());
    REQUIRE(list.size() == 10);
    for (std::size_t i = 0; i < 10; ++i) CHECK(list[i] == static_cast<int>(i * i));
}
