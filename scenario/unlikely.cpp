// SPDX-License-Identifier: MIT
#include "scenario/unlikely.hpp"

#include "models/propagation/disc.hpp"
#include "scenario/affected.hpp"
#include "scenario/document/quantity.hpp"
#include "scenario/equal_starts.hpp"
#include "scene/scene.hpp"
#include "sim/geometry.hpp"
#include "sim/math.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace rovernet {

bool is_for_protocol(const Scenario& scenario, const TrafficTable& flow) {
    const bool is_late = flow.start && *flow.start > scenario.scenario.duration;
    return !flow.hops && !flow.saturate && !is_late;
}

namespace {

std::string shown(Hertz f) { return quantity_text(f.value, Dimension::frequency); }
std::string shown(BitRate rate) { return quantity_text(rate.value, Dimension::bit_rate); }

/// Refuses sensitivities above 0 dBm: such a receiver hears nobody farther than a hand's breadth
/// away.
void check_sensitivity(const Radio& radio, const RadioPlaces& places) {
    const double dbm = radio.sensitivity.value;
    if (dbm <= 0) return;
    throw InputError(places.sensitivity,
                     fmt::format("sensitivity: found {0} dBm, with which a robot receives nothing; "
                                 "expected at most 0 dBm; did you mean \"-{0} dBm\"?",
                                 dbm));
}

/// Notices a power that looks like dBm, but was given as a bare number, which is in watts.
void note_power(Scenario& out, const Radio& radio, const RadioPlaces& places) {
    constexpr double usual = 37;       // [dBm] robots' radios send with less
    constexpr double unmistaken = 50;  // [W] nobody means as many dBm
    if (radio.power.value <= usual) return;
    const double watts = math::exp10(radio.power.value / 10 - 3);
    if (watts > unmistaken) return;
    add_notice(out.notices,
               fmt::format("{}: power: {:.4g} W are {:.4g} dBm, more than robots' radios "
                           "send with; did you mean \"{:.4g} dBm\"?",
                           places.power.text(), watts, radio.power.value, watts));
}

void note_frequency(Scenario& out, const Radio& radio, const RadioPlaces& places) {
    const std::string doubt = unlikely_frequency(radio.frequency);
    if (!doubt.empty()) add_notice(out.notices, places.frequency.text() + ": " + doubt);
}

void note_rate(Scenario& out, std::string_view key, BitRate rate, const Location& where) {
    const Csma* csma = out.access.as<Csma>();
    if (!csma) return;
    const auto rates = rates_of(csma->standard);
    if (std::find(rates.begin(), rates.end(), rate) != rates.end()) return;
    add_notice(
        out.notices,
        fmt::format("{}: {}: standard {} has no rate of {}; the rates of this standard are {} Mb/s",
                    where.text(), key, name_of(csma->standard), shown(rate), megabits_text(rates)));
}

/// Notices switching that changes nothing: a robot starts switched on.
void note_switching(Scenario& out, const RobotTable& robot) {
    std::vector<std::pair<Duration, bool>> switches;  // false, off, comes first at one time
    for (const Duration t : robot.off) switches.emplace_back(t, false);
    for (const Duration t : robot.on) switches.emplace_back(t, true);
    std::sort(switches.begin(), switches.end());
    bool is_on = true;
    for (const auto& [t, on] : switches) {
        if (on == is_on) {
            add_notice(out.notices,
                       fmt::format(
                           "{}: {}: robot \"{}\" is already {} at {} s, so this time has no effect",
                           (on ? robot.on_where : robot.off_where).text(), on ? "on" : "off",
                           robot.name, on ? "on" : "off", seconds(t)));
        }
        is_on = on;
    }
}

std::string shown(Vec3 p) { return fmt::format("({:.6g}, {:.6g}) m", p.x, p.y); }

/// The nearest place of the box around the map.
Vec3 on_map(const Scene& scene, Vec3 p) {
    const Vec3 low = scene.lower_left(), high = scene.upper_right();
    return {std::clamp(p.x, low.x, high.x), std::clamp(p.y, low.y, high.y), p.z};
}

/// Every place where the robot may start, as far as the file says it.
void for_each_start(const RobotTable& robot, const auto& visit) {
    if (robot.at) visit(*robot.at, robot.at_where);
    if (!robot.place) return;
    for (const auto* places : {&robot.place->area, &robot.place->points}) {
        for (const Vec3 p : *places) visit(p, robot.place->where);
    }
}

/// Notices payloads that read as a size: they were meant as the size of the message.
void note_payloads(Scenario& out) {
    Affected sizes;
    for (const TrafficTable& traffic : out.traffic) {
        const std::string& words = traffic.payload;
        const bool number = !words.empty() && words[0] >= '0' && words[0] <= '9';
        if (traffic.size || !number || shared_dimension({words}) != Dimension::size) continue;
        sizes.add([&] {
            return fmt::format(
                "{0}: payload: \"{1}\" is a text of {2} bytes on air; did you mean "
                "size = \"{1}\"?",
                traffic.payload_where.text(), words, words.size());
        });
    }
    sizes.note(out.notices);
}

/// Notices times after the end of the run: what they announce never happens.
void note_late(Scenario& out) {
    const auto varies_duration = [](const Vary& v) { return v.path == "scenario.duration"; };
    if (std::ranges::any_of(out.study.vary, varies_duration)) return;
    const Duration end = out.scenario.duration;
    Affected late;
    const auto look = [&](Duration time, const Location& where, std::string_view key,
                          std::string_view robot) {
        if (time <= end) return;
        late.add([&] {
            return fmt::format(
                "{}: {}: {:.9g} s is after the end of the run ({:.9g} s), so this time of robot "
                "\"{}\" "
                "has no effect",
                where.text(), key, seconds(time), seconds(end), robot);
        });
    };
    for (const TrafficTable& flow : out.traffic) {
        if (flow.start) look(*flow.start, flow.start_where, "start", flow.from);
    }
    for (const RobotTable& robot : out.robots) {
        for (const Duration t : robot.off) look(t, robot.off_where, "off", robot.name);
        for (const Duration t : robot.on) look(t, robot.on_where, "on", robot.name);
        for (const ReactionTable& reaction : robot.reactions) {
            if (reaction.trigger == Trigger::on_time)
                look(reaction.time, reaction.where, "on_time", robot.name);
        }
    }
    late.note(out.notices);
}

/// Notices unicasts that go over one hop because the routing protocol does not route them, and that
/// do not say so.
void note_unicasts(Scenario& out) {
    if (out.routing.make().traits().routes_unicasts) return;
    Affected unicasts;
    const auto note = [&](const Location& where, std::string_view to, std::string_view advice) {
        unicasts.add([&] {
            return fmt::format(
                "{}: to: the routing protocol does not route messages to a single robot, so "
                "messages to \"{}\" go over one hop only{}",
                where.text(), to, advice);
        });
    };
    for (const TrafficTable& traffic : out.traffic) {
        if (!traffic.to || !is_for_protocol(out, traffic)) continue;
        note(traffic.to_where, *traffic.to,
             traffic.is_of_file
                 ? "; write [routing] protocol = \"aodv\" to find routes"
                 : "; write hops = 1 to confirm this, or [routing] protocol = \"aodv\" to "
                   "find routes");
    }
    for (const RobotTable& robot : out.robots) {
        for (const ReactionTable& reaction : robot.reactions) {
            if (reaction.to && *reaction.to != robot.name)
                note(reaction.to_where, *reaction.to, "");
        }
    }
    unicasts.note(out.notices);
}

/// Notices broadcasts that go over one hop because the routing protocol forwards only unicasts, and
/// that do not say so.
void note_unforwarded(Scenario& out) {
    if (!out.routing.make().traits().routes_unicasts) return;
    Affected broadcasts;
    const auto note = [&](const Location& where, std::string_view key, std::string_view from,
                          std::string_view advice) {
        broadcasts.add([&] {
            return fmt::format(
                "{}: {}: the routing protocol does not forward broadcasts, so broadcasts of \"{}\" "
                "go over one hop only{}",
                where.text(), key, from, advice);
        });
    };
    for (const TrafficTable& traffic : out.traffic) {
        if (traffic.to || !is_for_protocol(out, traffic)) continue;
        note(traffic.from_where, "from", traffic.from,
             "; write hops = 1 to confirm this, or [routing] protocol = \"flood\" to forward "
             "broadcasts");
    }
    for (const RobotTable& robot : out.robots) {
        for (const ReactionTable& reaction : robot.reactions) {
            if (reaction.send && !reaction.to) note(reaction.where, "send", robot.name, "");
        }
    }
    broadcasts.note(out.notices);
}

/// Notices broadcasts over one hop that the routing protocol would forward: the key is mostly meant
/// for unicasts.
void note_broadcasts(Scenario& out) {
    if (out.routing.make().traits().routes_unicasts) return;
    Affected broadcasts;
    for (const TrafficTable& traffic : out.traffic) {
        if (traffic.kind == TrafficKind::unicast || !traffic.hops) continue;
        broadcasts.add([&] {
            return fmt::format(
                "{}: hops: with hops = 1 the routing protocol does not forward these broadcasts, "
                "so only neighbours of \"{}\" hear these broadcasts; without the key \"hops\", the "
                "protocol forwards these broadcasts",
                traffic.hops_where.text(), traffic.from);
        });
    }
    broadcasts.note(out.notices);
}

/// Notices model "disc" under protocol "managed", whose delays depend on levels.
void note_levels(Scenario& out) {
    if (!out.routing.as<Managed>()) return;
    Affected discs;
    const auto note = [&](const PropagationTable& model, const Location& where) {
        if (!model.as<Disc>()) return;
        discs.add([&] {
            return fmt::format(
                "{}: model: \"disc\" computes no received levels, so under [routing] protocol = "
                "\"managed\" a robot's delay before it relays a message does not depend on the "
                "received level; expected a different model, such as \"friis\"",
                where.text());
        });
    };
    const auto is_shared = [](const RobotTable& robot) { return !robot.propagation; };
    if (out.robots.empty() || std::any_of(out.robots.begin(), out.robots.end(), is_shared)) {
        note(out.propagation, out.propagation_where);
    }
    for (const RobotTable& robot : out.robots) {
        if (robot.propagation) note(*robot.propagation, robot.propagation_where);
    }
    discs.note(out.notices);
}

}  // namespace

