// SPDX-License-Identifier: MIT
#pragma once

#include "sim/ids.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace rovernet {

class Network;

/// Strength of a link that is up.
struct LinkStrength {
    Dbm level;  ///< received power [dBm]
    Db margin;  ///< level above the receiver's sensitivity [dB], >= 0
    /// False under the model disc, which gives no levels: `level` and `margin` mean nothing.
    bool has_level;
};

/// Two robots with a link from `from` to `to`, and often also a link back.
struct LinkPair {
    NodeId from, to;  ///< from < to if the link works in both directions
    LinkStrength there;
    std::optional<LinkStrength> back;  ///< none: a one-way link

    /// Smaller margin of both directions [dB].
    Db margin() const { return back && back->margin < there.margin ? back->margin : there.margin; }
};

/// Largest number of robots whose links link_pairs() finds.
inline constexpr std::uint32_t most_linked = 5000;

/// All pairs of robots with a link at the time `at`, in the order of the robots. Links are local
/// means, without fading.
/// @param at_one_end  function that selects robots; only pairs with at least one selected robot are
/// returned
/// @throws RunError if selected robots times all robots exceeds the square of most_linked
std::vector<LinkPair> link_pairs(const Network& network, Time at,
                                 const std::function<bool(NodeId)>& at_one_end);

}  // namespace rovernet
