// SPDX-License-Identifier: MIT
#include "models/propagation/shadowed_range.hpp"

#include "models/medium/link_range.hpp"
#include "models/propagation/list.hpp"
#include "test/models/vectors.hpp"

#include <boost/math/distributions/normal.hpp>
#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <vector>

namespace shadowed_range_test {
using namespace rovernet;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::uint64_t all_bits = ~std::uint64_t{0};

/// The number before which mix() was.
std::uint64_t unmixed(std::uint64_t x) {
    const auto unshifted = [](std::uint64_t y, int n) { return y ^ (y >> n) ^ (y >> 2 * n); };
    const auto inverse = [](std::uint64_t odd) {
        std::uint64_t y = odd;  // right in 3 bits; Newton's step doubles them
        for (int step = 0; step < 5; ++step) y *= 2 - odd * y;
        return y;
    };
    x = unshifted(x, 31) * inverse(0x94d049bb133111eb);
    x = unshifted(x, 27) * inverse(0xbf58476d1ce4e5b9);
    return unshifted(x, 30);
}

/// One after the other, the same in each run of the tests.
class Numbers {
  public:
    explicit Numbers(std::uint64_t test) : test_(test) {}
    std::uint64_t bits() {
        return rovernet::bits({.seed = test_, .purpose = Purpose::order, .index = drawn_++});
    }
    double uniform(double low, double high) {
        return low + (high - low) * static_cast<double>(bits() >> 11) * 0x1p-53;
    }
    /// With a uniform logarithm, between powers of 10.
    double any_size(double low, double high) { return std::pow(10, uniform(low, high)); }

  private:
    std::uint64_t test_;
    std::uint64_t drawn_ = 0;
};

/// The links of one run.
struct Links {
    ShadowedRange range;
    PairDraws draws;

    /// Of the robots with these keys.
    bool in_range(double squared_distance, std::uint64_t a, std::uint64_t b) const {
        return range.in_range(squared_distance, draws.bits(a, b));
    }
};

/// A network of one kind of radio.
struct Setting {
    LogDistance model{};
    Db budget{100};
    Hertz frequency{2450e6};
    std::uint64_t seed = 1;
    std::uint32_t replication = 0;

    Links links() const {
        return {ShadowedRange(model.shadowed_loss(frequency), budget),
                shadowing_draws(seed, replication)};
    }
    /// What the model says at distance `d` [m].
    bool in_budget(double d, std::uint64_t a, std::uint64_t b) const {
        const Vec3 to{d, 0, 0};
        double loss = 0;
        model.loss({.frequency = frequency,
                    .from = {},
                    .to = {&to, 1},
                    .from_key = a,
                    .to_keys = {&b, 1},
                    .seed = seed,
                    .replication = replication},
                   Db{infinity}, {&loss, 1});
        return loss <= budget.value;
    }
    /// The robot whose pair with `a` draws these bits.
    std::uint64_t partner(std::uint64_t a, std::uint64_t bits) const {
        const std::uint64_t stream =
            combine(seed, std::uint64_t{replication} << 16 |
                              static_cast<std::uint16_t>(Purpose::link_shadowing));
        return unmixed(unmixed(bits) - mix(stream + a)) - stream;
    }
    double median_range() const {
        return model.shadowed_loss(frequency).distance(budget.value);  // [m]
    }
};

/// Usual parameters, and every fourth time extreme ones.
Setting any_setting(Numbers& draw) {
    const bool extreme = draw.bits() % 4 == 0;
    const double sigma = extreme ? draw.any_size(-14, 4) : draw.uniform(0, 12);
    return {.model = {.exponent = extreme ? draw.any_size(-2, 2) : draw.uniform(1.5, 6),
                      .sigma = {sigma},
                      .reference_distance = {draw.any_size(-2, 2)}},
            .budget = {extreme ? draw.uniform(-50, 1000) : draw.uniform(50, 130)},
            .frequency = {draw.any_size(8, 10.8)},
            .seed = draw.bits(),
            .replication = static_cast<std::uint32_t>(draw.bits() % 30)};
}

/// A distance [m] at which the draw is likely to matter.
double any_distance(Numbers& draw, const Setting& setting) {
    if (draw.bits() % 50 == 0) return 0;
    const double d = setting.median_range() * draw.any_size(-2, 1.5);
    return std::isfinite(d * d) ? d : 1e150;
}

double up(double x, int steps) {
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) +
                                 static_cast<std::uint64_t>(steps));
}

/// The first number for which `holds`, false up to some number and then true, is true; or the last.
template <class Predicate>
std::uint64_t first_that(std::uint64_t last, Predicate holds) {
    std::uint64_t low = 0, high = last;
    while (low < high) {
        const std::uint64_t middle = low + (high - low) / 2;
        if (holds(middle)) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    return low;
}

/// A distance [m] not far below `d` whose square is `steps` beside an edge of the table's cells.
double cell_edge(double d, int steps) {
    const auto edge = std::bit_cast<double>(std::bit_cast<std::uint64_t>(d * d) >> 46 << 46);
    return edge > 0 ? std::sqrt(up(edge, steps)) : 0;
}

/// Disagreements of range and model at `d` [m] and a few steps of it around.
int disagreements_around(double d, const Setting& setting, const Links& links, std::uint64_t a,
                         std::uint64_t b) {
    int wrong = 0;
    for (int steps = d > 0 ? -3 : 0; steps <= 3; ++steps) {
        const double near = up(d, steps);
        wrong += links.in_range(near * near, a, b) != setting.in_budget(near, a, b);
    }
    return wrong;
}

}  // namespace

