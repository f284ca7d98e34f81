// SPDX-License-Identifier: MIT
// A hundred robots in an office, rays through its walls: prints what the rays come to, and the real
// time factor.
//   walls [CPU_SECONDS]          2 s if not given
//   walls --simulate SECONDS     nothing but that, after one second: to count its instructions

#include "bench/office.hpp"
#include "mobility/random_waypoint.hpp"
#include "models/propagation/rays.hpp"
#include "models/propagation/raytrace_2007.hpp"
#include "network/network.hpp"
#include "routing/flood.hpp"
#include "sim/random.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>
#include <string_view>
#include <time.h>
#include <vector>

using namespace rovernet;
using bench::Office;
using namespace std::chrono_literals;

namespace {

constexpr int robots = 100;
constexpr Duration between_broadcasts = 100ms;  // of one robot
constexpr std::uint32_t payload = 64;           // [bytes]
constexpr Meters body{0.2};

double cpu_seconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) / 1e9;
}

/// What became of the rays.
struct Rays {
    std::uint64_t all = 0;
    std::uint64_t up = 0;        // within the budget
    std::uint64_t too_far = 0;   // no wall was looked for
    std::uint64_t given_up = 0;  // before the last of their walls
};

/// The model as it is, with each ray traced to its end besides, to see where it was given up.
struct CountedRays {
    static constexpr std::string_view name = "counted_rays";

    Raytrace2007 model = {};
    std::shared_ptr<Rays> rays = std::make_shared<Rays>();

    LossShape shape() const { return model.shape(); }
    Meters reach(Db loss, Hertz f) const { return model.reach(loss, f); }
    void loss(const LinkBatch& links, Db cutoff, std::span<double> out_db) const {
        model.loss(links, cutoff, out_db);
        std::vector<double> whole(out_db.size()), without_walls(out_db.size());
        model.loss(links, Db{std::numeric_limits<double>::infinity()}, whole);
        Raytrace2007{.coefficient = model.coefficient, .wall_factor = 0}.loss(links, cutoff,
                                                                              without_walls);
        for (std::size_t i = 0; i < out_db.size(); ++i) {
            ++rays->all;
            rays->up += out_db[i] <= cutoff.value;
            if (without_walls[i] > cutoff.value) {
                ++rays->too_far;
            } else {
                rays->given_up += out_db[i] < whole[i];
            }
        }
    }
};

/// A way that was found before: to its end, back, and so on.
struct Known {
    struct Corner {
        Vec3 at;
        MetersPerSecond speed;  ///< with which it is approached first
    };
    std::shared_ptr<const std::vector<Corner>> way;
    std::size_t next = 0;
    bool back = false;

    Step next_leg(Mover& mover) {
        while (next < way->size() && (*way)[next].at == mover.position) advance();
        if (next >= way->size()) return AtRest{};
        const Corner& corner = (*way)[next];
        advance();
        return straight_leg(mover, corner.at, corner.speed);
    }

  private:
    void advance() {
        if (next == 0) back = false;
        if (next + 1 == way->size()) back = true;
        next += back ? std::size_t{0} - 1 : 1;
    }
};

/// Random waypoint: each way is planned around the walls when it begins.
Movement finding_ways() { return RandomWaypoint{.start = StartState::here}; }

/// The robots, under way everywhere in the office, one broadcast a millisecond among them.
class Crowd {
  public:
    explicit Crowd(const Propagation& propagation, const std::vector<Movement>& ways = {})
        : net_({.propagation = propagation,
                .scene = std::make_shared<const Scene>(Office{}.grid()),
                .event_limit = std::numeric_limits<std::uint64_t>::max(),
                .metrics = false}) {
        for (std::uint64_t i = 0; i < robots; ++i) {
            const NodeId node = net_.add({.name = "",
                                          .at = free_place(i),
                                          .radius = body,
                                          .move = ways.empty() ? finding_ways() : ways[i]});
            net_.at(start_of_run + i * between_broadcasts / robots, [this, node] { say(node); });
        }
        net_.route(Flood{.ttl = 1});
    }
    Network& net() { return net_; }

