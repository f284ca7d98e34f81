// SPDX-License-Identifier: MIT
#include "sim/random.hpp"

#include "network/neighbour.hpp"

#include <boost/math/distributions/normal.hpp>
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

namespace random_test {
using namespace rovernet;

namespace {

constexpr std::size_t samples = 200'000;
constexpr double sigmas = 5;  // keys are fixed; of a million such checks one would fail by chance
// Kolmogorov-Smirnov: sqrt(n) D exceeds this once in 10^6 (2 exp(-2 x^2)).
constexpr double ks_bound = 2.70;
constexpr double quantile_bound = 2e-15;  // relative, as random.hpp states

const double root_n = std::sqrt(static_cast<double>(samples));

Key nth_key(std::size_t i) {
    return {.seed = 1, .purpose = Purpose::placement, .a = name_key("r7"), .b = 3, .index = i};
}

template <class Draw>
std::vector<double> draws(Draw draw) {
    std::vector<double> x(samples);
    for (std::size_t i = 0; i < samples; ++i) x[i] = draw(nth_key(i));
    return x;
}

// The mean of (x - centre)^power.
double moment(const std::vector<double>& x, double centre, int power) {
    double sum = 0;
    for (const double v : x) sum += std::pow(v - centre, power);
    return sum / static_cast<double>(x.size());
}

// Is a mean over all samples, of terms of standard deviation sd, the expected one?
bool mean_is(double mean, double expected, double sd) {
    return std::abs(mean - expected) < sigmas * sd / root_n;
}

// sqrt(n) times the greatest distance between the sample's and the true distribution function.
template <class Cdf>
double kolmogorov_smirnov(std::vector<double> x, Cdf cdf) {
    std::sort(x.begin(), x.end());
    const auto n = static_cast<double>(x.size());
    double distance = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double p = cdf(x[i]);
        const auto rank = static_cast<double>(i);
        distance = std::max({distance, p - rank / n, (rank + 1) / n - p});
    }
    return distance * std::sqrt(n);
}

// The six fields of a key, each changed by one.
std::array<Key, 6> neighbours(const Key& key) {
    std::array<Key, 6> all;
    all.fill(key);
    ++all[0].seed;
    ++all[1].replication;
    all[2].purpose = static_cast<Purpose>(static_cast<std::uint16_t>(key.purpose) + 1);
    ++all[3].a;
    ++all[4].b;
    ++all[5].index;
    return all;
}

// Keys as a run has them: small numbers in most fields.
Key small_key(std::size_t i) {
    return {.seed = i % 7,
            .replication = static_cast<std::uint32_t>(i % 30),
            .purpose = static_cast<Purpose>(1 + i % 4),
            .a = i % 1000,
            .b = i / 1000,
            .index = i};
}

// Keys of robots as a test numbers them, or made of their names.
std::vector<std::uint64_t> robot_keys(bool named, std::size_t count) {
    std::vector<std::uint64_t> keys;
    for (std::size_t i = 0; i < count; ++i) {
        keys.push_back(named ? name_key("r" + std::to_string(i)) : i);
    }
    return keys;
}

// A draw for each pair of `count` robots.
template <class Draw>
auto draws_of_pairs(bool named, std::size_t count, Draw draw) {
    const auto keys = robot_keys(named, count);
    std::vector<decltype(draw(0, 0))> all;
    for (std::size_t b = 0; b < count; ++b) {
        for (std::size_t a = 0; a < b; ++a) all.push_back(draw(keys[a], keys[b]));
    }
    return all;
}

// A pair's bits, then those of its neighbours: either key or the stream changed by one, and one bit
// moved from the one key to the other.
std::array<std::uint64_t, 7> near_pairs(std::size_t i) {
    const std::uint64_t a = 2 * (i % 1000), b = 2 * (i / 1000) + 5000;
    const auto draws = [&](std::uint64_t seed, std::uint32_t replication, Purpose purpose) {
        return PairDraws(seed, replication, purpose);
    };
    const auto usual = draws(i % 7, 2, Purpose::order);
    return {usual.bits(a, b),
            usual.bits(a + 1, b),
            usual.bits(a, b + 1),
            usual.bits(a + 1, b + 1),
            draws(i % 7 + 1, 2, Purpose::order).bits(a, b),
            draws(i % 7, 3, Purpose::order).bits(a, b),
            draws(i % 7, 2, Purpose::placement).bits(a, b)};
}

double exact_quantile(double p) {
    const boost::math::normal_distribution<long double> standard;
    return static_cast<double>(quantile(standard, static_cast<long double>(p)));
}

}  // namespace