void refuse_disc(const Propagation& model, const Location& where, std::string_view who) {
    if (!model.as<Disc>()) return;
    throw InputError(where, fmt::format("\"disc\" computes no received levels, which {} needs; "
                                        "expected a different propagation model",
                                        who));
}

void add_notice(std::vector<std::string>& notices, std::string notice) {
    if (std::find(notices.begin(), notices.end(), notice) != notices.end()) return;
    notices.push_back(std::move(notice));
}

void note_unlikely(Scenario& scenario) {
    const auto look = [&](const Radio& radio, const RadioPlaces& places) {
        check_sensitivity(radio, places);
        note_power(scenario, radio, places);
        note_frequency(scenario, radio, places);
        note_rate(scenario, "rate", radio.rate, places.rate);
    };
    if (scenario.robots.empty()) look(scenario.radio, scenario.radio_places);
    for (const RobotTable& robot : scenario.robots) {
        look(robot.radio, robot.radio_places);
        note_switching(scenario, robot);
    }
    if (const Csma* csma = scenario.access.as<Csma>(); csma && csma->basic_rates) {
        for (const BitRate rate : *csma->basic_rates) {
            note_rate(scenario, "basic_rates", rate, scenario.access_where);
        }
    }
    note_payloads(scenario);
    note_late(scenario);
    note_unicasts(scenario);
    note_unforwarded(scenario);
    note_broadcasts(scenario);
    note_levels(scenario);
    note_equal_starts(scenario);
}

