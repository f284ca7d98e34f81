// SPDX-License-Identifier: MIT
#pragma once

#include "routing/managed.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace rovernet {

/// Routing protocol with the parameters of a Managed. For each message in use it stores eight bytes
/// per node. M1 to M6 in comments are rules of docs/methods/routing.md. A copy is called queued
/// while it waits for its send time, but not later, in the queue of the MAC.
class ManagedRouter {
  public:
    static constexpr bool wants_levels = true;
    static constexpr auto& roles = Managed::roles;

    /// @throws std::invalid_argument if a parameter is out of its range
    explicit ManagedRouter(const Managed& managed);

    Hops initial_ttl() const { return static_cast<Hops>(settings_.hop_limit + 1); }
    void send(LinkLayer& link, NodeId node, MessageId message);
    void on_receive(LinkLayer& link, const Frame& frame, std::span<Reception> receptions);
    void forget(MessageId message);

    /// Exponent CW of the contention window for a copy received with the signal to noise ratio
    /// `snr`: -20 ... 10 dB map to the whole numbers 3 ... 8 (M2).
    static int contention_window(Db snr);

  private:
    /// Stage of a message at a node. unheard: not heard yet. own: sent by the node itself. idle:
    /// heard, no copy queued. queued: a copy is queued. late: a copy is queued in the late window.
    enum class Stage : std::uint8_t { unheard, own, idle, queued, late };
    struct State {
        SendHandle copy = 0;
        Stage stage = Stage::unheard;
        /// Exponent of the contention window of the copy that the node holds back, and number of
        /// copies that the node has held back so far.
        std::uint8_t window = 0, copies = 0;
    };
    /// Reaction of a node to a copy: none, cancel its queued copy, move its queued copy to the late
    /// window, or relay the copy.
    enum class Act { ignore, cancel, move, relay };

    std::vector<State>& states(const LinkLayer& link, MessageId message);
    QueuedFrame* queued_copy(LinkLayer& link, MessageId message, NodeId node, State& mine) const;
    Act act(LinkLayer& link, const Frame& frame, NodeId node, State& mine) const;
    void relay(LinkLayer& link, const Frame& frame, Reception& reception, State& mine);
    void move(LinkLayer& link, const Reception& reception, State& mine);
    void queue(LinkLayer& link, const QueuedFrame& copy, const Reception& reception, int slots,
               State& mine);

    Managed settings_;
    std::vector<std::vector<State>> states_;  // state of each message at each node
    std::vector<Reception*> relays_, moves_;  // receptions of a frame with Act::relay, Act::move
};

}  // namespace rovernet
