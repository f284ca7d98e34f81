// SPDX-License-Identifier: MIT
#include "study/calibration/locate.hpp"

#include "experiment/session.hpp"
#include "models/link_gain.hpp"
#include "models/medium/medium.hpp"
#include "scenario/unlikely.hpp"
#include "study/calibration/known_links.hpp"
#include "study/calibration/locator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace rovernet {
namespace {

/// Standard deviation of a level's error, by the question or the scenario.
Db sigma_of(const Scenario& scenario, const LocateQuestion& question) {
    if (question.sigma) return *question.sigma;
    if (scenario.shadowing.model != ShadowingModel::none && scenario.shadowing.sigma > Db{0})
        return scenario.shadowing.sigma;
    const Propagation model = scenario.propagation.make();
    const LogDistance* shadowed = model.as<LogDistance>();
    if (shadowed && shadowed->sigma > Db{0}) return shadowed->sigma;
    throw InputError(
        scenario.propagation_where.source.empty() ? Location{scenario.file}
                                                  : scenario.propagation_where,
        "the scenario has no shadowing, so the error of the levels is unknown; expected --sigma, "
        "the standard deviation of the levels, such as --sigma \"4 dB\"");
}

/// Box of all places: that of the map, or that of the anchors.
std::pair<Vec3, Vec3> area_of(const Scene& scene, const std::vector<Vec3>& anchors, Meters margin) {
    Vec3 low = anchors.front(), high = low;
    const auto take = [&](Vec3 p) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    };
    for (const Vec3 anchor : anchors) take(anchor);
    if (scene.open_field()) {
        const Vec3 around{margin.value, margin.value};
        return {low - around, high + around};
    }
    take(scene.lower_left());
    take(scene.upper_right());
    return {low, high};
}

/// Levels received at one place.
struct HeardPlace {
    Fix fix;
    Vec3 antenna;  // at the true place, if that is known
    std::vector<AnchorLoss> losses = {};
    std::shared_ptr<const Scene> scene = nullptr;  // with the doors as they were
};

Located locate(std::vector<HeardPlace> places, LocatorSettings settings, Db sigma) {
    Located out{.sigma = sigma};
    std::optional<Locator> locator;
    for (HeardPlace& place : places) {
        if (place.losses.size() < fewest_anchors) {
            ++out.too_few;
            continue;
        }
        if (!locator || settings.scene != place.scene) {
            settings.scene = place.scene;
            locator.emplace(settings);
        }
        std::vector<Vec3> anchors;
        for (const AnchorLoss& each : place.losses) anchors.push_back(each.anchor);
        Fix fix = std::move(place.fix);
        fix.anchors = anchors.size();
        const Vec3 found = locator->locate(place.losses, place.antenna.z);
        fix.found = found;
        fix.bound = locator->bound(anchors, fix.truth ? place.antenna : found, sigma);
        out.fixes.push_back(std::move(fix));
    }
    return out;
}

/// Robots whose places are known.
std::vector<NodeId> anchors_in(const Network& network, const std::vector<std::string>& names) {
    std::vector<NodeId> out;
    for (const std::string& name : names) {
        const Location typed{"--anchors " + name, 0, 0, true};
        const auto robot = network.find(name);
        if (!robot)
            throw InputError(typed, fmt::format("there is no robot \"{}\" in the scenario", name));
        const Medium& medium = network.medium();
        if (medium.stations().radio(*robot).is_directional())
            throw InputError(
                typed, "this anchor has a directional antenna; expected an isotropic antenna");
        if (!out.empty() &&
            (medium.stations().model(*robot) != medium.stations().model(out.front()) ||
             medium.stations().radio(*robot).frequency !=
                 medium.stations().radio(out.front()).frequency))
            throw InputError(typed,
                             "this anchor has a different propagation model or frequency than the "
                             "first anchor; expected the same model and frequency for all anchors");
        out.push_back(*robot);
    }
    return out;
}

