// SPDX-License-Identifier: MIT
#pragma once

#include "models/access/access.hpp"

#include <cstdint>
#include <vector>

namespace rovernet {

/// How stations of ALOHA behave.
struct Aloha {
    Duration slot{0};          ///< [ns] slotted: frames begin at its multiples; 0: pure
    std::uint32_t queue = 50;  ///< frames that wait at most; more are dropped
};

/// The access rung "aloha": a frame goes out at once, or with the next slot, whatever others do;
/// only the own frames wait for one another.
///
/// Source: N. Abramson, The ALOHA system, AFIPS 1970; L. Roberts, ALOHA packet system with and
/// without slots and capture, 1975.
class AlohaAccess {
  public:
    explicit AlohaAccess(const Aloha& settings) : settings_(settings) {}

    void add() { stations_.emplace_back(); }
    void send(Air& air, const QueuedFrame& frame);
    void on_timer(Air& air, NodeId node);
    void switch_off(Air& air, NodeId node);

  private:
    struct Station {
        Time free_from = start_of_run;  // its own frame is over
        std::vector<QueuedFrame> queue = {};
    };
    void expect(Air& air, NodeId node);

    Aloha settings_;
    std::vector<Station> stations_;
};

}  // namespace rovernet
