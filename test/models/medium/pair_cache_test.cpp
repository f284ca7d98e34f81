// SPDX-License-Identifier: MIT
#include "models/medium/pair_cache.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <optional>

namespace pair_cache_test {
using namespace rovernet;

namespace {

constexpr NodeId a{0}, b{1}, c{2};
constexpr Db budget{90};

/// What is kept of the loss [dB] from one node to another, for a query of that budget.
std::optional<double> kept(PairCache& cache, NodeId from, NodeId to, Db cutoff = budget) {
    cache.open(from, cutoff);
    const double* const loss = cache.find(to);
    return loss ? std::optional(*loss) : std::nullopt;
}

void keep(PairCache& cache, NodeId from, NodeId to, double loss_db) {
    cache.open(from, budget);
    REQUIRE(cache.renew(1));
    cache.keep(to, loss_db);
}

}  // namespace

TEST_CASE(
    "pair cache: a loss is stored for one direction of a link, not for the opposite direction") {
    PairCache cache;
    CHECK(kept(cache, a, b) == std::nullopt);
    keep(cache, a, b, 70);
    CHECK(kept(cache, a, b) == 70);
    CHECK(kept(cache, a, c) == std::nullopt);
    CHECK(kept(cache, b, a) == std::nullopt);
    keep(cache, b, a, 71);
    CHECK(kept(cache, b, a) == 71);
    CHECK(kept(cache, a, b) == 70);
}

TEST_CASE("pair cache: a stored loss becomes invalid when one of the link's two robots moves") {
    for (const NodeId moved : {a, b}) {
        PairCache cache;
        keep(cache, a, b, 70);
        cache.moved(c);
        CHECK(kept(cache, a, b) == 70);
        cache.moved(moved);
        CHECK(kept(cache, a, b) == std::nullopt);
        keep(cache, a, b, 60);
        CHECK(kept(cache, a, b) == 60);
    }
}

TEST_CASE("pair cache: each pair gets its own loss, in whatever order losses are stored") {
    PairCache cache;
    for (std::uint32_t round = 0; round < 50; ++round) {
        for (std::uint32_t from = 0; from < 7; ++from) {
            cache.open(NodeId{from}, budget);
            REQUIRE(cache.renew(5));
            for (std::uint32_t k = 0; k < 5; ++k) {
                const std::uint32_t to = (from + 1 + (k + round) % 6) % 7;
                cache.keep(NodeId{to}, 10.0 * from + to);
            }
        }
        for (std::uint32_t from = 0; from < 7; ++from) {
            int found = 0;
            for (std::uint32_t to = 0; to < 7; ++to) {
                const auto loss = kept(cache, NodeId{from}, NodeId{to});
                if (loss) CHECK(*loss == 10.0 * from + to);
                found += loss.has_value();
            }
            CHECK(found == 5);
        }
    }
}

TEST_CASE(
    "pair cache: if a loss is only known to exceed a cut-off, it is not reused for a larger "
    "cut-off") {
    PairCache cache;
    keep(cache, a, b, 95);  // more than the budget of 90 dB: who knows how much
    CHECK(kept(cache, a, b, Db{80}) == 95);
    CHECK(kept(cache, a, b, Db{90}) == 95);
    CHECK(kept(cache, a, b, Db{91}) == std::nullopt);
}

TEST_CASE("pair cache: for a sender with stored losses, the cut-off of new losses is not lowered") {
    PairCache cache;
    keep(cache, a, b, 95);
    CHECK(cache.open(a, Db{80}) == budget);
    CHECK(cache.open(a, Db{100}) == Db{100});
    CHECK(cache.open(b, Db{-20}) == Db{-20});
}

TEST_CASE("pair cache: memory is bounded, and freed when a node moves") {
    PairCache cache(10);
    cache.open(a, budget);
    REQUIRE(cache.renew(6));
    cache.keep(b, 70);
    CHECK(cache.pairs() == 6);
    cache.open(b, budget);
    CHECK_FALSE(cache.renew(5));
    CHECK(cache.find(a) == nullptr);
    CHECK(kept(cache, a, b) == 70);
    CHECK(cache.renew(5));  // in the memory that it has
    CHECK(cache.renew(10));
    CHECK_FALSE(cache.renew(11));
    CHECK(cache.pairs() == 0);
    cache.open(b, budget);
    REQUIRE(cache.renew(10));
    cache.moved(b);
    CHECK(cache.pairs() == 0);
}

}  // namespace pair_cache_test