TEST_CASE("philox: outputs equal the published known answers of Random123") {
    using Counter = std::array<std::uint32_t, 4>;
    CHECK(philox4x32_10({0, 0, 0, 0}, {0, 0}) ==
          Counter{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8});
    CHECK(
        philox4x32_10({0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}, {0xffffffff, 0xffffffff}) ==
        Counter{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd});
    CHECK(
        philox4x32_10({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}) ==
        Counter{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1});
}

TEST_CASE(
    "combine: outputs equal those published for splitmix64; the order of the arguments matters") {
    constexpr std::uint64_t golden = 0x9e3779b97f4a7c15;
    constexpr std::uint64_t first_of_seed_0 = 0xe220a8397b1dcdaf;
    CHECK(combine(0, golden + 1234567 - first_of_seed_0) == 6457827717110365317);
    CHECK(combine(1, 2) != combine(2, 1));
    CHECK(combine(combine(1, 2), 3) != combine(1, combine(2, 3)));
}

TEST_CASE("name key: the key of a name equals the published values of XXH64") {
    CHECK(name_key("") == 0xef46db3751d8e999);
    CHECK(name_key("a") == 0xd24ec4f1a98c6e5b);
    CHECK(name_key("abc") == 0x44bc2cf5ad770999);
}

TEST_CASE("random: equal keys give equal bits with every compiler") {
    const Key key{.seed = 7,
                  .replication = 3,
                  .purpose = Purpose::flood_jitter,
                  .a = name_key("r0"),
                  .b = combine(name_key("base"), 41),
                  .index = 2};
    CHECK(bits({}) == 0x371fca386636ad85);
    CHECK(bits({.seed = 1, .purpose = Purpose::order}) == 0xd2c7c639007f340b);
    CHECK(bits(key) == 0xb20992b1bd882ab3);
    CHECK(uniform(key) == 0x1.641325637b105p-1);
    CHECK(normal(key) == 0x1.05d4001bb9c1bp-1);
    CHECK(exponential(key) == 0x1.73e676872921bp-2);
    CHECK(below(key, 1000) == 695);
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < samples; ++i) {
        sum = combine(sum, std::bit_cast<std::uint64_t>(normal(nth_key(i))));
    }
    CHECK(sum == 0x26bf317e6803070b);
}

TEST_CASE("random: the code numbers of the purposes of random numbers never change") {
    CHECK(static_cast<int>(Purpose::flood_jitter) == 1);
    CHECK(static_cast<int>(Purpose::link_shadowing) == 2);
    CHECK(static_cast<int>(Purpose::placement) == 3);
    CHECK(static_cast<int>(Purpose::order) == 4);
}

TEST_CASE("uniform: moments and distribution of the random draws agree with theory") {
    const auto u = draws(uniform);
    CHECK(mean_is(moment(u, 0, 1), 0.5, std::sqrt(1 / 12.0)));
    CHECK(mean_is(moment(u, 0.5, 2), 1 / 12.0, std::sqrt(1 / 180.0)));
    CHECK(mean_is(moment(u, 0.5, 3), 0, std::sqrt(1 / 448.0)));
    CHECK(mean_is(moment(u, 0.5, 4), 1 / 80.0, std::sqrt(1 / 3600.0)));
    CHECK(kolmogorov_smirnov(u, [](double x) { return x; }) < ks_bound);
}

TEST_CASE("uniform: draws are midpoints of the cells of a grid, so they are never 0 or 1") {
    for (std::size_t i = 0; i < samples; ++i) {
        const double cell = std::ldexp(uniform(nth_key(i)), 52);
        REQUIRE(cell - std::floor(cell) == 0.5);
        REQUIRE((cell > 0 && cell < 0x1p52));
    }
}

TEST_CASE("normal: moments and distribution of the random draws agree with theory") {
    const auto x = draws(normal);
    CHECK(mean_is(moment(x, 0, 1), 0, 1));
    CHECK(mean_is(moment(x, 0, 2), 1, std::sqrt(2.0)));
    CHECK(mean_is(moment(x, 0, 3), 0, std::sqrt(15.0)));
    CHECK(mean_is(moment(x, 0, 4), 3, std::sqrt(96.0)));
    const boost::math::normal standard;
    CHECK(kolmogorov_smirnov(x, [&](double v) { return cdf(standard, v); }) < ks_bound);
}

