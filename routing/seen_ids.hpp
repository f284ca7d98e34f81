// SPDX-License-Identifier: MIT
#pragma once

#include "routing/node_map.hpp"
#include "routing/sequence.hpp"
#include "sim/ids.hpp"
#include "sim/time.hpp"

#include <cstdint>

namespace rovernet {

/// Numbers of the packets that a node has received, by originator: the highest number, and which of
/// the 64 numbers below the highest. Each originator numbers its packets upwards. The numbers of an
/// originator are forgotten after a time without packets, so that the originator may start again.
class SeenIds {
  public:
    /// Stores the number of a received packet. Numbers more than 64 below the originator's highest
    /// number count as seen.
    /// @param memory  time [ns] after which the numbers of a silent originator are forgotten
    /// @return whether the number is new
    bool note(NodeId originator, std::uint32_t id, Time now, Duration memory) {
        Numbers* const found = of_.find(originator);
        if (!found) {
            // Numbers of silent originators are forgotten when the table needs more memory.
            if (of_.is_full()) {
                of_.erase_if([&](const Numbers& each) { return now - each.last > memory; });
            }
            of_.insert({originator, id, 0, now});
            return true;
        }
        Numbers& known = *found;
        if (now - known.last > memory) {
            known = {originator, id, 0, now};
            return true;
        }
        known.last = now;
        if (is_newer(id, known.highest)) {
            const std::uint32_t step = id - known.highest;
            known.below = step > 64 ? 0 : (step == 64 ? 0 : known.below << step) | bit(step);
            known.highest = id;
            return true;
        }
        const std::uint32_t back = known.highest - id;
        if (back == 0 || back > 64 || (known.below & bit(back)) != 0) return false;
        known.below |= bit(back);
        return true;
    }
    /// Stores the number of a received packet, like note(), for packets with numbers of 16 bits,
    /// which restart at 0 after 65535. Of all numbers that end with the 16 bits of `id`, the one
    /// nearest to the originator's highest number is stored.
    bool note16(NodeId originator, std::uint16_t id, Time now, Duration memory) {
        const Numbers* const known = of_.find(originator);
        const std::uint32_t highest = known ? known->highest : 0;
        const auto step = static_cast<std::int16_t>(id - static_cast<std::uint16_t>(highest));
        return note(originator, highest + static_cast<std::uint32_t>(step), now, memory);
    }
    void clear() { of_.clear(); }

    /// Fetches the numbers of an originator into the processor's cache; see NodeMap.
    void prefetch(NodeId originator) const { of_.prefetch(originator); }

  private:
    /// Numbers received from one originator: the highest number, and a bit mask of lower numbers.
    /// Bit k of `below` is set if the number highest - 1 - k was received.
    struct Numbers {
        NodeId originator;
        std::uint32_t highest;
        std::uint64_t below;
        Time last;
    };
    static std::uint64_t bit(std::uint32_t back) { return std::uint64_t{1} << (back - 1); }

    // Numbers of each originator.
    NodeMap<Numbers, &Numbers::originator> of_;
};

}  // namespace rovernet
