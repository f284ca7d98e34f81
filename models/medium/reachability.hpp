// SPDX-License-Identifier: MIT
#pragma once

#include "sim/ids.hpp"
#include "sim/legs.hpp"
#include "sim/time.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

// Computation for the metric `reach`, which needs, for every message, the number of robots that any
// protocol could reach. A search of the whole network for each message would cost more than the
// messages.

namespace rovernet {

class Medium;
class Scene;

/// Number of robots that a chain of links connects to a sender, for a query with every message.
/// Used by Applications.
///
/// While no robot moves, results are cached until a robot moves, is switched or added. Otherwise
/// every robot stores the robot by which a chain reached it last: that link is checked first, and
/// only robots not reached by such links are searched for. A robot counts as reached by links that
/// are up now, and as not reached once all robots that could reach it are checked, so the number is
/// exact. It takes 12 bytes per robot after the first query.
class Reachability {
  public:
    /// Number of searches for receivers that counts as cheap, in addition to one for each
    /// transmitted frame: with fewer searches, a run spends about 0.1 s on reachability, and no
    /// more than on its frames.
    static constexpr std::uint64_t cheap_searches = 10'000;

    /// Number of nodes other than `from` that a chain of links connects to it at `t`, which must
    /// not decrease.
    /// @param medium, legs  the same objects in every call
    std::uint32_t count(Medium& medium, NodeId from, Time t, const Legs& legs);
    /// Result of count() by a search without a cache: slow, for tests.
    static std::uint32_t count_anew(Medium& medium, NodeId from, Time t, const Legs& legs);
    /// Whether a chain of links connects `from` to `to` at `t`, which must not decrease. The direct
    /// link is checked first.
    bool reaches(Medium& medium, NodeId from, NodeId to, Time t, const Legs& legs);
    /// Number of searches for the receivers of a robot so far.
    std::uint64_t searches() const { return searches_; }

  private:
    // Network at the time of the query.
    struct Now {
        Medium& medium;
        const Legs& legs;
        Time t;
        NodeId from;
    };
    // State of a node in this round: not checked; stored link checked; reached; not reachable.
    enum class State : std::uint32_t { open, tried, reached, cut };

    // Whether no robot moves.
    bool is_at_rest(const Now& now);
    // Finds all nodes that a chain connects to the sender.
    void search(const Now& now);
    // Marks a node as reached.
    void reach(NodeId node) {
        set(node, State::reached);
        reached_.push_back(node);
    }
    // State of a node; `open` if it was not set in this round.
    State state(NodeId node) const {
        const std::uint32_t mark = marks_[node.index()];
        return mark / 4 == round_ ? static_cast<State>(mark % 4) : State::open;
    }
    void set(NodeId node, State state) {
        marks_[node.index()] = 4 * round_ + static_cast<std::uint32_t>(state);
    }
    // Marks nodes reached by their stored links.
    void follow_parents(const Now& now);
    // Lists the nodes that are on and not reached in open_.
    void list_open(const Now& now);
    // Marks the nodes that hear a reached node.
    void expand(const Now& now, NodeId node);
    // Searches from nodes that are not reached, if all links are bidirectional: a component that
    // hears no reached node is not reachable.
    void look_back(const Now& now);
    // Connects the chain from `first` to `node` to the reached nodes, by the link from `reached`.
    void join(NodeId reached, NodeId node, NodeId first);

    static constexpr std::uint32_t unknown = 0xffffffff;

    // Results by node, while no robot moves.
    std::vector<std::uint32_t> answers_;
    // Medium::changes() and the scene when these results were computed.
    std::pair<std::uint64_t, const Scene*> answers_of_{~std::uint64_t{0}, nullptr};
    // Whether no robot moved when the results were computed.
    bool at_rest_ = false;
    // Robot that moved last; checked first by is_at_rest().
    NodeId mover_{};
    // Node that last reached each node; the node itself if there is none.
    std::vector<NodeId> parents_;
    // Marks by node: 4 x round + State.
    std::vector<std::uint32_t> marks_;
    std::uint32_t round_ = 0;
    std::uint64_t searches_ = 0;
    // Reached nodes, in the order in which they were reached.
    std::vector<NodeId> reached_;
    // Number of reached nodes from which the search has continued.
    std::size_t expanded_ = 0;
    // Nodes that are not reached.
    std::vector<NodeId> open_;
    // Nodes of a chain; kept to reuse the memory.
    std::vector<NodeId> path_;
};

}  // namespace rovernet
