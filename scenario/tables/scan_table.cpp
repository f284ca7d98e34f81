// SPDX-License-Identifier: MIT
#include "scenario/tables/scan_table.hpp"

#include "scenario/tables/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

namespace rovernet {
namespace {

constexpr std::size_t most_beams = 10'000;

void check_scanner_name(const Value& value, const std::string& name) {
    check_printable(value, "name", name);
    if (name.empty() || name.find_first_of("./\"") != std::string::npos) {
        throw InputError(value.where,
                         fmt::format("name: found {}; expected a name, without dots, slashes and "
                                     "quotes",
                                     value.description()));
    }
}

void check_fan(const RangeFinder& fan, TableReader& table) {
    constexpr double whole_turn = 6.283185307179587;  // [rad]
    const Radians spread = fan.to - fan.from;
    if (spread.value >= 0 && spread.value <= whole_turn) return;
    const Value* to = table.take("to");
    throw InputError(to ? to->where : table.where(),
                     fmt::format("scan: found an angle of {:.6g} degrees from the key `from` to "
                                 "the key `to`; expected 0 to 360 degrees",
                                 360 * spread.value / whole_turn));
}

void check_ring(const Scanner& ring, const Value& angles, TableReader& table) {
    for (const char* key : {"beams", "from", "to"}) {
        if (table.take(key)) table.only_one_of("angles", key);
    }
    if (ring.angles.empty() || ring.angles.size() > most_beams) {
        throw InputError(angles.where,
                         fmt::format("angles: found {} angles; expected 1 to 10,000 angles",
                                     ring.angles.size()));
    }
    if (ring.finder.kind == RangeFinderKind::laser) {
        throw InputError(angles.where,
                         "angles: the beams of a laser are evenly spaced; expected the keys "
                         "`beams`, `from` and `to`, or kind = \"sonar\" or \"ranger\"");
    }
    const Value* places = table.take("places");
    if (places && ring.places.size() != ring.angles.size()) {
        throw InputError(
            places->where,
            fmt::format("places: found {} places; expected one place for each of the {} `angles`",
                        ring.places.size(), ring.angles.size()));
    }
}

Scanner read_scanner(const Value& value) {
    TableReader table(value, "scan");
    table.expect<RangeFinder, Scanner>();
    Scanner scanner;
    table.read_fields(scanner.finder);
    table.read_fields(scanner);
    if (const Value* name = table.take("name")) check_scanner_name(*name, scanner.name);
    if (const Value* angles = table.take("angles")) {
        check_ring(scanner, *angles, table);
    } else {
        if (table.take("places")) table.missing("angles", "angles = [\"90 deg\", \"-90 deg\"]");
        check_fan(scanner.finder, table);
    }
    return scanner;
}

/// Gives a name to a second of a kind, and refuses a name that is there already.
void add_scanner(std::vector<Scanner>& scanners, Scanner scanner, const Value& value) {
    const RangeFinderKind kind = scanner.finder.kind;
    const auto same = std::count_if(scanners.begin(), scanners.end(),
                                    [&](const Scanner& each) { return each.finder.kind == kind; });
    if (scanner.name.empty() && same > 0) scanner.name = fmt::format("{}{}", name_of(kind), same);
    const std::string label = scanner.label();
    const bool is_taken = std::any_of(scanners.begin(), scanners.end(),
                                      [&](const Scanner& each) { return each.label() == label; });
    if (is_taken) {
        const Value* name = value.table()->find("name");
        throw InputError(name ? name->where : value.where,
                         fmt::format("scan: two range finders are named \"{}\"; expected a "
                                     "different name for each, such as name = \"rear\"",
                                     label));
    }
    scanners.push_back(std::move(scanner));
}

Table scanner_document(const Scanner& scanner) {
    Table table;
    append_fields(table, scanner.finder);
    if (scanner.is_ring()) {
        std::erase_if(table.entries, [](const Entry& entry) {
            return entry.key == "beams" || entry.key == "from" || entry.key == "to";
        });
    }
    const Scanner usual;
    for_each_field<Scanner>([&](const auto& f) {
        if (scanner.*f.member != usual.*f.member) append_field(table, f.name, scanner.*f.member);
    });
    return table;
}

}  // namespace

std::vector<Scanner> read_scanners(const Value& value) {
    std::vector<Scanner> scanners;
    if (const Array* list = value.array()) {
        for (const Value& each : *list) add_scanner(scanners, read_scanner(each), each);
    } else {
        add_scanner(scanners, read_scanner(value), value);
    }
    return scanners;
}

Value scanners_document(const std::vector<Scanner>& scanners) {
    Array list;
    for (const Scanner& each : scanners) list.emplace_back(scanner_document(each));
    return list.size() == 1 ? std::move(list.front()) : Value(std::move(list));
}

}  // namespace rovernet
