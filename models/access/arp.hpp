// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fields.hpp"
#include "sim/units.hpp"

#include <optional>

namespace rovernet {

/// Settings of address resolution (ARP, RFC 826), keys of [access] beside those of the access
/// model. With ARP a robot asks for the MAC address of a next hop by a broadcast before its first
/// unicast to it; without ARP all addresses are known.
struct ArpSettings {
    /// Whether robots resolve addresses.
    bool arp = false;
    /// Time after which an address is forgotten [ns], > 0; empty: never, as in ns-2.
    std::optional<Duration> arp_timeout = std::nullopt;

    static constexpr auto fields() {
        return describe(
            field("arp", &ArpSettings::arp, "whether robots ask for the address of a next hop"),
            field("arp_timeout", &ArpSettings::arp_timeout,
                  Range{.low = 0, .high = 1e18, .low_included = false, .text = "> 0 s"},
                  "after which an address is forgotten; never if not given"));
    }
};

}  // namespace rovernet