TEST_CASE("exponential: moments and distribution of the random draws agree with theory") {
    const auto x = draws(exponential);
    CHECK(mean_is(moment(x, 0, 1), 1, 1));
    CHECK(mean_is(moment(x, 0, 2), 2, std::sqrt(20.0)));
    CHECK(mean_is(moment(x, 0, 3), 6, std::sqrt(684.0)));
    CHECK(kolmogorov_smirnov(x, [](double v) { return -std::expm1(-v); }) < ks_bound);
    CHECK(*std::min_element(x.begin(), x.end()) > 0);
}

TEST_CASE("normal quantile: the quantile agrees with Boost.Math from tail to tail") {
    for (double p = 0x1p-53; p < 0.5; p *= 1.01) {
        CAPTURE(p);
        REQUIRE(std::abs(normal_quantile(p) / exact_quantile(p) - 1) < quantile_bound);
        const double upper = 1 - p;
        REQUIRE(std::abs(normal_quantile(upper) / exact_quantile(upper) - 1) < quantile_bound);
    }
    for (const double tail : {1e-20, 1e-100, 1e-300}) {
        CHECK(std::abs(normal_quantile(tail) / exact_quantile(tail) - 1) < quantile_bound);
    }
    CHECK(normal_quantile(0.5) == 0);
    CHECK(normal_quantile(0x1p-53) > -8.21);
}

TEST_CASE("below: below(n) gives every value from 0 to n - 1 equally often") {
    std::array<double, 10> count{};
    for (std::size_t i = 0; i < samples; ++i) ++count.at(below(nth_key(i), count.size()));
    const double expected = static_cast<double>(samples) / 10;
    double chi_square = 0;
    for (const double c : count) chi_square += (c - expected) * (c - expected) / expected;
    CHECK(chi_square < 45);  // 9 degrees of freedom: once in 10^6
    constexpr auto all = std::numeric_limits<std::uint64_t>::max();
    for (std::size_t i = 0; i < 1000; ++i) {
        CHECK(below(nth_key(i), 1) == 0);
        CHECK(below(nth_key(i), all) < all);
    }
}

TEST_CASE("random: keys that differ by 1 in any field give independent numbers") {
    std::array<double, 6> product{};
    for (std::size_t i = 0; i < samples; ++i) {
        const Key key = small_key(i);
        const double x = uniform(key) - 0.5;
        const auto near = neighbours(key);
        for (std::size_t field = 0; field < near.size(); ++field) {
            product[field] += 12 * x * (uniform(near[field]) - 0.5);
        }
    }
    for (const double p : product) CHECK(mean_is(p / static_cast<double>(samples), 0, 1));
}

TEST_CASE("random: incrementing any field of a key flips each bit of the result half of the time") {
    std::array<std::array<int, 64>, 6> flips{};
    for (std::size_t i = 0; i < samples / 4; ++i) {
        const auto near = neighbours(small_key(i));
        for (std::size_t field = 0; field < near.size(); ++field) {
            const std::uint64_t changed = bits(small_key(i)) ^ bits(near[field]);
            for (std::size_t bit = 0; bit < 64; ++bit)
                flips[field][bit] += (changed >> bit & 1) != 0 ? 1 : 0;
        }
    }
    const double n = static_cast<double>(samples) / 4;
    for (const auto& field : flips) {
        for (const int count : field) CHECK(std::abs(count - n / 2) < sigmas * std::sqrt(n) / 2);
    }
}

TEST_CASE("random: different keys made of small numbers never give the same random number") {
    std::vector<std::uint64_t> all;
    for (std::size_t i = 0; i < samples; ++i) {
        all.push_back(bits(small_key(i)));
        all.push_back(bits({.a = i}));
        all.push_back(bits({.b = i + 1}));
        all.push_back(bits({.index = i + 1}));
        all.push_back(bits({.seed = i + 1}));
        all.push_back(combine(i, 0));
        all.push_back(combine(0, i + 1));
    }
    std::sort(all.begin(), all.end());
    CHECK(std::adjacent_find(all.begin(), all.end()) == all.end());
}

TEST_CASE(
    "pair draws: the random number of a pair of robots has the same bits in both directions and "
    "with every compiler") {
    const PairDraws draws(7, 3, Purpose::link_shadowing);
    const std::uint64_t a = name_key("r0"), b = name_key("base");
    const std::uint64_t stream = combine(7, 3 << 16 | 2);
    CHECK(draws.bits(a, b) == mix(mix(stream + a) + mix(stream + b)));
    CHECK(draws.bits(a, b) == draws.bits(b, a));
    CHECK(draws.bits(a, b) == 0x93feb66b29b1f615);
    CHECK(draws.uniform(a, b) == (static_cast<double>(draws.bits(a, b) >> 12) + 0.5) * 0x1p-52);
    CHECK(draws.normal(a, b) == normal_quantile(draws.uniform(a, b)));
}

