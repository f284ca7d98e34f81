// SPDX-License-Identifier: MIT
#pragma once

#include "models/phy/wifi.hpp"
#include "sim/ids.hpp"
#include "sim/message.hpp"
#include "sim/record.hpp"
#include "sim/time.hpp"

#include <cstdint>
#include <optional>

namespace rovernet {

/// A frame that waits for access to the medium.
struct QueuedFrame {
    Frame frame;
    std::optional<NodeId> heard_from;  ///< who the sender received it from, if it forwards it
};

/// What an access rung may do. Implemented by the Network.
class Air {
  public:
    virtual Time now() const = 0;
    /// Puts a frame on air now; returns when it ends at its sender.
    virtual Time transmit(const AirFrame& frame) = 0;
    /// How long a frame is on air [ns], and how large it is then [bytes]. An ACK for everyone is
    /// the longest that anybody sends.
    virtual Duration airtime(const AirFrame& frame) const = 0;
    virtual std::uint32_t bytes(const AirFrame& frame) const = 0;
    /// Calls the rung's on_timer(node, tag) at `at`.
    virtual void access_timer(NodeId node, Time at, std::uint32_t tag) = 0;
    /// A uniform draw in (0, 1) of the node's own access, its `index`-th.
    virtual double access_draw(NodeId node, std::uint64_t index) const = 0;
    /// The frame left the queue: it was sent (and answered, if it had to be), or it was given up.
    virtual void sent(const QueuedFrame& frame) = 0;
    virtual void lost(const QueuedFrame& frame, DropReason reason) = 0;

  protected:
    ~Air() = default;
};

}  // namespace rovernet
