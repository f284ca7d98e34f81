// SPDX-License-Identifier: MIT
#pragma once

#include "models/access/access.hpp"

namespace rovernet {

/// Access model "none": frames go out at once, even over one another.
struct NoAccess {
    static constexpr std::string_view name = "none";

    std::unique_ptr<Access> make_access() const { return std::make_unique<AtOnce>(); }

  private:
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
