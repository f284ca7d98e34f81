// SPDX-License-Identifier: MIT
#include "cli/display/picture_output.hpp"
#include "cli/scenes/presence_text.hpp"
#include "cli/scenes/scene_commands.hpp"
#include "cli/terminal/diagnostics.hpp"
#include "cli/terminal/playing.hpp"
#include "cli/terminal/stop.hpp"
#include "cli/terminal/waiting.hpp"
#include "experiment/reports/loss_table.hpp"
#include "experiment/reports/network_at.hpp"
#include "experiment/reports/route_report.hpp"
#include "experiment/reports/scene_report.hpp"
#include "experiment/reports/whereabouts.hpp"
#include "experiment/run.hpp"
#include "pictures/map/picture.hpp"
#include "scenario/document/json.hpp"
#include "scene/images/image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>

namespace rovernet::cli {
namespace {

bool is_map(const std::string& file) {
    const auto ending = std::filesystem::path(file).extension();
    return is_image_name(file) || ending == ".yaml" || ending == ".yml";
}

/// The scenario of a picture or a report of its map, which needs no robots.
Scenario scene_of(FileArguments a) {
    a.options.needs_robots = false;
    return scenario_of(a);
}

/// "16x16" or "16 m x 9 m", in metres.
std::vector<Meters> size_of(const std::string& text) {
    const auto cross = text.find('x');
    if (cross == text.npos) {
        throw InputError(Location{"--size " + text, 0, 0, true},
                         "expected WIDTHxHEIGHT in metres; for example 16x16");
    }
    return {option_length("--size", text.substr(0, cross)),
            option_length("--size", text.substr(cross + 1))};
}

/// A map alone.
Table map_report(const SceneArguments& a) {
    SceneTable table;
    table.map = std::filesystem::path(a.file).filename().string();
    table.map_where = Location{a.file};
    if (is_image_name(a.file) && !a.size) {
        throw InputError(Location{a.file},
                         "found a picture without a scale; expected a map.yaml, or the option "
                         "--size WIDTHxHEIGHT in metres, such as --size 16x16");
    }
    if (a.size) table.size = size_of(*a.size);
    std::vector<std::string> notices;  // of materials; a map alone has those beside it
    const auto map = load_map(table, a.file, notices);
    for (const std::string& text : notices) notice(text);
    return scene_report(*map, a.json);
}

void print_list(std::string_view what, const Value& names) {
    std::string line;
    for (const Value& name : *names.array()) line += (line.empty() ? "" : ", ") + *name.string();
    fmt::print("{:<20} {}\n", what, line.empty() ? "none" : line);
}

void print_materials(const Array& materials) {
    for (const Value& material : materials) {
        std::string line;
        for (const Entry& entry : material.table()->entries) {
            if (entry.key == "name") continue;
            const std::string text = to_json(entry.value);
            line += fmt::format("  {} {}", entry.key, text.substr(0, text.size() - 1));
        }
        fmt::print("{:<20} {}{}\n", "material", *material.table()->find("name")->string(), line);
    }
}

void print_scene(const Table& report) {
    const auto number = [&](std::string_view key) {
        const std::string text = to_json(*report.find(key));
        return text.substr(0, text.size() - 1);
    };
    const Array& size = *report.find("size_m")->array();
    fmt::print("{:<20} {:.6g} x {:.6g} m\n", "size", std::get<double>(size[0].data),
               std::get<double>(size[1].data));
    if (const Value* floors = report.find("floors_m")) {
        std::string heights;
        for (const Value& height : *floors->array()) {
            heights +=
                fmt::format("{}{}", heights.empty() ? "" : ", ", std::get<double>(height.data));
        }
        fmt::print("{:<20} at {} m\n", "floors", heights);
    }
    fmt::print("{:<20} {}\n", "occupied cells", number("occupied_cells"));
    fmt::print("{:<20} {}\n", "wall rectangles", number("wall_rectangles"));
    if (const auto* free = std::get_if<double>(&report.find("free_area_m2")->data)) {
        fmt::print("{:<20} {:.3f} m2\n", "free area", *free);
    }
    for (const char* key : {"materials", "ceilings"}) {
        const Value* list = report.find(key);
        if (list) print_materials(*list->array());
    }
}

std::string times_text(const Value& times) {
    std::string text;
    for (const Value& t : *times.array())
        text += fmt::format("{}{:g} s", text.empty() ? "" : ", ", std::get<double>(t.data));
    return text;
}

void print_doors(const Table& report) {
    const auto number = [](const Table& table, std::string_view key) {
        return std::get<double>(table.find(key)->data);
    };
    const auto place = [&](const Table& table) {
        return fmt::format("({:.6g}, {:.6g}{})", number(table, "x_m"), number(table, "y_m"),
                           table.find("z_m") ? fmt::format(", {:.6g}", number(table, "z_m")) : "");
    };
    const auto end = [&](const Table& of, std::string_view key) {
        return place(*of.find(key)->table());
    };
    if (const Value* doors = report.find("doors")) {
        for (const Value& each : *doors->array()) {
            const Table& door = *each.table();
            const std::string closes = times_text(*door.find("closes_s")),
                              opens = times_text(*door.find("opens_s"));
            fmt::print(
                "{:<20} {} from {} to {} m{}, {}, {}{}{}\n", "door", *door.find("name")->string(),
                end(door, "from"), end(door, "to"),
                door.find("floor_m") ? fmt::format(" at {:g} m", number(door, "floor_m")) : "",
                *door.find("material")->string(),
                std::get<bool>(door.find("closed")->data) ? "closed" : "open",
                closes.empty() ? "" : "; closes at " + closes,
                opens.empty() ? "" : "; opens at " + opens);
        }
    }
    if (const Value* stairs = report.find("stairs")) {
        for (const Value& each : *stairs->array()) {
            fmt::print("{:<20} from {} to {} m\n", "stairs", end(*each.table(), "foot"),
                       end(*each.table(), "head"));
        }
    }
}

void print_robots(const Table& report) {
    for (const Value& robot : *report.find("robots")->array()) {
        const Table& r = *robot.table();
        const auto value = [&](std::string_view key) {
            return std::get<double>(r.find(key)->data);
        };
        const std::string z = value("z_m") == 0 ? "" : fmt::format(", {:.3f}", value("z_m"));
        fmt::print("{:<20} {} at ({:.3f}, {:.3f}{}) m, {}, {:.2f} dBm, sensitivity {:.2f} dBm{}\n",
                   "robot", *r.find("name")->string(), value("x_m"), value("y_m"), z,
                   *r.find("model")->string(), value("power_dbm"), value("sensitivity_dbm"),
                   presence_text(*r.find("presence")->string()));
    }
    const Value* connectivity = report.find("connectivity");
    if (!connectivity) return;
    const Table& c = *connectivity->table();
    for (const Value& part : *c.find("components")->array()) print_list("joined", part);
    print_list("articulation robots", *c.find("articulation_robots"));
    fmt::print("{:<20} {} hops\n", "diameter",
               std::get<std::int64_t>(c.find("diameter_hops")->data));
}

/// Both ends of the option --routes.
std::optional<PictureOptions::Route> route_of(const DrawArguments& a) {
    if (a.route.empty()) return std::nullopt;
    if (a.route.size() == 2 && a.route[0] != a.route[1])
        return PictureOptions::Route{a.route[0], a.route[1]};
    throw InputError(Location{fmt::format("--routes {}", fmt::join(a.route, ",")), 0, 0, true},
                     "expected two different robots, such as A,B");
}

std::unique_ptr<Network> played(const std::string& file, const Scenario& scenario, Time until) {
    Playing playing(file, until);
    return network_at(scenario, until, playing.tell());
}

}  // namespace

Time time_in(const Scenario& scenario, const std::string& text) {
    const Time at = start_of_run + option_time("--at", text);
    const Duration end = scenario.scenario.duration;
    if (at > start_of_run + end) {
        notice(fmt::format(
            "--at {}: the run ends at {:.9g} s; the simulation continues until the given time",
            text, seconds(end)));
    }
    return at;
}

Time time_within(const Scenario& scenario, const std::string& text) {
    const Duration end = scenario.scenario.duration, at = option_time("--at", text);
    if (at <= end) return start_of_run + at;
    throw InputError(
        Location{"--at " + text, 0, 0, true},
        fmt::format("expected a time within the run, which ends at {:.9g} s", seconds(end)));
}

void scene(const SceneArguments& a) {
    Table report;
    if (is_map(a.file)) {
        report = map_report(a);
    } else {
        const Scenario scenario = scene_of(a);
        const Time at = time_in(scenario, a.at);
        const auto network = played(a.file, scenario, at);
        report = scene_report(network->scene(), a.json);
        append_doors_and_stairs(report, scenario, network->scene(), at);
        append_robots(report, *network);
    }
    if (a.json) {
        fmt::print("{}", to_json(report));
        return;
    }
    print_scene(report);
    print_doors(report);
    if (report.find("robots")) print_robots(report);
}

void draw(const DrawArguments& a) {
    check_picture_name(a.out);
    const bool shows_routing = !a.route.empty() || a.search;
    const auto route = route_of(a);
    const Scenario scenario = scene_of(a);
    if (shows_routing) check_has_routes(scenario);
    const PictureOptions options{
        .at = shows_routing ? time_within(scenario, a.at) : time_in(scenario, a.at),
        .coverage = a.coverage,
        .receiver = a.receiver,
        .route = route,
        .search = a.search,
        .links = a.links,
        .trails = a.trails,
        .margin_to = a.margin_to,
        .over = a.over,
        .storey = a.storey,
        .axes = a.axes,
        .width = a.width,
        .font_size = a.font_size};
    const std::string svg = [&] {
        const Waiting waiting("drawing " + a.file);
        return draw_svg(scenario, options);
    }();
    write_picture(a.out, svg);
}

void convert_movements(const ConvertArguments& a) {
    const Scenario scenario = scenario_of(a);
    std::vector<std::string> notices;
    const auto files = [&] {
        Playing playing(a.file, start_of_run + scenario.scenario.duration);
        return movement_files(scenario, a.out, notices, playing.tell());
    }();
    write_whole(files);
    for (const std::string& each : notices) notice(each);
}

}  // namespace rovernet::cli