/// Levels that a robot receives from the anchors now.
HeardPlace heard_by(const Network& network, const std::vector<NodeId>& anchors, NodeId robot) {
    const Medium& medium = network.medium();
    const auto antenna = [&](NodeId of) {
        return medium.stations().antenna(of, network.now(), network.legs());
    };
    HeardPlace out{
        .fix = {.name = network.name(robot), .at = network.now(), .truth = network.position(robot)},
        .antenna = antenna(robot)};
    for (const Neighbour& each : network.links(robot, network.now())) {
        if (std::find(anchors.begin(), anchors.end(), each.node) == anchors.end()) continue;
        const Dbm unlost = received_power(medium.stations().radio(each.node),
                                          medium.stations().radio(robot), Db{0});
        out.losses.push_back({antenna(each.node), (unlost - each.level).value});
    }
    return out;
}

}  // namespace

std::optional<double> Fix::error() const {
    if (!truth) return std::nullopt;
    return std::hypot(found.x - truth->x, found.y - truth->y);
}

std::optional<Located::Errors> Located::errors() const {
    Errors out{};
    for (const Fix& fix : fixes) {
        const auto error = fix.error();
        if (!error || !fix.bound) continue;
        ++out.fixes;
        out.rms += *error * *error;
        out.bound += fix.bound->value * fix.bound->value;
    }
    if (out.fixes == 0) return std::nullopt;
    out.rms = std::sqrt(out.rms / static_cast<double>(out.fixes));
    out.bound = std::sqrt(out.bound / static_cast<double>(out.fixes));
    return out;
}

Located locate_robots(const Scenario& scenario, const std::vector<std::string>& anchors,
                      const std::vector<Time>& times, const LocateQuestion& question) {
    refuse_disc(scenario.propagation.make(), scenario.propagation_where, "locate");
    Session session(scenario);
    Network& network = session.network();
    const std::vector<NodeId> known = anchors_in(network, anchors);
    const Db sigma = sigma_of(scenario, question);
    std::vector<HeardPlace> places;
    std::vector<Vec3> seen;  // places of anchors
    const NetworkSettings& settings = network.settings();
    const auto open =
        settings.scene ? settings.scene : std::shared_ptr<const Scene>(std::make_shared<Scene>());
    for (const Time at : times) {
        session.step(at);
        const SceneChange* change = last_change(settings.scene_changes, at);
        for (const NodeId anchor : known) seen.push_back(network.position(anchor));
        for (std::uint32_t i = 0; i < network.size(); ++i) {
            const NodeId robot{i};
            if (std::find(known.begin(), known.end(), robot) != known.end()) continue;
            if (network.robot(robot).presence != Presence::on) continue;
            places.push_back(heard_by(network, known, robot));
            places.back().scene = change ? change->scene : open;
        }
    }
    const auto [low, high] = area_of(network.scene(), seen, question.margin);
    const NodeId first = known.front();
    return locate(std::move(places),
                  {.model = scenario.propagation.make(),
                   .floor_height = settings.floor_height,
                   .frequency = network.medium().stations().radio(first).frequency,
                   .low = low,
                   .high = high,
                   .knows_power = question.knows_power},
                  sigma);
}

Located locate_levels(const std::string& path, const Scenario& scenario,
                      const LocateQuestion& question) {
    const Db sigma = sigma_of(scenario, question);
    const KnownLinks known = read_levels(path, scenario, std::nullopt, Receivers::may_be_unknown);
    std::vector<HeardPlace> places;
    std::map<std::string, std::size_t> numbers;  // by the name of the place
    std::vector<Vec3> anchors;
    for (const KnownLink& link : known.links) {
        const std::string name =
            known.knows_receivers ? fmt::format("{:g}, {:g}", link.to.x, link.to.y) : link.place;
        const auto [at, is_new] = numbers.emplace(name, places.size());
        if (is_new) {
            places.push_back({.fix = {.name = name}, .antenna = link.to});
            if (known.knows_receivers) places.back().fix.truth = link.to;
        }
        places[at->second].scene = known.scene;
        places[at->second].losses.push_back({link.from, link.loss});
        anchors.push_back(link.from);
    }
    const auto [low, high] = area_of(*known.scene, anchors, question.margin);
    return locate(std::move(places),
                  {.model = scenario.propagation.make(),
                   .floor_height = known.floor_height,
                   .frequency = scenario.radio.frequency,
                   .low = low,
                   .high = high,
                   .knows_power = question.knows_power},
                  sigma);
}

}  // namespace rovernet
