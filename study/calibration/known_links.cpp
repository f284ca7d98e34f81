// SPDX-License-Identifier: MIT
#include "study/calibration/known_links.hpp"

#include "experiment/build.hpp"
#include "experiment/reports/network_at.hpp"
#include "experiment/run.hpp"
#include "models/link_gain.hpp"
#include "models/medium/medium.hpp"
#include "network/network.hpp"
#include "scenario/document/located.hpp"
#include "sim/random.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string_view>
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
    const std::vector<RobotPair>& kept() const { return kept_; }

  private:
    std::size_t most_, seen_ = 0, stride_ = 1;
    std::vector<RobotPair> kept_;
};

/// Scenario whose runs are sampled. Radio affects only robots' paths here, so that `rays`, which
/// costs a thousand times more than counting walls, is replaced.
Scenario played(const Scenario& scenario) {
    Scenario out = without_idle_traffic(scenario);
    const auto make_cheap = [](PropagationTable& propagation) {
        if (propagation.as<Rays>()) propagation.model = PropagationTable::place_of<MultiWall>();
    };
    make_cheap(out.propagation);
    for (RobotTable& robot : out.robots)
        if (robot.propagation) make_cheap(*robot.propagation);
    return out;
}

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
        on.emplace_back(NodeId{i},
                        medium.stations().antenna(NodeId{i}, network.now(), network.legs()));
    }
    for (std::size_t i = 0; i < on.size(); ++i) {
        const Radio& sender = medium.stations().radio(on[i].first);
        for (std::size_t j = i + 1; j < on.size(); ++j) {
            const Db budget =
                link_budget(sender, medium.stations().radio(on[j].first)) + beyond_budget;
            const Meters reach = reference.reach(budget, sender.frequency);
            if (distance(on[i].second, on[j].second) > reach.value) continue;
            out.add(
                {replication, network.now(), on[i].first, on[j].first, on[i].second, on[j].second});
        }
    }
}

/// Cache of losses: the model is evaluated once for equal links.
class AskedLosses {
  public:
    double of(const KnownLinks& all, const Propagation& model, const KnownLink& link) {
        const bool random = model.is_random();
        const Key key{
            {link.from.x, link.from.y, link.from.z, link.to.x, link.to.y, link.to.z,
             link.frequency.value},
            {random ? link.from_key : 0, random ? link.to_key : 0, random ? link.replication : 0}};
        const auto [at, is_new] = losses_.try_emplace(key, 0.0);
        if (is_new) at->second = all.loss_by(model, link);
        return at->second;
    }

  private:
    using Key = std::pair<std::array<double, 7>, std::array<std::uint64_t, 3>>;
    std::map<Key, double> losses_;
};

/// Removes duplicate links. Groups become senders if only one replication is left.
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
    const LinkBatch batch{.frequency = link.frequency,
                          .from = link.from,
                          .from_key = link.from_key,
                          .scene = scene.get(),
                          .floor_height = floor_height,
                          .seed = seed,
                          .replication = link.replication};
    return model.loss_to(link.to, batch, link.to_key);
}

struct LinkSample::State {
    Scenario played;
    Propagation reference;
    SampleSize size;  // with the replications that were run
    Thinned pairs{size.links};
    AskedLosses losses;
    std::unique_ptr<Network> network;  // of the last replication

    void run(std::uint32_t replication);
    KnownLink link(const RobotPair& pair) const;
};

void LinkSample::State::run(std::uint32_t replication) {
    played.scenario.replication = size.first_replication + replication;
    network = std::make_unique<Network>(network_settings(played));
    populate(*network, played);
    located(played.propagation_where, [&] { reference.check_scene(network->scene()); });
    for (const Time at : sample_times(played, size.times)) {
        network->run_until(at);
        add_pairs(*network, replication, reference, pairs);
    }
}

/// Link of a pair, without its loss.
KnownLink LinkSample::State::link(const RobotPair& pair) const {
    const Medium& medium = network->medium();
    const auto replication = size.first_replication + pair.replication;
    return {
        .name = fmt::format(
            "{} - {} at {:.6g} s{}", network->name(pair.a), network->name(pair.b), seconds(pair.at),
            size.replications > 1 ? fmt::format(", replication {}", replication) : ""),
        .from = pair.from,
        .to = pair.to,
        .frequency = medium.stations().radio(pair.a).frequency,
        .from_key = medium.stations().key(pair.a),
        .to_key = medium.stations().key(pair.b),
        .replication = replication,
        .group = pair.replication,
        .budget =
            link_budget(medium.stations().radio(pair.a), medium.stations().radio(pair.b)).value};
}

LinkSample::LinkSample(const Scenario& scenario, Propagation reference, const SampleSize& size)
    : state_(new State{.played = played(scenario),
                       .reference = std::move(reference),
                       .size = size,
                       .losses = {},
                       .network = {}}) {
    state_->size.replications = 0;
    refuse_doors(scenario.scene, "a sample of links (for fit, probe or advise)");
}

LinkSample::~LinkSample() = default;

KnownLinks LinkSample::grow(std::uint32_t replications, const std::function<void(double)>& tell) {
    State& s = *state_;
    for (std::uint32_t& r = s.size.replications; r < replications; ++r) {
        if (tell) tell(static_cast<double>(r) / replications);
        s.run(r);
    }
    const std::vector<RobotPair>& pairs = s.pairs.kept();
    if (pairs.empty()) {
        throw InputError({s.played.file, 0, 0},
                         fmt::format("according to the propagation model {}, no two robots come "
                                     "within range of each other, so there are no links to examine",
                                     s.reference.name()));
    }
    KnownLinks out;
    out.seed = s.played.scenario.seed;
    const auto& scene = s.network->settings().scene;
    out.scene = scene ? scene : std::make_shared<Scene>();
    out.floor_height = s.network->settings().floor_height;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        if (tell) tell(static_cast<double>(i) / static_cast<double>(pairs.size()));
        KnownLink link = s.link(pairs[i]);
        link.loss = s.losses.of(out, s.reference, link);
        out.links.push_back(std::move(link));
    }
    group(out);
    return out;
}

KnownLinks sample_links(const Scenario& scenario, const Propagation& reference,
                        const SampleSize& size, const std::function<void(double)>& tell) {
    return LinkSample(scenario, reference, size).grow(size.replications, tell);
}

}  // namespace rovernet
