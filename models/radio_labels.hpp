// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fields.hpp"
#include "sim/units.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace rovernet {

/// Mode of a radio in its network (IEEE 802.11); a label for tables, without effect on links.
enum class WifiMode { automatic, adhoc, infrastructure, master, repeater, secondary };
/// Names of the values of `mode` in scenario files.
template <>
struct EnumNames<WifiMode> {
    static constexpr std::array<std::string_view, 6> values = {
        "auto", "adhoc", "infrastructure", "master", "repeater", "secondary"};
};

/// Labels of a radio, for link tables, pictures, Player and emulated devices. Links do not depend
/// on them. The wifi of a Stage world has all of them.
struct RadioLabels {
    /// IP address of the radio, unique; generated if not given.
    std::optional<std::string> ip = std::nullopt;
    /// Netmask of the IP address.
    std::string netmask = "255.255.255.0";
    /// MAC address of the radio, unique; generated if not given.
    std::optional<std::string> mac = std::nullopt;
    /// Mode of the radio in its network (IEEE 802.11).
    WifiMode mode = WifiMode::adhoc;
    /// Whether the network is encrypted.
    bool encryption = false;
    /// Received power [dBm] at which pictures draw a contour line around the radio.
    std::optional<Dbm> range_db = std::nullopt;

    friend bool operator==(const RadioLabels&, const RadioLabels&) = default;

    /// Labels in scenario files: keys of [radio] and of a robot's own `radio`, beside the
    /// parameters of Radio.
    static constexpr auto fields() {
        return describe(
            field("ip", &RadioLabels::ip,
                  "IP address, different for each robot; if not given, an address is generated"),
            field("netmask", &RadioLabels::netmask,
                  "netmask of the IP address; it has no effect on radio"),
            field("mac", &RadioLabels::mac,
                  "hardware (MAC) address, different for each robot; if not given, an address is "
                  "generated"),
            field("mode", &RadioLabels::mode,
                  "role of the radio in the network: a label without any effect"),
            field("encryption", &RadioLabels::encryption,
                  "encryption of the network: a label without any effect"),
            field("range_db", &RadioLabels::range_db,
                  "received level of the dashed contour line in pictures of coverage"));
    }
};

}  // namespace rovernet
