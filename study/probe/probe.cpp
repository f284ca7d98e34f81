// SPDX-License-Identifier: MIT
#include "study/probe/probe.hpp"

#include "experiment/build.hpp"
#include "experiment/replay/deliveries.hpp"
#include "network/network.hpp"
#include "scene/scene.hpp"
#include "study/calibration/known_links.hpp"
#include "study/probe/perturbation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>

namespace rovernet {
namespace {

constexpr double noticed = 0.01;        // [dB]
constexpr double links_of_a_run = 0.2;  // work of a perturbation's links, in that of its run

struct Way {
    const char* name;
    Vec3 unit;
};
constexpr std::array<Way, 4> ways{
    {{"east", {1, 0}}, {"north", {0, 1}}, {"west", {-1, 0}}, {"south", {0, -1}}}};

bool changes_more(const LinkEffect& a, const LinkEffect& b) {
    return std::tuple(a.flips(), std::abs(a.change())) >
           std::tuple(b.flips(), std::abs(b.change()));
}

bool comes_first(const LinkEffect& a, const LinkEffect& b) {
    const auto cliff = [](const LinkEffect& e) { return e.is_cliff() ? e.steepness() : 0; };
    if (cliff(a) != cliff(b)) return cliff(a) > cliff(b);
    return changes_more(a, b);
}

/// Links under one perturbation after the other.
class LinkProbe {
  public:
    explicit LinkProbe(const KnownLinks& known) : known_(known) {}

    void look(const Perturbation& perturbation, PerturbationEffect& row,
              std::vector<LinkEffect>& out);

  private:
    LinkEffect effect(const Perturbation& p, const KnownLink& link) const;
    LinkEffect effect_of_moving(const Perturbation& p, const KnownLink& link) const;
    LinkEffect unchanged(const Perturbation& p, const KnownLink& link) const {
        return {link.name, p.name,    link.distance(), link.budget,
                link.loss, link.loss, p.moved.value};
    }
    bool comes_into_wall(Vec3 from, Vec3 to) const {
        return known_.scene->occupied(to) && !known_.scene->occupied(from);
    }

    const KnownLinks& known_;
    KnownLinks seen_;                   // what radio sees now, without links
    std::optional<Propagation> model_;  // now
};

void LinkProbe::look(const Perturbation& p, PerturbationEffect& row, std::vector<LinkEffect>& out) {
    model_ = p.scenario.propagation.make();
    seen_.scene = p.scenario.walls ? p.scenario.walls : known_.scene;
    seen_.floor_height = known_.floor_height;
    seen_.seed = known_.seed;
    double squares = 0;
    for (const KnownLink& link : known_.links) {
        const LinkEffect e = p.moved.value > 0 ? effect_of_moving(p, link) : effect(p, link);
        squares += e.change() * e.change();
        row.changed += std::abs(e.change()) > noticed;
        row.flips += e.flips();
        if (std::abs(e.change()) > std::abs(row.worst)) row.worst = e.change();
        row.steepest = std::max(row.steepest, e.steepness());
        if (std::abs(e.change()) > noticed || e.flips() || e.is_cliff()) out.push_back(e);
    }
    row.rms = std::sqrt(squares / static_cast<double>(known_.links.size()));
}

LinkEffect LinkProbe::effect(const Perturbation& p, const KnownLink& link) const {
    LinkEffect out = unchanged(p, link);
    out.after = seen_.loss_by(*model_, link);
    return out;
}

LinkEffect LinkProbe::effect_of_moving(const Perturbation& p, const KnownLink& link) const {
    LinkEffect most = unchanged(p, link);
    for (const auto& [end, end_name] :
         {std::pair(&KnownLink::from, "sender"), std::pair(&KnownLink::to, "receiver")}) {
        for (const Way& way : ways) {
            KnownLink moved = link;
            moved.*end = link.*end + p.moved.value * way.unit;
            if (comes_into_wall(link.*end, moved.*end)) continue;
            LinkEffect each = unchanged(p, link);
            each.perturbation = fmt::format("{} {} of the {}", p.name, way.name, end_name);
            each.after = seen_.loss_by(*model_, moved);
            if (changes_more(each, most)) most = each;
        }
    }
    return most;
}

/// Deliveries of a run, and the time until which they are known.
struct Played {
    std::vector<Delivery> deliveries;  // in order of message and robot
    std::vector<std::string> names;    // of robots
    Time until;
};

/// Runs a scenario until `end`, or until it has served about so many events.
Played play(const Perturbation& p, Time end, std::uint64_t limit,
            const std::function<void(double)>& tell) {
    Network network(p.settings());
    populate(network, p.scenario);
    const auto got = std::make_shared<Deliveries>();
    network.add_sink(got);
    constexpr std::uint64_t events_a_slice = 256;
    while (!network.advance(end, events_a_slice)) {
        tell(seconds(network.now()) / seconds(end));
        if (network.events() < limit) continue;
        network.run_until(network.now());
        break;
    }
    Played out{.deliveries = std::move(got->all), .names = {}, .until = network.now()};
    std::sort(out.deliveries.begin(), out.deliveries.end());
    for (NodeId node{0}; node.index() < network.size(); ++node.value) {
        out.names.push_back(network.name(node));
    }
    return out;
}

/// Counts the deliveries that occur in only one of the runs, and stores some of them.
void compare_messages(const Played& given, const Played& perturbed, std::size_t most,
                      PerturbationEffect& row, std::vector<MessageEffect>& out) {
    std::vector<std::pair<Delivery, bool>> changes;
    const auto add = [&](const Played& has, const Played& lacks, bool gained) {
        std::vector<Delivery> only;
        std::set_difference(has.deliveries.begin(), has.deliveries.end(), lacks.deliveries.begin(),
                            lacks.deliveries.end(), std::back_inserter(only));
        for (const Delivery& each : only) changes.emplace_back(each, gained);
        return only.size();
    };
    row.lost = add(given, perturbed, false);
    row.gained = add(perturbed, given, true);
    std::stable_sort(changes.begin(), changes.end(),
                     [](const auto& a, const auto& b) { return a.first.sent < b.first.sent; });
    if (changes.size() > most) changes.resize(most);
    for (const auto& [each, gained] : changes) {
        out.push_back({given.names[each.origin.index()], given.names[each.at.index()], each.number,
                       each.sent, row.name, gained});
    }
}

/// Share of work that is done.
class WorkDone {
  public:
    WorkDone(double all, const std::function<void(double)>& tell) : all_(all), tell_(tell) {}

