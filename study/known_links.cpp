// SPDX-License-Identifier: MIT
#include "study/known_links.hpp"

#include "experiment/build.hpp"
#include "experiment/run.hpp"
#include "models/link_gain.hpp"
#include "models/medium/medium.hpp"
#include "network/network.hpp"
#include "sim/random.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <utility>

namespace rovernet {
namespace {

constexpr Db beyond_budget{20};  // how much farther links are looked for

/// Pair of robots at one of the sampled times.
struct RobotPair {
    std::uint32_t replication;
    Time at;
    NodeId a, b;
    Vec3 from, to;
    friend bool operator==(const RobotPair&, const RobotPair&) = default;
};

/// Every k-th of many, with k the least power of two that leaves few enough.
class Thinned {
  public:
    explicit Thinned(std::size_t most) : most_(most) {}

    void add(const RobotPair& pair) {
        if (seen_++ % stride_ != 0) return;
        kept_.push_back(pair);
        if (kept_.size() <= most_) return;
        std::size_t n = 0;
        for (std::size_t i = 0; i < kept_.size(); i += 2) kept_[n++] = kept_[i];
        kept_.resize(n);
        stride_ *= 2;
    }
    std::vector<RobotPair> take() { return std::move(kept_); }

  private:
    std::size_t most_, seen_ = 0, stride_ = 1;
    std::vector<RobotPair> kept_;
};

std::vector<Time> sample_times(const Scenario& scenario, std::uint32_t n) {
    std::vector<Time> times;
    const double duration = seconds(scenario.scenario.duration);
    for (std::uint32_t i = 0; i < n; ++i) {
        const double share =
            uniform({.seed = scenario.scenario.seed,
                     .replication = static_cast<std::uint32_t>(scenario.scenario.replication),
                     .purpose = Purpose::sample_time,
                     .index = i});
        times.push_back(start_of_run + from_seconds(share * duration));
    }
    std::sort(times.begin(), times.end());
    return times;
}

/// Adds the pairs of the robots that are on, as they are now.
void add_pairs(const Network& network, std::uint32_t replication, const Propagation& reference,
               Thinned& out) {
    const Medium& medium = network.medium();
    std::vector<std::pair<NodeId, Vec3>> on;
    for (std::uint32_t i = 0; i < network.size(); ++i) {
        if (network.robot(NodeId{i}).presence != Presence::on) continue;
        on.emplace_back(NodeId{i}, medium.antenna(NodeId{i}, network.now(), network.legs()));
    }
    for (std::size_t i = 0; i < on.size(); ++i) {
        const Radio& sender = medium.radio(on[i].first);
        for (std::size_t j = i + 1; j < on.size(); ++j) {
            const Db budget = link_budget(sender, medium.radio(on[j].first)) + beyond_budget;
            const Meters reach = reference.reach(budget, sender.frequency);
            if (distance(on[i].second, on[j].second) > reach.value) continue;
            out.add(
                {replication, network.now(), on[i].first, on[j].first, on[i].second, on[j].second});
        }
    }
}

/// Drops what is the same link again. Groups are senders if only one replication is left.
void group(KnownLinks& all) {
    std::set<std::array<double, 7>> seen;
    std::erase_if(all.links, [&](const KnownLink& l) {
        return !seen.insert({l.from.x, l.from.y, l.from.z, l.to.x, l.to.y, l.to.z, l.loss}).second;
    });
    std::set<std::uint64_t> groups;
    for (const KnownLink& l : all.links) groups.insert(l.group);
    if (groups.size() == 1) {
        groups.clear();
        std::map<std::uint64_t, std::uint32_t> senders;
        for (KnownLink& l : all.links) {
            l.group = senders.emplace(l.from_key, static_cast<std::uint32_t>(senders.size()))
                          .first->second;
            groups.insert(l.group);
        }
        all.group_name = "sender";
    }
    all.groups = groups.size();
}

}  // namespace

double KnownLinks::loss_by(const Propagation& model, const KnownLink& link) const {
    const std::uint64_t to_key = link.to_key;
    const LinkBatch batch{.frequency = link.frequency,
                          .from = link.from,
                          .to = {&link.to, 1},
                          .from_key = link.from_key,
                          .to_keys = {&to_key, 1},
                          .scene = scene.get(),
                          .floor_height = floor_height,
                          .seed = seed,
                          .replication = link.replication};
    double loss = 0;
    model.loss(batch, Db{std::numeric_limits<double>::infinity()}, {&loss, 1});
    return loss;
}

KnownLinks sample_links(const Scenario& scenario, const Propagation& reference,
                        const SampleSize& size, const std::function<void(double)>& tell) {
    Scenario played = without_idle_traffic(scenario);
    KnownLinks out;
    out.seed = scenario.scenario.seed;
    Thinned thinned(size.links);
    std::unique_ptr<Network> network;
    for (std::uint32_t r = 0; r < size.replications; ++r) {
        if (tell) tell(static_cast<double>(r) / size.replications);
        played.scenario.replication = size.first_replication + r;
        network = std::make_unique<Network>(network_settings(played));
        populate(*network, played);
        for (const Time at : sample_times(played, size.times)) {
            network->run_until(at);
            add_pairs(*network, r, reference, thinned);
        }
    }
    const std::vector<RobotPair> pairs = thinned.take();
    if (pairs.empty()) {
        throw InputError(
            {scenario.file, 0, 0},
            fmt::format("no two robots come within reach of {}; there are no links to look at",
                        reference.name()));
    }
    const auto& scene = network->settings().scene;
    out.scene = scene ? scene : std::make_shared<Scene>();
    out.floor_height = network->settings().floor_height;
    const Medium& medium = network->medium();
    for (const RobotPair& c : pairs) {
        const auto replication = size.first_replication + c.replication;
        KnownLink link{
            .name = fmt::format(
                "{} - {} at {:.6g} s{}", network->name(c.a), network->name(c.b), seconds(c.at),
                size.replications > 1 ? fmt::format(", replication {}", replication) : ""),
            .from = c.from,
            .to = c.to,
            .frequency = medium.radio(c.a).frequency,
            .from_key = medium.key(c.a),
            .to_key = medium.key(c.b),
            .replication = replication,
            .group = c.replication,
            .budget = link_budget(medium.radio(c.a), medium.radio(c.b)).value};
        link.loss = out.loss_by(reference, link);
        out.links.push_back(std::move(link));
    }
    group(out);
    return out;
}

}  // namespace rovernet