void note_own_models(Scenario& scenario) {
    const auto& vary = scenario.study.vary;
    const bool varies = std::any_of(
        vary.begin(), vary.end(), [](const Vary& v) { return v.path.starts_with("propagation."); });
    if (!varies) return;
    constexpr std::size_t most_named = 5;
    std::vector<std::string> names;
    for (const RobotTable& robot : scenario.robots) {
        if (robot.own_model) names.push_back(fmt::format("\"{}\"", robot.name));
    }
    if (names.empty()) return;
    const std::size_t others = names.size() - std::min(names.size(), most_named);
    names.resize(names.size() - others);
    add_notice(
        scenario.notices,
        fmt::format("the varied keys of [propagation] do not affect these robots, which have their "
                    "own propagation model: {}{}",
                    fmt::join(names, ", "), others > 0 ? fmt::format(" and {} more", others) : ""));
}

std::string unlikely_frequency(Hertz frequency) {
    constexpr double lowest = 30e6, highest = 300e9;  // [Hz] VHF to EHF
    const double f = frequency.value;
    if (f >= lowest && f <= highest) return "";
    const bool slip = f * 1000 >= 10 * lowest && f * 1000 <= highest;
    return fmt::format("frequency: {} is not a frequency of robots' radios{}", shown(frequency),
                       slip ? fmt::format("; did you mean \"{}\"?", shown(Hertz{f * 1000})) : "");
}