    void tell(double more) const {
        if (tell_) tell_(std::min(1.0, (done_ + more) / all_));
    }
    void done(double more) {
        done_ += more;
        tell(0);
    }

  private:
    double all_, done_ = 0;
    const std::function<void(double)>& tell_;
};

void probe_messages(const std::vector<Perturbation>& all, const Perturbation& as_given,
                    const ProbeSize& size, WorkDone& work, Probe& out) {
    const auto tell = [&](double share) { work.tell(share); };
    const Time end = start_of_run + as_given.scenario.scenario.duration;
    const Played given = play(as_given, end, size.events, tell);
    work.done(1);
    out.until = given.until;
    out.whole_run = given.until == end;
    out.deliveries = given.deliveries.size();
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (all[i].nothing.empty()) {
            constexpr std::uint64_t any = ~std::uint64_t{0};
            const Played perturbed = play(all[i], given.until, any, tell);
            compare_messages(given, perturbed, size.messages, out.perturbations[i], out.messages);
        }
        work.done(1);
    }
}

}  // namespace

double LinkEffect::steepness() const { return moved > 0 ? std::abs(change()) / (1e3 * moved) : 0; }

Probe probe(const Scenario& scenario, const ProbeSize& size,
            const std::function<void(double)>& tell) {
    const Propagation model = scenario.propagation.make();
    const KnownLinks known = sample_links(
        scenario, model,
        {.replications = 1,
         .times = size.times,
         .links = size.links,
         .first_replication = static_cast<std::uint32_t>(scenario.scenario.replication)});
    const std::vector<Perturbation> all = perturbations(scenario);
    const auto n = static_cast<double>(all.size());
    WorkDone work(n * links_of_a_run + (size.events > 0 ? n + 1 : 0), tell);
    Probe out;
    out.model = model.name();
    out.links = known.links.size();
    LinkProbe links(known);
    for (const Perturbation& each : all) {
        PerturbationEffect row{.name = each.name, .nothing = each.nothing};
        if (each.nothing.empty()) links.look(each, row, out.effects);
        out.perturbations.push_back(std::move(row));
        work.done(links_of_a_run);
    }
    std::stable_sort(out.effects.begin(), out.effects.end(), comes_first);
    const Perturbation as_given{.name = "as given", .scenario = scenario, .nothing = {}};
    if (size.events > 0) probe_messages(all, as_given, size, work, out);
    return out;
}

}  // namespace rovernet
