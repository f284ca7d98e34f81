// SPDX-License-Identifier: MIT
#include "experiment/playing.hpp"

#include <cstdint>

namespace rovernet {

void play_until(Network& network, Time end, const TellTime& tell) {
    if (!tell) return network.run_until(end);
    constexpr std::uint64_t events_a_slice = 256;
    tell(network.now());
    while (!network.advance(end, events_a_slice)) tell(network.now());
}

}  // namespace rovernet
