// SPDX-License-Identifier: MIT
#pragma once

#include "models/access/access.hpp"
#include "models/phy/wifi.hpp"
#include "sim/fields.hpp"

// No access control, the default of a network.

namespace rovernet {

/// Access model "none": a frame is transmitted at once, even during another frame of the same node.
/// There are no queues, no carrier sensing and no retransmissions. The default, and the fastest to
/// simulate: interference is left to the reception model.
struct NoAccess {
    /// Name of the model in scenario files.
    static constexpr std::string_view name = "none";

    static constexpr auto fields() { return describe(); }

    /// Creates the access model for one Network.
    std::unique_ptr<Access> make_access() const { return std::make_unique<AtOnce>(); }

  private:
    // Access model without state.
    class AtOnce final : public Access {
      public:
        void send(Air& air, const QueuedFrame& frame) override {
            air.transmit({.frame = frame.frame, .heard_from = frame.heard_from});
            air.sent(frame);
        }
        bool queues() const override { return false; }
        Phy phy() const override { return Wifi{}; }
    };
};

}  // namespace rovernet
