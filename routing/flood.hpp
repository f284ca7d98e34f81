// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fields.hpp"
#include "sim/router.hpp"
#include "sim/sieve.hpp"

#include <cstdint>
#include <string_view>
#include <vector>

namespace rovernet {

/// Treatment of the copies of a message that a node receives after the first one.
enum class Duplicates { suppress, forward };

template <>
struct EnumNames<Duplicates> {
    static constexpr std::array<std::string_view, 2> values = {"suppress", "forward"};
};

/// Flooding with a time-to-live: a message leaves its source with TTL k and travels at most k hops.
/// A receiver decrements the TTL and forwards the copy if the result is > 0, after 1 us + U(0,
/// jitter).
///
/// "suppress": each node forwards a message once; with `upgrade`, a later copy with a higher TTL
/// raises the TTL of the waiting copy, or replaces the copy not forwarded, so that a long path
/// heard first does not shorten the flood. "forward": every copy is forwarded, also by its source,
/// and only the TTL limits it: the rule of the 2007 thesis (docs/worlds.md), whose load grows with
/// the number of walks in the network.
struct Flood {
    static constexpr std::string_view name = "flood";

    int ttl = 3;  ///< initial TTL of a message [hops], 1 ... 65535
    Duplicates duplicates = Duplicates::suppress;
    bool upgrade = true;  ///< a later copy's higher TTL raises the waiting copy's TTL
    Duration jitter = std::chrono::milliseconds{10};  ///< longest random forwarding delay [ns]
    bool ttl_in_payload = false;  ///< the first byte of a payload is its TTL; 0 counts as 1

    static constexpr auto fields() {
        return describe(
            field("ttl", &Flood::ttl, Range{.low = 1, .high = 65535, .text = "from 1 to 65535"},
                  "hops that a message may cross"),
            field("duplicates", &Flood::duplicates, "what a node does with a second copy"),
            field("upgrade", &Flood::upgrade,
                  "under \"suppress\": a copy of higher TTL lifts the one not yet sent"),
            field("jitter", &Flood::jitter, Range{.low = 0, .high = 1e9, .text = "from 0 to 1e9 s"},
                  "upper end of the uniform delay before forwarding"),
            field("ttl_in_payload", &Flood::ttl_in_payload,
                  "the first byte of a payload is the message's TTL, as in the 2007 thesis"));
    }

    operator Router() const;
};

/// Routing protocol of a Flood. For each message in use it stores a bit per node, and four bytes
/// more if copies after the first one may be forwarded or raise a TTL.
class FloodRouter {
  public:
    /// @throws std::invalid_argument if a parameter is out of its range
    explicit FloodRouter(const Flood& flood);

    Hops initial_ttl() const { return static_cast<Hops>(flood_.ttl); }
    Hops initial_ttl(const Message& message) const;
    void send(LinkLayer& link, NodeId node, MessageId message);
    void on_receive(LinkLayer& link, const Frame& frame, std::span<Reception> receptions);
    void forget(MessageId message);

  private:
    /// State of a message at a node, from the copies received so far.
    class Knowledge {
      public:
        enum State : std::uint32_t { unheard, ended, waiting };
        Knowledge(State state = unheard, SendHandle copy = 0) : value_(state + copy) {}

        bool is(State state) const {
            return state == waiting ? value_ >= waiting : value_ == state;
        }
        /// Handle of the copy that waits to be forwarded, or has been; only in the state `waiting`.
        SendHandle copy() const { return value_ - waiting; }

      private:
        std::uint32_t value_;  // a State; from `waiting` on with the copy's handle added
    };

    /// State of one message in use, at all nodes.
    class Known {
      public:
        std::size_t size() const { return 64 * settled_.size(); }
        void resize(std::size_t nodes, bool later_copies_matter) {
            settled_.resize((nodes + 63) / 64);
            if (later_copies_matter) of_nodes_.resize(size());
        }
        /// Whether any further copy of the message is a duplicate for the node, whatever its TTL.
        bool is_settled(NodeId node) const {
            return settled_[node.index() / 64] >> node.index() % 64 & 1;
        }
        void settle(NodeId node) {
            settled_[node.index() / 64] |= std::uint64_t{1} << node.index() % 64;
        }
        /// State of the message at a node; only stored if later_copies_matter().
        Knowledge& operator[](NodeId node) { return of_nodes_[node.index()]; }

      private:
        // One bit for each node, so that the bits of a million nodes fit into a cache.
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
    /// Whether a copy of a message after the first one may be forwarded or raise a TTL.
    bool later_copies_matter() const { return forwards_all() || flood_.upgrade; }
    bool is_duplicate(LinkLayer& link, const Frame& frame, NodeId node, Known& known);
    void take(LinkLayer& link, const Frame& frame, Known& known, Reception& reception);
    SendHandle forward(LinkLayer& link, const Frame& frame, const Reception& reception);

    Flood flood_;
    std::vector<Known> known_;  // states by message
    Sieve<Reception*> news_;    // copies of one frame that are no duplicates; memory for reuse
};

}  // namespace rovernet