  private:
    void say(NodeId node) {
        net_.send(node, everyone, "", {.size = payload});
        net_.at(net_.now() + between_broadcasts, [this, node] { say(node); });
    }
    Vec3 free_place(std::uint64_t robot) const {
        for (std::uint64_t i = 0;; i += 2) {
            const auto draw = [&](std::uint64_t index) {
                return uniform({.purpose = Purpose::placement, .a = robot, .index = index});
            };
            const Vec3 p{Office::width * draw(i), Office::depth * draw(i + 1)};
            if (net_.scene().clearance(p) >= body.value) return p;
        }
    }

    Network net_;
};

/// Where the robots go in half a minute.
std::vector<Movement> known_ways() {
    struct Ways {
        std::vector<std::vector<Known::Corner>> corners =
            std::vector<std::vector<Known::Corner>>(robots);
        KindMask kinds() const { return kind_of<Moved>(); }
        void on(const Record& record, const RecordContext&) {
            const auto& [time, node, leg] = std::get<Moved>(record);
            const MetersPerSecond speed{std::sqrt(dot(leg.velocity, leg.velocity))};
            if (speed.value == 0) return;
            corners[node.index()].push_back({leg.to, speed});
        }
    };
    const auto ways = std::make_shared<Ways>();
    Crowd crowd(Raytrace2007{});
    crowd.net().add_sink(Sink{ways});
    crowd.net().run_for(30s);
    std::vector<Movement> movements;
    for (auto& corners : ways->corners) {
        movements.emplace_back(
            Known{std::make_shared<const std::vector<Known::Corner>>(std::move(corners))});
    }
    return movements;
}

double percent(std::uint64_t part, std::uint64_t whole) {
    return 100 * static_cast<double>(part) / static_cast<double>(whole);
}

/// Rays per simulated second.
double count_rays() {
    constexpr int length = 5;  // [s]
    const CountedRays model;
    Crowd crowd(model);
    crowd.net().run_for(std::chrono::seconds{length});
    const Rays& rays = *model.rays;
    fmt::print("rays per simulated second {:>14}\n", rays.all / length);
    fmt::print("lost without their walls  {:>14.1f} %\n", percent(rays.too_far, rays.all));
    fmt::print("given up early            {:>14.1f} %\n", percent(rays.given_up, rays.all));
    fmt::print("links up                  {:>14.1f} %\n", percent(rays.up, rays.all));
    std::fflush(stdout);
    return static_cast<double>(rays.all) / length;
}

/// Simulated seconds per CPU second: the median of five parts of the time.
double real_time_factor(double cpu, const std::vector<Movement>& ways) {
    Crowd crowd(Raytrace2007{}, ways);
    crowd.net().run_for(1s);  // warm
    std::array<double, 5> factors{};
    for (double& factor : factors) {
        int simulated = 0;
        const double begin = cpu_seconds();
        while (cpu_seconds() - begin < cpu / static_cast<double>(factors.size())) {
            crowd.net().run_for(1s);
            ++simulated;
        }
        factor = simulated / (cpu_seconds() - begin);
    }
    std::sort(factors.begin(), factors.end());
    return factors[factors.size() / 2];
}

}  // namespace

int main(int argc, char** argv) {
    if (argc == 3 && argv[1] == std::string_view{"--simulate"}) {
        Crowd crowd(Raytrace2007{});
        crowd.net().run_for(1s);  // warm
        crowd.net().run_for(std::chrono::seconds{std::atoi(argv[2])});
        return 0;
    }
    const double cpu = argc > 1 ? std::atof(argv[1]) : 2;
    const double rays = count_rays();
    fmt::print("real time factor          {:>14.1f}\n", real_time_factor(cpu, {}));
    const double factor = real_time_factor(cpu, known_ways());
    fmt::print("  with ways found before  {:>14.1f}\n", factor);
    fmt::print("  then CPU per ray, all told {:>11.0f} ns\n", 1e9 / (factor * rays));
}
