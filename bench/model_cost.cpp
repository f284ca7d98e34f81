// SPDX-License-Identifier: MIT
// Cost of a propagation model: CPU time per link in the office of bench/walls [ns], nothing kept
// from one link to the next. Robots stand anywhere in the office; each in turn is the transmitter
// of a batch to all others.
//   model_cost [CPU_SECONDS]     a table of all models; 0.1 s each if not given
//   model_cost --names           the names of the table
//   model_cost --once MODEL      one pass over all links, for bench/model_instructions; prints
//   their number

#include "bench/office.hpp"
#include "models/medium/shadowed.hpp"
#include "models/propagation/list.hpp"
#include "models/propagation/propagation.hpp"
#include "sim/random.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <time.h>
#include <vector>

using namespace rovernet;

namespace {

constexpr std::uint64_t robots = 60;
constexpr double links = robots * (robots - 1);

double cpu_seconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) / 1e9;
}

struct NamedModel {
    std::string name;
    Propagation model;
};

/// The listed models with their defaults, and those of their forms that cost something else.
std::vector<NamedModel> all_models() {
    std::vector<NamedModel> out;
    for_each_model([&]<class Model>() {
        if constexpr (Model::name == "disc")
            out.push_back({std::string(Model::name), Propagation(Model{.range = Meters{15}})});
        else
            out.push_back({std::string(Model::name), Propagation(Model{})});
    });
    out.push_back({"two_ray_exact", TwoRay{.form = TwoRayForm::exact}});
    out.push_back({"rays_order_1", Rays{.order = 1, .diffraction = RayDiffraction::none}});
    out.push_back({"rays_order_2_utd", Rays{.order = 2, .diffraction = RayDiffraction::utd}});
    out.push_back(
        {"friis_in_field", Shadowed(Friis{}, Shadowing{.model = ShadowingModel::field}, 1, 0)});
    return out;
}

/// Robots at rest in the office, and what a model is told of them.
class Links {
  public:
    Links() : scene_(bench::Office{}.grid()) {
        for (std::uint64_t robot = 0; robot < robots; ++robot) {
            const auto draw = [&](std::uint64_t index) {
                return uniform({.purpose = Purpose::placement, .a = robot, .index = index});
            };
            places_.push_back({bench::Office::width * draw(0), bench::Office::depth * draw(1), 1});
            keys_.push_back(name_key(fmt::format("r{}", robot)));
        }
    }
    /// Losses of all links from each robot; returns their sum [dB].
    double pass(const Propagation& model) const {
        double sum = 0;
        std::vector<Vec3> to;
        std::vector<std::uint64_t> keys;
        std::array<double, robots - 1> losses{};
        for (std::size_t from = 0; from < places_.size(); ++from) {
            to = places_;
            keys = keys_;
            to.erase(to.begin() + static_cast<std::ptrdiff_t>(from));
            keys.erase(keys.begin() + static_cast<std::ptrdiff_t>(from));
            const LinkBatch batch{.frequency = Hertz{2450e6},
                                  .from = places_[from],
                                  .to = to,
                                  .from_key = keys_[from],
                                  .to_keys = keys,
                                  .scene = &scene_};
            model.loss(batch, Db{std::numeric_limits<double>::infinity()}, losses);
            for (const double loss : losses) sum += loss;
        }
        return sum;
    }

  private:
    Scene scene_;
    std::vector<Vec3> places_;
    std::vector<std::uint64_t> keys_;
};

/// What is counted: a pass after what is built at the first question.
[[gnu::noinline]] double counted_pass(const Links& office, const Propagation& model) {
    return office.pass(model);
}

/// CPU time per link [ns]: the least of five turns.
double ns_per_link(const Links& office, const Propagation& model, double cpu) {
    office.pass(model);  // what is built at the first question
    double least = std::numeric_limits<double>::infinity();
    for (int turn = 0; turn < 5; ++turn) {
        int passes = 0;
        const double begin = cpu_seconds();
        do {
            office.pass(model);
            ++passes;
        } while (cpu_seconds() - begin < cpu / 5);
        least = std::min(least, 1e9 * (cpu_seconds() - begin) / (passes * links));
    }
    return least;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc == 2 && argv[1] == std::string_view{"--names"}) {
        for (const NamedModel& each : all_models()) fmt::print("{}\n", each.name);
        return 0;
    }
    const Links office;
    if (argc == 3 && argv[1] == std::string_view{"--once"}) {
        for (const NamedModel& each : all_models()) {
            if (each.name != argv[2]) continue;
            const double built = office.pass(each.model);
            const bool same = counted_pass(office, each.model) == built;
            fmt::print("{:.0f}\n", links);
            return same ? 0 : 1;
        }
        fmt::print(stderr, "model_cost: there is no propagation model {}\n", argv[2]);
        return 2;
    }
    const double cpu = argc > 1 ? std::atof(argv[1]) : 0.1;
    fmt::print("{:<20}{:>12}\n", "model", "ns/link");
    for (const NamedModel& each : all_models()) {
        fmt::print("{:<20}{:>12.0f}\n", each.name, ns_per_link(office, each.model, cpu));
        std::fflush(stdout);
    }
}
