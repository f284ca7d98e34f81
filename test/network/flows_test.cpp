// SPDX-License-Identifier: MIT
// Saturated flows between stations that do not all hear each other, beside ns-2 and ns-3: the
// numbers of bench/peers/run flows, which has more of them.
#include "models/access/list.hpp"
#include "models/propagation/two_ray.hpp"
#include "models/reception/list.hpp"
#include "network/network.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace flows_test {
using namespace rovernet;

namespace {

using namespace std::chrono_literals;

struct Deliveries {
    std::uint64_t count = 0;
    KindMask kinds() const { return kind_of<Received>(); }
    void on(const Record& record, const RecordContext&) {
        for (const Reception& r : std::get<Received>(record).receptions) count += r.delivered;
    }
};

struct Line {
    std::vector<double> places;  ///< [m]
    std::vector<std::pair<std::uint32_t, std::uint32_t>> flows;
    double sense;  ///< [m]
    double rate = 1e6;

    /// Frames of 1000 bytes that get through in a second, of ns-2's radio over flat ground.
    double frames_per_second(ReceptionModel reception, const Csma& access) const {
        Network net(
            {.propagation = TwoRay{}, .reception = reception, .access = access, .metrics = false});
        Radio radio{.power = Dbm{24.49999779}, .sensitivity = Dbm{-64.37439}, .frequency = {914e6}};
        radio.carrier_sense_threshold = radio.sensitivity - Db{40 * std::log10(sense / 250)};
        radio.rate = {rate};
        radio.antenna_height = {1.5};
        for (const double x : places) net.add({.name = {}, .at = {x, 0}, .radio = radio});
        for (const auto& [from, to] : flows) {
            net.at(start_of_run,
                   [&net, a = NodeId{from}, b = NodeId{to}] { net.saturate(a, b, 1000); });
        }
        net.run_for(1s);
        const auto deliveries = std::make_shared<Deliveries>();
        net.add_sink(Sink{deliveries});
        net.run_for(10s);
        return static_cast<double>(deliveries->count) / 10;
    }
};

const Line near_and_far{{0, 100, 300}, {{0, 1}, {2, 1}}, 250};
const Line chain{{0, 200, 400, 600, 800}, {{0, 1}, {1, 2}, {2, 3}, {3, 4}}, 550};
const Line exposed{{0, 200, 400, 600}, {{1, 0}, {2, 3}}, 250, 11e6};

/// Their noise in 10 s, and what sets us apart from the peers: docs/agreement.md.
constexpr double share = 0.03;

}  // namespace

TEST_CASE("flows: a near sender and a far one that is hidden get what ns-2 and ns-3 give them") {
    const Csma as_ns2{.basic_rates = {{1e6}}, .header = 34};
    const double collision = near_and_far.frames_per_second(Collision{}, as_ns2);
    CHECK(collision == doctest::Approx(106.3).epsilon(share));  // ns-2
    const double sinr = near_and_far.frames_per_second(Sinr{}, as_ns2);
    CHECK(sinr == doctest::Approx(105.1).epsilon(share));  // ns-3
}

TEST_CASE("flows: a chain of five stations carries what ns-2 and ns-3 let it carry") {
    const Csma as_ns2{.basic_rates = {{1e6}}, .header = 34};
    CHECK(chain.frames_per_second(Collision{}, as_ns2) ==
          doctest::Approx(216.2).epsilon(share));  // ns-2
    CHECK(chain.frames_per_second(Sinr{}, as_ns2) ==
          doctest::Approx(207.6).epsilon(share));  // ns-3
}

TEST_CASE("flows: at 11 Mb/s answers at the basic rates of the standard give what ns-3 gives") {
    const Csma standard{.header = 36};
    CHECK(exposed.frames_per_second(Sinr{}, standard) == doctest::Approx(753.7).epsilon(0.01));
    const Csma slow{.basic_rates = {{1e6}}, .header = 34};
    CHECK(exposed.frames_per_second(Collision{}, slow) ==
          doctest::Approx(703.1).epsilon(0.01));  // ns-2
}

}  // namespace flows_test
