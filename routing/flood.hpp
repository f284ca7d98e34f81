// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fields.hpp"
#include "sim/router.hpp"
#include "sim/sieve.hpp"

#include <cstdint>
#include <string_view>
#include <vector>

namespace rovernet {

/// Treatment of a second copy of a message.
enum class Duplicates { suppress, forward };

template <>
struct EnumNames<Duplicates> {
    static constexpr std::array<std::string_view, 2> values = {"suppress", "forward"};
};

/// Broadcast with a time-to-live: a message leaves its source with TTL k and crosses at most k
/// hops. A receiver decrements the TTL and forwards the copy if the result is > 0, after
/// 1 us + U(0, jitter).
///
/// "suppress": each node forwards a message once; with `upgrade`, a later copy with a higher TTL
/// lifts the copy that the node has not sent (yet), so that a long way heard first does not shorten
/// the flood. "forward": every copy is forwarded, also by its source, and only the TTL ends it: the
/// 2007 thesis's rule, whose load grows as the number of walks in the network.
struct Flood {
    static constexpr std::string_view name = "flood";

    int ttl = 3;  ///< [hops], 1 ... 65535
    Duplicates duplicates = Duplicates::suppress;
    bool upgrade = true;                              ///< a higher TTL lifts the waiting copy
    Duration jitter = std::chrono::milliseconds{10};  ///< [ns] upper end of the uniform delay

    static constexpr auto fields() {
        return describe(
            field("ttl", &Flood::ttl, Range{.low = 1, .high = 65535, .text = "from 1 to 65535"},
                  "hops that a message may cross"),
            field("duplicates", &Flood::duplicates, "what a node does with a second copy"),
            field("upgrade", &Flood::upgrade,
                  "under \"suppress\": a copy of higher TTL lifts the one not yet sent"),
            field("jitter", &Flood::jitter, Range{.low = 0, .high = 1e9, .text = "from 0 to 1e9 s"},
                  "upper end of the uniform delay before forwarding"));
    }

    operator Router() const;
};

/// The protocol that runs a Flood. While a copy of a message is left it keeps a bit per node for
/// it, and four bytes more if a copy after the first may matter.
class FloodRouter {
  public:
    /// @throws std::invalid_argument if a parameter is out of its range
    explicit FloodRouter(const Flood& flood);

    Hops initial_ttl() const { return static_cast<Hops>(flood_.ttl); }
    void send(LinkLayer& link, NodeId node, MessageId message);
    void on_receive(LinkLayer& link, const Frame& frame, std::span<Reception> receptions);
    void forget(MessageId message);

  private:
    /// Knowledge of a node: what it made of the copies that it heard so far.
    class Knowledge {
      public:
        enum State : std::uint32_t { unheard, ended, waiting };
        Knowledge(State state = unheard, SendHandle copy = 0) : value_(state + copy) {}

        bool is(State state) const {
            return state == waiting ? value_ >= waiting : value_ == state;
        }
        /// Handle of the copy that waits, or has waited, in the state `waiting`.
        SendHandle copy() const { return value_ - waiting; }

      private:
        std::uint32_t value_;  // a State; from `waiting` on with the copy's handle added
    };

    /// Knowledge of all nodes of one message.
    class Known {
      public:
        std::size_t size() const { return 64 * settled_.size(); }
        void resize(std::size_t nodes, bool later_copies_matter) {
            settled_.resize((nodes + 63) / 64);
            if (later_copies_matter) of_nodes_.resize(size());
        }
        /// Whether another copy is a duplicate for the node, whatever its TTL.
        bool is_settled(NodeId node) const {
            return settled_[node.index() / 64] >> node.index() % 64 & 1;
        }
        void settle(NodeId node) {
            settled_[node.index() / 64] |= std::uint64_t{1} << node.index() % 64;
        }
        /// Knowledge of a node; only if later copies matter.
        Knowledge& operator[](NodeId node) { return of_nodes_[node.index()]; }

      private:
        // A bit for each node: those of a million nodes stay in a cache.
        std::vector<std::uint64_t> settled_;
        std::vector<Knowledge> of_nodes_;
    };

    Known& known(const LinkLayer& link, MessageId message) {
        const std::size_t i = message.index(), nodes = link.size();
        if (i >= known_.size() || known_[i].size() < nodes) [[unlikely]]
            make_room(i, nodes);
        return known_[i];
    }
    void make_room(std::size_t message, std::size_t nodes);
    bool forwards_all() const { return flood_.duplicates == Duplicates::forward; }
    /// Whether copies matter that are not the first of their message.
    bool later_copies_matter() const { return forwards_all() || flood_.upgrade; }
    bool is_duplicate(LinkLayer& link, const Frame& frame, NodeId node, Known& known);
    void take(LinkLayer& link, const Frame& frame, Known& known, Reception& reception);
    SendHandle forward(LinkLayer& link, const Frame& frame, const Reception& reception);

    Flood flood_;
    std::vector<Known> known_;  // knowledge by message
    Sieve<Reception*> news_;    // under work, kept for its memory
};

}  // namespace rovernet