void note_places(Scenario& scenario, const Scene* scene) {
    if (!scene) return;
    Affected beyond, in_walls;
    for (const RobotTable& robot : scenario.robots) {
        for_each_start(robot, [&](Vec3 p, const Location& where) {
            const Scene& storey = scene->storey_at(p.z);
            const double metres = distance(p, on_map(storey, p));
            if (!scene->has_border() || metres == 0) return;
            beyond.add([&] {
                return fmt::format(
                    "{}: robot \"{}\" starts at {}, {:.4g} m off the map, which goes "
                    "from {} to {}",
                    where.text(), robot.name, shown(p), metres, shown(storey.lower_left()),
                    shown(storey.upper_right()));
            });
        });
        if (!scenario.scene.world || !robot.at) continue;  // a map refuses it
        if (scene->clearance(*robot.at) >= robot.radius.value) continue;
        in_walls.add([&] {
            return fmt::format(
                "{}: robot \"{}\" at {} is inside a wall, or nearer to a wall than its radius of "
                "{} m",
                robot.at_where.text(), robot.name, shown(*robot.at), robot.radius.value);
        });
    }
    beyond.note(scenario.notices);
    in_walls.note(scenario.notices);
}

void note_antennas(Scenario& scenario, const Scene* scene) {
    const Storeys storeys = scene ? scene->storeys() : Storeys();
    const Meters height = scenario.scene.floor_height.value_or(no_storeys);
    const auto storey = [&](double z) {
        return storeys.size() > 1 ? static_cast<double>(storeys.number_at(z))
                                  : std::floor(z / height.value);
    };
    Affected elsewhere;
    for (const RobotTable& robot : scenario.robots) {
        const double above = robot.radio.antenna_height.value;
        double stands = 0;  // a start that a movement draws is on the ground
        for_each_start(robot, [&](Vec3 p, const Location&) { stands = p.z; });
        const double storeys_up = storey(stands + above) - storey(stands);
        if (!(std::abs(storeys_up) >= 1)) continue;
        elsewhere.add([&] {
            return fmt::format(
                "{}: the antenna of robot \"{}\" is {:.6g} m above the robot and therefore {:.0f} "
                "storey{} {}: floors lie between this antenna and the antennas of robots nearby; "
                "expected an antenna_height within the storey",
                robot.radio_where.text(), robot.name, above, std::abs(storeys_up),
                std::abs(storeys_up) == 1 ? "" : "s", storeys_up > 0 ? "higher" : "lower");
        });
    }
    elsewhere.note(scenario.notices);
}

}  // namespace rovernet
