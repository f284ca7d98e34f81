// SPDX-License-Identifier: MIT
// What it costs to decide whether a shadowed link is up: CPU time [ns] per link, the least of three
// repetitions, and the ratio to a check of the squared distance. All links are from one
// transmitter, the receivers spread evenly over a disc of some median ranges.
//
//   distance  squared distance against the median range: no shadowing
//   range     ShadowedRange
//   loss      LogDistance::loss against the budget
//   philox    the same, with a draw by bits(Key) for each link
#include "bench/least.hpp"
#include "models/propagation/log_distance.hpp"
#include "models/propagation/shadowed_range.hpp"
#include "network/network.hpp"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <vector>

using namespace rovernet;

namespace {

constexpr std::size_t links = 4096;  // too many to learn which are up
constexpr int rounds = 500;          // timed, in each repetition
constexpr Hertz frequency{2450e6};
constexpr Db budget{80};

struct Network {
    double sigma;   // [dB]
    double radius;  // of the disc [median ranges]; 0: as far as anybody hears
};
constexpr Network networks[] = {{4, 2}, {4, 0}, {8, 2}, {8, 0}};

/// The links of one network: all that the ways to decide look at.
struct Links {
    explicit Links(const Network& network) : model{.exponent = 3, .sigma = {network.sigma}} {
        median_range = loss().distance(budget.value);
        const double radius = network.radius > 0 ? network.radius * median_range
                                                 : model.reach(budget, frequency).value;
        for (std::size_t i = 0; i < links; ++i) {
            const double u = uniform({.purpose = Purpose::placement, .index = i});
            const Vec3 at{radius * std::sqrt(u), 0, 0};
            to.push_back(at);
            squared.push_back(squared_distance(from, at));
            keys.push_back(name_key(fmt::format("r{}", i)));
        }
    }
    ShadowedLoss loss() const { return model.shadowed_loss(frequency); }

    LogDistance model;
    double median_range = 0;  // [m]
    Vec3 from;
    std::uint64_t from_key = name_key("base");
    std::vector<Vec3> to;
    std::vector<double> squared;  // [m^2]
    std::vector<std::uint64_t> keys;
};

// Every way below is made of the links and has count(), how many of them are up.

class ByDistance {
  public:
    explicit ByDistance(const Links& of) : of_(of) {}
    std::size_t count() const {
        const double range2 = of_.median_range * of_.median_range;
        std::size_t up = 0;
        for (const double d2 : of_.squared) up += d2 <= range2 ? 1 : 0;
        return up;
    }

  private:
    const Links& of_;
};

class ByRange {
  public:
    explicit ByRange(const Links& of) : of_(of), range_(of.loss(), budget) {}
    std::size_t count() const {
        std::size_t up = 0;
        for (std::size_t i = 0; i < links; ++i) {
            const std::uint64_t bits = draws_.bits(of_.from_key, of_.keys[i]);
            up += range_.in_range(of_.squared[i], bits) ? 1 : 0;
        }
        return up;
    }

  private:
    const Links& of_;
    ShadowedRange range_;
    PairDraws draws_ = shadowing_draws(1, 0);
};

class ByLoss {
  public:
    explicit ByLoss(const Links& of) : of_(of), loss_(links) {}
    std::size_t count() {
        of_.model.loss({.frequency = frequency,
                        .from = of_.from,
                        .to = of_.to,
                        .from_key = of_.from_key,
                        .to_keys = of_.keys,
                        .seed = 1},
                       budget, loss_);
        std::size_t up = 0;
        for (const double loss : loss_) up += loss <= budget.value ? 1 : 0;
        return up;
    }

  private:
    const Links& of_;
    std::vector<double> loss_;  // [dB]
};

class ByPhilox {
  public:
    explicit ByPhilox(const Links& of) : of_(of) {}
    std::size_t count() const {
        const ShadowedLoss loss = of_.loss();
        std::size_t up = 0;
        for (std::size_t i = 0; i < links; ++i) {
            const auto [low, high] = std::minmax(of_.from_key, of_.keys[i]);
            const double x =
                normal({.seed = 1, .purpose = Purpose::link_shadowing, .a = low, .b = high});
            up += loss(distance(of_.from, of_.to[i]), x) <= budget.value ? 1 : 0;
        }
        return up;
    }

  private:
    const Links& of_;
};

template <class Way>
void decide(benchmark::State& state) {
    const Links of(networks[state.range(0)]);
    Way way(of);
    for (auto _ : state) {
        benchmark::DoNotOptimize(way.count());
        benchmark::ClobberMemory();
    }
}

constexpr auto columns = {"distance", "range", "loss", "philox"};
constexpr auto ratios = {"range", "loss", "philox"};

/// Share of the links that are up.
double share_up(const Links& of) {
    return static_cast<double>(ByRange(of).count()) / static_cast<double>(links);
}

/// Mean probability that ShadowedRange has to compute the loss.
double computed_share(const Links& of) {
    const ShadowedRange range(of.loss(), budget);
    double sum = 0;
    for (const double d2 : of.squared) sum += range.computed_share(d2);
    return sum / links;
}

void print(const bench::Least& least) {
    fmt::print("CPU ns per link{:46}times a check of the distance\n{:>9}{:>8}{:>8}{:>10}", "",
               "sigma", "radius", "up", "computed");
    bench::print_heads(columns, 10);
    bench::print_heads(ratios, 9);
    for (std::size_t i = 0; i < std::size(networks); ++i) {
        const Links of(networks[i]);
        const double radius = std::sqrt(*std::max_element(of.squared.begin(), of.squared.end()));
        fmt::print("\n{:>6} dB{:>8.1f}{:>6.0f} %{:>8.2f} %", networks[i].sigma,
                   radius / of.median_range, 100 * share_up(of), 100 * computed_share(of));
        for (const char* name : columns) fmt::print("{:>10.2f}", least.ns(name, i));
        for (const char* name : ratios) {
            fmt::print("{:>9.1f}", least.times(name, "distance", i));
        }
    }
    fmt::print("\n");
}

}  // namespace

int main(int argc, char** argv) {
    bench::Least least(links);
    for (std::size_t i = 0; i < std::size(networks); ++i) {  // what is compared runs in a row
        least.add("distance", decide<ByDistance>, i, rounds);
        least.add("range", decide<ByRange>, i, rounds);
        least.add("loss", decide<ByLoss>, i, rounds);
        least.add("philox", decide<ByPhilox>, i, rounds);
    }
    if (!least.run(argc, argv)) return 2;
    print(least);
}
