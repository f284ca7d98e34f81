// SPDX-License-Identifier: MIT
#pragma once

#include "models/access/access.hpp"

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

namespace rovernet {

/// How stations of ALOHA behave.
struct Aloha {
    static constexpr std::string_view name = "aloha";

    Duration slot{0};          ///< [ns] slotted: frames begin at its multiples; 0: pure
    std::uint32_t queue = 50;  ///< frames that wait at most; more are dropped

    std::unique_ptr<Access> make_access() const;
};

/// Access model "aloha": a frame goes out at once, or with the next slot, whatever others do;
/// only the own frames wait for one another.
///
/// Source: N. Abramson, The ALOHA system, AFIPS 1970; L. Roberts, ALOHA packet system with and
/// without slots and capture, 1975.
class AlohaAccess final : public Access {
  public:
    explicit AlohaAccess(const Aloha& settings) : settings_(settings) {}

    void add() override { stations_.emplace_back(); }
    void send(Air& air, const QueuedFrame& frame) override;
    void on_timer(Air& air, NodeId node, std::uint32_t tag) override;
    std::vector<QueuedFrame> take(NodeId node, NodeId next_hop) override;
    void switch_off(Air& air, NodeId node) override;

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
