// SPDX-License-Identifier: MIT
#include "mobility/kept_planners.hpp"

#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <memory>
#include <string>
#include <vector>

namespace kept_planners_test {
using namespace rovernet;

namespace {

std::shared_ptr<const Scene> empty_map(std::size_t columns, std::size_t rows) {
    return std::make_shared<const Scene>(
        test::drawn_map(std::vector<std::string>(rows, std::string(columns, '.'))));
}

}  // namespace

TEST_CASE(
    "kept planners: each scene has its own planners, and repeated calls return the same planners") {
    KeptPlanners kept;
    const auto one = empty_map(3, 2), other = empty_map(3, 2);
    const auto planners = kept.of(one);
    CHECK(&planners->scene() == one.get());
    CHECK(&kept.of(other)->scene() == other.get());
    CHECK(kept.of(one) == planners);
    CHECK(kept.of(nullptr) == nullptr);  // an open field
}

TEST_CASE("kept planners: a new scene at the memory address of an old scene gets new planners") {
    KeptPlanners kept;
    for (std::size_t columns = 1; columns < 20; ++columns) {
        const auto scene = empty_map(columns, 1);
        REQUIRE(kept.of(scene)->scene().upper_right().x == static_cast<double>(columns));
    }
}

TEST_CASE("kept planners: only planners of scenes in use, or of scenes used recently, are kept") {
    KeptPlanners kept(35);  // three maps of 10 cells, not four
    std::vector<std::weak_ptr<const Scene>> seen;
    const auto in_use = empty_map(5, 2);
    const auto planners = kept.of(in_use);
    for (int i = 0; i < 5; ++i) {
        const auto scene = empty_map(5, 2);
        kept.of(scene);
        CHECK(kept.of(in_use) == planners);
        seen.push_back(scene);
    }
    for (std::size_t i = 0; i < 5; ++i) CHECK(seen[i].expired() == (i < 3));
    const auto large = empty_map(100, 1);
    const auto its_planners = kept.of(large);
    CHECK(kept.of(large) == its_planners);
    CHECK(seen[4].expired());
}

}  // namespace kept_planners_test
