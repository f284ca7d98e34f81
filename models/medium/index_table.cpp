// SPDX-License-Identifier: MIT
#include "models/medium/index_table.hpp"

namespace rovernet {

void IndexTable::put(std::size_t i, NodeId node, std::uint32_t label, const Leg& leg) {
    const bool moves = leg.velocity != Vec3{};
    const Vec3 from = moves ? leg.from : leg.from + Vec3{};  // adds 0, as a leg does
    put(i, {from, node, label & 0x7fffffff, moves}, {leg.velocity, leg.start, leg.end});
}

void IndexTable::put(std::size_t i, const IndexEntry& entry, const Motion& motion) {
    entries[i] = entry;
    if (!entry.moves) return;
    if (motions.size() < entries.size()) motions.resize(entries.size());
    motions[i] = motion;
}

}  // namespace rovernet
