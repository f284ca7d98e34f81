// SPDX-License-Identifier: MIT
#include "scenario/scenario.hpp"

#include "models/phy/phy.hpp"
#include "models/propagation/disc.hpp"
#include "scenario/document/choice.hpp"
#include "scenario/document/located.hpp"
#include "scenario/idle_keys.hpp"
#include "scenario/memory.hpp"
#include "scenario/names.hpp"
#include "scenario/robot_list.hpp"
#include "scenario/tables/flow_names.hpp"
#include "scenario/tables/read_model.hpp"
#include "scenario/tables/reader.hpp"
#include "scenario/traffic_file.hpp"
#include "scenario/unknown_key.hpp"
#include "scenario/unlikely.hpp"
#include "sim/math.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

namespace rovernet {
namespace {

/// Checks the name of the run, which becomes that of a folder.
void check_run_name(TableReader& document, const std::string& name) {
    if (const Value* table = document.take("scenario")) {
        if (const Value* given = table->table()->find("name"))
            check_printable(*given, "name", name);
    }
    if (!name.empty() && name.front() != '.' && name.find('/') == std::string::npos) return;
    const Value* given = document.take("scenario")->table()->find("name");
    throw InputError(given->where, fmt::format("name: found {}; expected a name for a folder: not "
                                               "empty, without \"/\", and not beginning with \".\"",
                                               given->description()));
}

/// Checks that saturated traffic has an access model: otherwise it would send without end at once.
void check_traffic(const Scenario& scenario) {
    if (!scenario.access.as<NoAccess>()) return;
    for (const TrafficTable& traffic : scenario.traffic) {
        if (!traffic.saturate) continue;
        throw InputError(traffic.from_where,
                         "saturate: without an access model this robot would send infinitely many "
                         "messages at once; expected [access] model = \"csma\" or \"aloha\"");
    }
}

/// Checks a bit rate: reception model "sinr" can compute its errors.
void check_coding(const Phy& phy, std::string_view key, BitRate rate, Location where) {
    if (phy.coding(rate)) return;
    throw InputError(where,
                     fmt::format("{}: found {} Mbit/s; expected one of the rates for which "
                                 "[reception] model = \"sinr\" can compute bit errors: {} Mbit/s",
                                 key, rate.value / 1e6, megabits_text(phy.rates())));
}

/// Checks the requirements of reception model "sinr": levels, and bit rates with known error rates.
void check_sinr(const Scenario& scenario) {
    if (!scenario.reception.as<Sinr>()) return;
    const Phy phy = scenario.access.make().phy();
    const Csma* csma = scenario.access.as<Csma>();
    if (csma && csma->basic_rates) {
        for (const BitRate rate : *csma->basic_rates) {
            check_coding(phy, "basic_rates", rate, scenario.access_where);
        }
    }
    const auto check = [&](const PropagationTable& propagation, Location propagation_where,
                           const Radio& radio, Location rate_where) {
        if (propagation.make().name() == Disc::name) {
            throw InputError(propagation_where,
                             "model: \"disc\" computes no received levels, which [reception] model "
                             "= \"sinr\" needs; expected a different propagation model, such as "
                             "\"friis\"");
        }
        check_coding(phy, "rate", radio.rate, rate_where);
    };
    for (const RobotTable& robot : scenario.robots) {
        const bool own = robot.propagation.has_value();
        check(own ? *robot.propagation : scenario.propagation,
              own ? robot.propagation_where : scenario.propagation_where, robot.radio,
              robot.radio_places.rate);
    }
}

/// Reads [[traffic]]: flows, and files of flows; a lone [traffic] may be a file, too.
void read_all_traffic(TableReader& document, Scenario& out) {
    const auto is_file = [](const Value& v) { return v.table() && v.table()->find("file"); };
    const Value* value = document.take("traffic");
    if (value && is_file(*value)) return read_flows(*value, out);
    for (const Value& item : document.take_list("traffic")) {
        if (is_file(item)) {
            read_flows(item, out);
        } else {
            out.traffic.push_back(read_traffic(item));
        }
    }
}

template <Described T>
void read_section(TableReader& document, std::string_view key, T& out) {
    const Value* value = document.take(key);
    if (!value) return;
    TableReader table(*value, fmt::format("[{}]", key));
    table.expect<T>();
    table.read_fields(out);
}

/// Checks that the largest contention window is not below the least one.
void check_windows(const Csma& csma, const Table& table) {
    const int least = csma.timing().cw_min;
    if (!csma.cw_max || csma.timing().cw_max == *csma.cw_max) return;
    const Value& given = *table.find("cw_max");
    throw InputError(given.where, fmt::format("cw_max: found {}; expected at least cw_min = {}",
                                              given.description(), least));
}

/// Checks values that are valid for other access models, but not for csma.
void check_csma(const Csma& csma, const Table& table) {
    constexpr double longest = 1e9;  // [s] of a backoff; see read_value of a time
    const WifiTiming timing = csma.timing();
    const double backoff = timing.cw_max * seconds(timing.slot);
    if (timing.slot == Duration{0} || backoff > longest) {
        const Value& slot = *table.find("slot");
        throw InputError(
            slot.where,
            fmt::format(
                "slot: found {}; [access] model = \"csma\" waits up to {} slots in a backoff; "
                "expected a slot > 0 s, and so short that no backoff is longer than 1e9 s",
                slot.description(), timing.cw_max));
    }
    check_windows(csma, table);
    const auto& given_rates = csma.basic_rates;
    const auto is_none = [](BitRate rate) { return !(rate > BitRate{0}); };
    if (given_rates &&
        (given_rates->empty() || std::any_of(given_rates->begin(), given_rates->end(), is_none))) {
        const Value& given = *table.find("basic_rates");
        throw InputError(given.where, fmt::format("basic_rates: found {}; expected a list of at "
                                                  "least one bit rate, and only bit rates > 0",
                                                  given.description()));
    }
}

/// Reads [shadowing] or [fading], whose parameters are nothing without a model.
template <Described T>
void read_variation(TableReader& document, std::string_view key, std::string_view example, T& out) {
    read_section(document, key, out);
    const Value* value = document.take(key);
    if (!value || value->table()->find("model")) return;
    throw InputError(
        value->where,
        fmt::format("[{}]: the key \"model\" is missing; expected model = \"{}\"", key, example));
}

/// Checks that a model with its own shadowing is not combined with [shadowing].
void check_shadowing(TableReader& document, const Scenario& scenario) {
    if (scenario.shadowing.model == ShadowingModel::none) return;
    const Location where = document.take("shadowing")->where;
    const auto check = [&](const PropagationTable& propagation) {
        const Propagation model = propagation.make();
        if (!model.is_random()) return;
        throw InputError(
            where,
            fmt::format("[shadowing]: propagation model \"{}\" already contains shadowing, so "
                        "losses would have shadowing twice; switch one of the two off: set "
                        "[propagation] sigma = \"0 dB\", or [shadowing] model = \"none\"",
                        model.name()));
    };
    const auto has_own = [](const RobotTable& robot) { return robot.propagation.has_value(); };
    const auto& robots = scenario.robots;
    const bool all_own = !robots.empty() && scenario.movement.robots.empty() &&
                         std::all_of(robots.begin(), robots.end(), has_own);
    if (!all_own) check(scenario.propagation);
    for (const RobotTable& robot : robots) {
        if (robot.propagation) check(*robot.propagation);
    }
}

/// Reads a table that chooses a model of a list, such as [access]; it may be missing.
template <class Choice, class... Common>
void read_choice_of(TableReader& document, std::string_view table, std::string_view key,
                    Choice& out, Common&... common) {
    if (const Value* value = document.take(table))
        read_model(*value, fmt::format("[{}]", table), key, key, out, common...);
}

void read_access(TableReader& document, Scenario& out) {
    read_choice_of(document, "access", "model", out.access, out.arp);
    const Value* access = document.take("access");
    if (!access) return;
    const Value* rates = access->table()->find("basic_rates");
    out.access_where = rates ? rates->where : access->where;
    if (const Csma* csma = out.access.as<Csma>()) check_csma(*csma, *access->table());
}

/// Reads [movement], and the robots that its file names; they need no [[robot]].
void read_movement(TableReader& document, Scenario& out) {
    read_section(document, "movement", out.movement);
    const Value* section = document.take("movement");
    if (!section) return;
    const Value* file = section->table()->find("file");
    out.movement.where = file ? file->where : section->where;
    if (!file) return;
    const auto path = std::filesystem::path(out.file).parent_path() / *out.movement.file;
    const MovementFile movements = located_file(out.movement.where, "file", [&] {
        return MovementFile(path.string(), out.movement.syntax);
    });
    out.movement.robots = movements.robots();
    const auto& notices = movements.notices();
    out.notices.insert(out.notices.end(), notices.begin(), notices.end());
}

/// Adds notices about random waypoint models that do not start in the stationary state: their mean
/// speed falls for a while.
void note_decay(Scenario& out) {
    for (const RobotTable& robot : out.robots) {
        const auto* model = std::get_if<RandomWaypoint>(&robot.move.model);
        if (!model || model->start == StartState::stationary) continue;
        const auto driven = [&](MetersPerSecond speed) {
            return (robot.top_speed ? std::min(speed, *robot.top_speed) : speed).value;
        };
        const double low = driven(model->min_speed), high = driven(model->max_speed);
        if (low == high) continue;
        const double settled = low > 0 ? (high - low) / math::log(high / low) : 0;
        out.notices.push_back(fmt::format(
            "{}: robot \"{}\" moves by random_waypoint with start = \"{}\", so its mean speed "
            "falls from {:.3g} to {:.3g} m/s during the run; start = \"stationary\" (without the "
            "keys \"at\" and \"place\") avoids this",
            robot.move.where.text(), robot.name, name_of(model->start), (low + high) / 2, settled));
    }
}

}  // namespace

void read_value(const Value& value, std::string_view key, EifsRule& out) {
    if (const bool* word = std::get_if<bool>(&value.data)) {
        out = *word ? EifsRule::standard : EifsRule::none;
        return;
    }
    const auto& words = EnumNames<EifsRule>::values;
    const ChoiceHelp help{
        .meanings = {"after a frame whose reception began and failed, as in 802.11",
                     "after each frame that was sensed but not decoded, as in ns-2.35", "never"},
        .yes = name_of(EifsRule::standard),
        .no = name_of(EifsRule::none)};
    out = static_cast<EifsRule>(read_choice(value, key, {words.begin(), words.end()}, help));
}

Radio usual_radio(const AccessTable& access) {
    Radio out;
    access.for_each([&](const auto& each, bool chosen) {
        if constexpr (requires { each.usual_radio(); }) {
            if (chosen) out = each.usual_radio();
        }
    });
    return out;
}

Scenario read_scenario(const Value& value, const std::string& file, bool needs_robots,
                       const std::vector<std::string>& notices) try {
    Scenario out;
    out.file = file;
    out.notices = notices;
    TableReader document(value, "the scenario");
    document.expect({"scenario", "scene", "access", "radio", "medium", "propagation", "shadowing",
                     "fading", "reception", "links", "movement", "robot", "routing", "traffic",
                     "trace", "metrics", "study"});
    read_section(document, "scenario", out.scenario);
    check_run_name(document, out.scenario.name);
    if (const Value* scene = document.take("scene")) out.scene = read_scene(*scene);
    read_access(document, out);
    out.radio = usual_radio(out.access);
    if (const Value* radio = document.take("radio")) {
        read_radio(*radio, "[radio]", out.radio, out.radio_places);
    }
    read_section(document, "medium", out.medium);
    out.propagation_where = value.where;
    if (const Value* propagation = document.take("propagation")) {
        out.propagation_where = propagation->where;
        read_propagation(*propagation, out.propagation);
    }
    read_variation(document, "shadowing", "field", out.shadowing);
    read_variation(document, "fading", "rayleigh", out.fading);
    read_choice_of(document, "reception", "model", out.reception);
    read_section(document, "links", out.links);
    read_movement(document, out);
    read_robots(document, out);
    read_choice_of(document, "routing", "protocol", out.routing);
    read_all_traffic(document, out);
    name_flows(out.traffic);
    read_section(document, "trace", out.trace);
    read_section(document, "metrics", out.metrics);
    if (const Value* study = document.take("study")) {
        out.study = read_study(*study, out.scenario.duration);
    }
    const std::vector<std::string>& asked = out.study.metrics;
    const bool asks_reach = std::find(asked.begin(), asked.end(), "reach") != asked.end();
    if (asks_reach && !out.metrics.reach) out.metrics.reach = true;
    check_robots(document, out, needs_robots);
    check_memory(out, available_memory());
    check_names(out);
    check_traffic(out);
    check_sinr(out);
    check_shadowing(document, out);
    note_decay(out);
    note_unlikely(out);
    note_idle_keys(value, out);
    check_addresses(out);
    return out;
} catch (const UnknownKey& fault) {
    throw with_tables(fault);
}

}  // namespace rovernet