TEST_CASE("shadowed range: for a million links, in_range() agrees with loss and budget") {
    Numbers draw(1);
    int wrong = 0, in_range = 0;
    for (int network = 0; network < 1000; ++network) {
        const Setting setting = any_setting(draw);
        const Links links = setting.links();
        for (int link = 0; link < 1000; ++link) {
            const double d = any_distance(draw, setting);
            const std::uint64_t a = draw.bits(), b = draw.bits();
            const bool up = setting.in_budget(d, a, b);
            in_range += up;
            wrong += links.in_range(d * d, a, b) != up;
        }
    }
    CHECK(wrong == 0);
    CHECK(in_range > 200'000);
    CHECK(in_range < 800'000);
}

TEST_CASE(
    "shadowed range: near the distance where a link goes down, in_range() agrees with the loss") {
    Numbers draw(2);
    int wrong = 0;
    for (int network = 0; network < 500; ++network) {
        const Setting setting = any_setting(draw);
        const Links links = setting.links();
        for (const std::uint64_t bits : {std::uint64_t{0}, all_bits, draw.bits(), draw.bits(),
                                         draw.bits() >> 20, ~(draw.bits() >> 20)}) {
            const std::uint64_t a = draw.bits(), b = setting.partner(a, bits);
            const auto beyond = [&](std::uint64_t d) {
                return !setting.in_budget(std::bit_cast<double>(d), a, b);
            };
            constexpr double far = 1e150;  // [m]
            const auto border = first_that(std::bit_cast<std::uint64_t>(far), beyond);
            wrong += disagreements_around(std::bit_cast<double>(border), setting, links, a, b);
        }
        wrong += disagreements_around(0, setting, links, 1, 2);
        wrong += disagreements_around(setting.model.reference_distance.value, setting, links, 1, 2);
    }
    CHECK(wrong == 0);
}

TEST_CASE(
    "shadowed range: near the random draw at which a link goes down, in_range() agrees with the "
    "loss") {
    Numbers draw(3);
    int wrong = 0;
    for (int network = 0; network < 500; ++network) {
        const Setting setting = any_setting(draw);
        const Links links = setting.links();
        for (int look = 0; look < 10; ++look) {
            const double anywhere = any_distance(draw, setting);
            const double d = look % 2 == 0 ? anywhere : cell_edge(anywhere, look % 3 - 1);
            const std::uint64_t a = draw.bits();
            const auto out = [&](std::uint64_t bits) {
                return !setting.in_budget(d, a, setting.partner(a, bits));
            };
            const std::uint64_t border = first_that(all_bits, out);
            for (const int cells : {0, 1, 1 << 21}) {  // of 2^-52
                const std::uint64_t step = static_cast<std::uint64_t>(cells) << 12;
                for (const std::uint64_t bits : {border - std::min(border, step),
                                                 border + std::min(all_bits - border, step)}) {
                    wrong += links.in_range(d * d, a, setting.partner(a, bits)) == out(bits);
                }
            }
        }
    }
    CHECK(wrong == 0);
}

TEST_CASE(
    "shadowed range: with sigma 0, the range is the largest distance within the budget, for any "
    "random draw") {
    for (const double budget : {-1.0, 0.0, 40.0, 80.0, 120.0}) {
        CAPTURE(budget);
        const Setting setting{.model = {.sigma = 0_dB}, .budget = {budget}};
        const Links links = setting.links();
        const double last =
            largest_squared_distance(setting.model, setting.frequency, setting.budget);
        for (std::uint64_t key = 0; key < 50; ++key) {
            CHECK(links.in_range(std::max(last, 0.0), 0, key) == (last >= 0));
            CHECK_FALSE(links.in_range(up(std::max(last, 0.0), 5), 0, key));
        }
    }
}

TEST_CASE("shadowed range: with a negative budget no link is up, with an infinite budget all are") {
    for (const double d2 : {0.0, 1e-300, 1.0, 1e4, 1e300, infinity}) {
        CAPTURE(d2);
        for (std::uint64_t key = 0; key < 50; ++key) {
            CHECK_FALSE(Setting{.budget = {-0.001}}.links().in_range(d2, 0, key));
            CHECK_FALSE(Setting{.budget = {-infinity}}.links().in_range(d2, 0, key));
            CHECK(Setting{.budget = {infinity}}.links().in_range(d2, 0, key));
        }
    }
    const Links wide = Setting{.budget = {1e5}}.links();
    CHECK(wide.in_range(std::numeric_limits<double>::max(), 1, 2));
    CHECK_FALSE(wide.in_range(infinity, 1, 2));
}

TEST_CASE("shadowed range: the share of links that are up equals that by the normal distribution") {
    constexpr int pairs = 20'000;
    constexpr double k = 4;  // standard errors
    const Setting setting{.model = {.exponent = 3, .sigma = 8_dB}};
    const Links links = setting.links();
    for (const double margin : {-2.0, -1.0, 0.0, 0.5, 2.0}) {  // [sigma]
        const double d = setting.median_range() * std::pow(10, -margin * 8 / 30);
        int up = 0;
        for (std::uint64_t key = 0; key < pairs; ++key) up += links.in_range(d * d, 7, 100 + key);
        const double p = cdf(boost::math::normal(), margin);
        CHECK(test::near(up, pairs * p, k * std::sqrt(pairs * p * (1 - p))));
    }
}

TEST_CASE("shadowed range: the loss is computed for less than one link in a hundred") {
    Numbers draw(4);
    double sum = 0;
    int looks = 0;
    for (int network = 0; network < 200; ++network) {
        Setting setting = any_setting(draw);
        setting.model.sigma.value = std::max(setting.model.sigma.value, 0.01);
        setting.budget.value = std::max(setting.budget.value, 0.0);
        const Links links = setting.links();
        for (int look = 0; look < 1000; ++look, ++looks) {
            const double d = any_distance(draw, setting);
            const double share = links.range.computed_share(d * d);
            REQUIRE(share < 0.01);
            sum += share;
        }
    }
    CHECK(sum / looks < 0.002);
}

TEST_CASE(
    "shadowed range: all pairs in range pass the fast first test, and few other pairs pass it") {
    Numbers draw(77);
    for (int network = 0; network < 40; ++network) {
        const ShadowedLoss loss{.at_reference = draw.uniform(20, 60),
                                .per_decade = draw.uniform(15, 60),
                                .reference_distance = 1,
                                .sigma = draw.uniform(0, 12)};
        const PairDraws draws = shadowing_draws(draw.bits(), 0);
        const double budget = draw.uniform(60, 110), less = draw.uniform(0, 15);
        const ShadowedRange keen(loss, Db{budget}), dull(loss, Db{budget - less});
        const double reach = loss.distance(budget + ShadowedLoss::cut_sigmas * loss.sigma);
        FirstLook look(reach * reach), of_the_dull(reach * reach);
        look.let_pass(network % 2 ? dull : keen);
        look.let_pass(network % 2 ? keen : dull);
        of_the_dull.let_pass(dull);
        int passed = 0, in_range = 0;
        for (std::uint64_t i = 0; i < 5000; ++i) {
            const double d2 = draw.uniform(0, reach * reach);
            const auto at_least =
                static_cast<float>(d2 * (draw.uniform(0, 1) < 0.5 ? 1 - 1e-6 : 0.5));
            const std::uint64_t bits = draws.bits(7, i);
            const bool passes = look.passes(at_least, bits);
            if (keen.in_range(d2, bits)) REQUIRE(passes);
            if (dull.in_range(d2, bits)) REQUIRE(of_the_dull.passes(at_least, bits));
            const bool nearly_exact = static_cast<double>(at_least) > 0.9 * d2;
            passed += passes && nearly_exact;
            in_range += keen.in_range(d2, bits) && nearly_exact;
        }
        CHECK(passed <= in_range + 100);
    }
}

TEST_CASE(
    "shadowed range: pairs in range pass the fast first test, also with a reach of 0 or infinity") {
    const ShadowedLoss loss{
        .at_reference = 40, .per_decade = 30, .reference_distance = 1, .sigma = 4};
    const std::uint64_t bits = shadowing_draws(3, 1).bits(1, 2);
    for (const double reach2 : {0.0, 1e-300, 1e300, infinity}) {
        const ShadowedRange range(loss, Db{reach2 > 1 ? 1e5 : 100});
        FirstLook look(reach2);
        look.let_pass(range);
        for (const double d2 : {0.0, 1.0, 1e4, 1e30}) {
            if (range.in_range(d2, bits)) CHECK(look.passes(static_cast<float>(d2), bits));
        }
    }
}

TEST_CASE(
    "shadowed range: only `log_distance` offers a shadowed range; it gives the same links as the "
    "loss") {
    for_each_model([]<class Model>() {
        const Propagation model{[] {
            if constexpr (std::same_as<Model, Disc>)
                return Disc{.range = 40_m};
            else
                return Model{};
        }()};
        const auto offered = model.shadowed_loss(2450_MHz);
        CHECK(offered.has_value() == std::same_as<Model, LogDistance>);
        if (!offered) return;
        const Links links{ShadowedRange(*offered, 80_dB), shadowing_draws(5, 6)};
        for (std::uint64_t key = 0; key < 1000; ++key) {
            const test::OneLink link{.to = {static_cast<double>(key) / 5, 0, 1},
                                     .from_key = 77,
                                     .to_key = key,
                                     .seed = 5,
                                     .replication = 6};
            CHECK(links.in_range(squared_distance(link.from, link.to), key, 77) ==
                  (link.loss(model) <= 80));
        }
    });
}

}  // namespace shadowed_range_test
