// SPDX-License-Identifier: MIT
#include "live/player/wifi.hpp"

#include "experiment/reports/link_table.hpp"

#include <cmath>

namespace rovernet {
namespace {

constexpr std::uint32_t tell_mac = 1;        // request
constexpr std::uint32_t levels_in_dbm = 1;   // qual_type
constexpr std::uint32_t best_quality = 100;  // maxqual
constexpr std::size_t access_point = 32;     // [bytes] of its address: there is none

std::uint32_t mode_of(WifiMode mode) { return static_cast<std::uint32_t>(mode) + 1; }
std::int32_t whole(Dbm level) { return static_cast<std::int32_t>(std::lround(level.value)); }

std::uint32_t megahertz(Hertz frequency) {
    return static_cast<std::uint32_t>(std::lround(frequency.value / 1e6));
}

void put_link(XdrWriter& out, const LinkTable::Row& row) {
    const Device& device = row.neighbour;
    out.bytes(device.mac).bytes(device.ip).bytes(device.essid);
    out.u32(mode_of(device.mode)).u32(megahertz(device.frequency)).u32(device.encryption ? 1 : 0);
    out.i32(row.quality).i32(whole(row.level)).i32(whole(row.noise));
}

LinkTable link_table(const PlayerRobot& robot) {
    LinkTable found;
    const Network& network = robot.session().network();
    for_each_link_table(network, network.name(robot.id()),
                        [&](const LinkTable& table) { found = table; });
    return found;
}

}  // namespace

std::vector<std::string> PlayerWifi::data() {
    const LinkTable table = link_table(robot_);
    const Radio& radio = robot_.session().network().robot(robot_.id()).radio;
    XdrWriter out;
    out.count(table.rows.size());
    for (const LinkTable::Row& row : table.rows) put_link(out, row);
    out.u32(0);  // throughput
    out.u32(static_cast<std::uint32_t>(std::lround(radio.rate.value)));
    out.u32(mode_of(table.device.mode)).u32(levels_in_dbm).u32(best_quality);
    out.u32(0).u32(0);  // the best level and noise
    return {out.zeros(access_point).take()};
}

std::optional<std::string> PlayerWifi::answer(std::uint32_t subtype, XdrReader) {
    if (subtype != tell_mac) return std::nullopt;
    return XdrWriter().bytes(link_table(robot_).device.mac).take();
}

}  // namespace rovernet
