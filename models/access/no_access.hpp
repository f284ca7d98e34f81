// SPDX-License-Identifier: MIT
#pragma once

#include "models/access/access.hpp"

// No access control: what a network does unless settings say otherwise.

namespace rovernet {

/// Access model "none": a frame goes on air at once, even over one of the same node. Nothing waits,
/// nobody listens, and a unicast is sent once. The default, and the lightest load on the computer:
/// what interferes is left to the reception model.
struct NoAccess {
    /// Word in files.
    static constexpr std::string_view name = "none";

    /// Model at work, for one Network.
    std::unique_ptr<Access> make_access() const { return std::make_unique<AtOnce>(); }

  private:
    // Model at work: it needs no state.
    class AtOnce final : public Access {
      public:
        void send(Air& air, const QueuedFrame& frame) override {
            air.transmit({.frame = frame.frame, .heard_from = frame.heard_from});
            air.sent(frame);
        }
        bool queues() const override { return false; }
    };
};

}  // namespace rovernet
