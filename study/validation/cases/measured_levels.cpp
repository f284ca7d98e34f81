// SPDX-License-Identifier: MIT
#include "study/validation/cases/measured_levels.hpp"

#include "experiment/build.hpp"
#include "files/csv_table.hpp"
#include "files/word.hpp"
#include "models/link_gain.hpp"
#include "scenario/document/toml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <string_view>
#include <vector>

namespace rovernet {
namespace {

/// Coordinate [m] in a field.
double metres(const CsvTable& table, std::size_t row, std::string_view column) {
    return coordinate(table.word(row, column), table.where(row));
}
/// Number from `low` to `high` in a field.
double number(const CsvTable& table, std::size_t row, std::string_view column, double low,
              double high) {
    const std::string expected = fmt::format("a number from {} to {}", low, high);
    const double value = any_number(table.word(row, column), table.where(row), expected);
    if (!(value >= low && value <= high)) table.fail(row, column, expected);
    return value;
}

/// Building without its levels. @param map  line of [scene], or nothing
MeasuredBuilding empty_building(const std::string& name, const std::string& map,
                                const std::string& at) {
    const std::string text = fmt::format(
        "[scene]\n{}\n[radio]\nfrequency = \"2440 MHz\"\npower = \"0 dBm\"\nsensitivity = "
        "\"-65 dBm\"\n[propagation]\nsigma = \"0 dB\"\n[[robot]]\nname = \"tag\"\nat = {}\nradius "
        "= \"1 cm\"\n",
        map, at);
    MeasuredBuilding out{name, read_scenario(parse_toml(text, name), name), {}, {}};
    const NetworkSettings settings = network_settings(out.scenario);
    for (KnownLinks* known : {&out.first, &out.second}) {
        known->group_name = "receiver";
        known->measured = true;
        known->scene = settings.scene ? settings.scene : std::make_shared<Scene>();
        known->floor_height = settings.floor_height;
    }
    return out;
}

/// Receivers by name: their numbers and places.
std::map<std::string, std::pair<std::uint32_t, Vec3>> receivers(const CsvTable& table,
                                                                std::string_view name) {
    std::map<std::string, std::pair<std::uint32_t, Vec3>> out;
    for (std::size_t i = 0; i < table.size(); ++i) {
        out[table.text(i, name)] = {
            static_cast<std::uint32_t>(i),
            {metres(table, i, "x_m"), metres(table, i, "y_m"), metres(table, i, "z_m")}};
    }
    return out;
}

/// The receiver that a row of levels names.
const std::pair<std::uint32_t, Vec3>& receiver_of(
    const CsvTable& levels, std::size_t row, std::string_view name,
    const std::map<std::string, std::pair<std::uint32_t, Vec3>>& known) {
    const auto found = known.find(levels.text(row, name));
    if (found == known.end()) levels.fail(row, name, "a name that the table of positions contains");
    return found->second;
}

void add_level(KnownLinks& known, const Radio& radio, const std::string& place, Vec3 from,
               const std::pair<std::uint32_t, Vec3>& receiver, double level) {
    known.links.push_back({.name = place,
                           .place = fmt::format("{} {}", receiver.first, place),
                           .from = from,
                           .to = receiver.second,
                           .frequency = radio.frequency,
                           .group = receiver.first,
                           .loss = received_power(radio, radio, Db{0}).value - level,
                           .budget = link_budget(radio, radio).value});
    known.groups = std::max<std::size_t>(known.groups, receiver.first + 1);
}

/// Place of the first level that its receiver had within 15 cm of there; a new one if none was.
std::string place_near(const KnownLinks& known, std::uint32_t receiver, Vec3 at) {
    constexpr double same = 0.15;  // [m]
    for (const KnownLink& link : known.links) {
        if (link.group == receiver && distance(link.from, at) < same) return link.name;
    }
    return fmt::format("{} {} {}", at.x, at.y, at.z);
}

}  // namespace

MeasuredBuilding measured_flat(const std::string& folder) {
    constexpr double tag_height = 1.3;  // [m]
    MeasuredBuilding out = empty_building(
        "flat", "map = " + to_toml(Value(folder + "/flat/map.yaml")), "[\"2 m\", \"4 m\"]");
    const CsvTable cells(folder + "/flat/cells.csv");
    const auto anchors = receivers(CsvTable(folder + "/flat/anchors.csv"), "anchor");
    for (std::size_t i = 0; i < cells.size(); ++i) {
        KnownLinks& known = cells.text(i, "set") == "calibration" ? out.first : out.second;
        add_level(
            known, out.scenario.radio, cells.text(i, "cell_x") + " " + cells.text(i, "cell_y"),
            {metres(cells, i, "x_m"), metres(cells, i, "y_m"), tag_height},
            receiver_of(cells, i, "anchor", anchors), number(cells, i, "mean_rssi_dbm", -300, 100));
    }
    return out;
}

MeasuredBuilding measured_lab(const std::string& folder) {
    MeasuredBuilding out = empty_building("laboratory", "", "[\"2 m\", \"4 m\"]");
    const CsvTable links(folder + "/lab/links.csv");
    const auto sensors = receivers(CsvTable(folder + "/lab/sensors.csv"), "sensor");
    for (const std::string set : {"1", "2"}) {
        KnownLinks& known = set == "1" ? out.first : out.second;
        for (std::size_t i = 0; i < links.size(); ++i) {
            if (links.text(i, "set") != set) continue;
            const Vec3 at{metres(links, i, "x_m"), metres(links, i, "y_m"),
                          metres(links, i, "z_m")};
            const auto& sensor = receiver_of(links, i, "sensor", sensors);
            const std::string place = set == "1" ? fmt::format("{} {} {}", at.x, at.y, at.z)
                                                 : place_near(out.first, sensor.first, at);
            add_level(known, out.scenario.radio, place, at, sensor,
                      number(links, i, "median_dbm", -300, 100));
        }
    }
    return out;
}

}  // namespace rovernet