TEST_CASE("pair draws: moments and distribution over all pairs of some robots agree with theory") {
    constexpr std::size_t robots = 633;  // 200,028 pairs
    const PairDraws draws(1, 0, Purpose::link_shadowing);
    for (const bool named : {false, true}) {
        CAPTURE(named);
        const auto u = draws_of_pairs(
            named, robots, [&](std::uint64_t a, std::uint64_t b) { return draws.uniform(a, b); });
        REQUIRE(u.size() > samples);
        CHECK(mean_is(moment(u, 0, 1), 0.5, std::sqrt(1 / 12.0)));
        CHECK(mean_is(moment(u, 0.5, 2), 1 / 12.0, std::sqrt(1 / 180.0)));
        CHECK(mean_is(moment(u, 0.5, 3), 0, std::sqrt(1 / 448.0)));
        CHECK(mean_is(moment(u, 0.5, 4), 1 / 80.0, std::sqrt(1 / 3600.0)));
        CHECK(kolmogorov_smirnov(u, [](double x) { return x; }) < ks_bound);
    }
}

TEST_CASE(
    "pair draws: pairs that share a robot have independent draws, also around a ring of pairs") {
    const PairDraws draws(1, 0, Purpose::link_shadowing);
    const auto x = [&](std::uint64_t a, std::uint64_t b) {
        return std::sqrt(12.0) * (draws.uniform(a, b) - 0.5);  // mean 0, standard deviation 1
    };
    for (const bool named : {false, true}) {
        CAPTURE(named);
        const auto key = robot_keys(named, samples + 3);
        double two = 0, three = 0, four = 0, hub = 0, squares = 0;
        for (std::size_t i = 0; i < samples; ++i) {
            const std::uint64_t a = key[i], b = key[i + 1], c = key[i + 2], d = key[i + 3];
            two += x(a, b) * x(b, c);
            three += x(a, b) * x(b, c) * x(c, a);
            four += x(a, b) * x(b, c) * x(c, d) * x(d, a);
            hub += x(key[0], b) * x(key[0], c);
            squares += (x(a, b) * x(a, b) - 1) * (x(b, c) * x(b, c) - 1);
        }
        const double n = static_cast<double>(samples);
        for (const double sum : {two, three, four, hub}) CHECK(mean_is(sum / n, 0, 1));
        CHECK(mean_is(squares / n, 0, 0.8));  // the square's variance is 12^2 / 80 - 1
    }
}

TEST_CASE(
    "pair draws: adding 1 to a key, seed, replication or purpose flips each bit half of the time") {
    std::array<std::array<int, 64>, 8> flips{};
    for (std::size_t i = 0; i < samples / 4; ++i) {
        const auto near = near_pairs(i);
        for (std::size_t other = 1; other < near.size() + 1; ++other) {
            // The last: a bit moved from the one key to the other.
            const std::uint64_t changed =
                other < near.size() ? near[0] ^ near[other] : near[1] ^ near[2];
            for (std::size_t bit = 0; bit < 64; ++bit) {
                flips[other][bit] += (changed >> bit & 1) != 0 ? 1 : 0;
            }
        }
    }
    const double n = static_cast<double>(samples) / 4;
    for (std::size_t other = 1; other < flips.size(); ++other) {
        for (const int count : flips[other]) {
            CHECK(std::abs(count - n / 2) < sigmas * std::sqrt(n) / 2);
        }
    }
}

TEST_CASE("pair draws: no two pairs share a draw, in the same or in different replications") {
    std::vector<std::uint64_t> all;
    for (std::uint32_t replication = 0; replication < 5; ++replication) {
        const PairDraws draws(1, replication, Purpose::link_shadowing);
        for (const bool named : {false, true}) {
            const auto some = draws_of_pairs(
                named, 400, [&](std::uint64_t a, std::uint64_t b) { return draws.bits(a, b); });
            all.insert(all.end(), some.begin(), some.end());
        }
    }
    std::sort(all.begin(), all.end());
    CHECK(std::adjacent_find(all.begin(), all.end()) == all.end());
}

}  // namespace random_test
