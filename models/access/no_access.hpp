// SPDX-License-Identifier: MIT
#pragma once

#include "models/access/access.hpp"
#include "models/phy/wifi.hpp"
#include "sim/fields.hpp"

// No access control, the default of a network.

namespace rovernet {

/// Access model "none": a frame is transmitted immediately, even during another frame of the same
/// node. There are no queues, no carrier sensing and no retransmissions. "none" is the default, and
/// the fastest to simulate: only the reception model handles interference.
struct NoAccess {
    /// Name of the model in scenario files.
    static constexpr std::string_view name = "none";

    static constexpr auto fields() { return describe(); }

    /// Creates the access model for one Network.
    std::unique_ptr<Access> make_access() const { return std::make_unique<AtOnce>(); }

  private:
    // Access model that transmits every frame immediately; it has no state.
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
