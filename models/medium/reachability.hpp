// SPDX-License-Identifier: MIT
#pragma once

#include "sim/ids.hpp"
#include "sim/legs.hpp"
#include "sim/time.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

// Computation for the metric `reach`. The metric needs, for every message, the number of robots
// that an ideal protocol could reach. A search of the whole network for each message would take
// more time than the simulation of the messages.

namespace rovernet {

class Medium;
class Scene;

/// Counter of the robots that a chain of links connects to a sender, for a query with every
/// message. Used by Applications.
///
/// While no robot moves, results are cached until a robot moves, is switched or added. Otherwise
/// every robot stores its parent, the robot by which a chain reached it last. The link from the
/// parent is checked first, and only robots that are not reached by such links are searched for. A
/// robot counts as reached only by links that are up now, and as not reached only if all robots
/// that could reach it are checked, so the number is exact. Memory: 12 bytes per robot after the
/// first query.
class Reachability {
  public:
    /// Number of searches for receivers that a run can afford for reachability, in addition to one
    /// search for each transmitted frame. These searches take at most about 0.1 s.
    static constexpr std::uint64_t cheap_searches = 10'000;

    /// Number of nodes other than `from` to which a chain of links leads from `from` at `t`, which
    /// must not decrease from call to call.
    /// @param medium, legs  the same objects in every call
    std::uint32_t count(Medium& medium, NodeId from, Time t, const Legs& legs);
    /// Result of count() by a search without a cache: slow, for tests.
    static std::uint32_t count_anew(Medium& medium, NodeId from, Time t, const Legs& legs);
    /// Whether a chain of links connects `from` to `to` at `t`, which must not decrease from call
    /// to call. The direct link is checked first.
    bool reaches(Medium& medium, NodeId from, NodeId to, Time t, const Legs& legs);
    /// Hops of the shortest chain of links from `from` to `to` at `t`; none if there is no chain.
    /// A search without a cache.
    static std::optional<std::uint32_t> shortest(Medium& medium, NodeId from, NodeId to, Time t,
                                                 const Legs& legs);
    /// Number of searches for the receivers of a robot so far.
    std::uint64_t searches() const { return searches_; }

  private:
    // Query of count() or reaches(): medium and legs of the nodes, current time, and sender.
    struct Now {
        Medium& medium;
        const Legs& legs;
        Time t;
        NodeId from;
    };
    // State of a node in a search. open: not checked. tried: link from its parent checked. reached:
    // a chain of links leads to the node. cut: no chain leads to the node.
    enum class State : std::uint32_t { open, tried, reached, cut };

    // Whether no robot moves at the time of the query.
    bool is_at_rest(const Now& now);
    // Marks as reached all nodes to which a chain of links leads from the sender now.from.
    void search(const Now& now);
    // Marks a node as reached.
    void reach(NodeId node) {
        set(node, State::reached);
        reached_.push_back(node);
    }
    // State of a node; `open` if it was not set in this search.
    State state(NodeId node) const {
        const std::uint32_t mark = marks_[node.index()];
        return mark / 4 == round_ ? static_cast<State>(mark % 4) : State::open;
    }
    void set(NodeId node, State state) {
        marks_[node.index()] = 4 * round_ + static_cast<std::uint32_t>(state);
    }
    // Marks the nodes that are reached by the links from their parents, if these are still up.
    void follow_parents(const Now& now);
    // Fills open_ with the nodes that are on and not reached.
    void list_open(const Now& now);
    // Marks as reached the nodes that can receive from the reached node `node`.
    void expand(const Now& now, NodeId node);
    // Searches for links from the nodes that are not reached to reached nodes. Used only if all
    // links are bidirectional. A connected group of nodes without such a link is not reachable.
    void look_back(const Now& now);
    // Updates parents_ after look_back() found a chain from `first` to `node` and a link from
    // `node` to the reached node `reached`: the chain is now traversed from `reached` to `first`.
    void join(NodeId reached, NodeId node, NodeId first);

    static constexpr std::uint32_t unknown = 0xffffffff;

    // Results of count() by node, while no robot moves; `unknown` if not computed.
    std::vector<std::uint32_t> answers_;
    // Value of Medium::changes(), and scene, at the time when answers_ was computed.
    std::pair<std::uint64_t, const Scene*> answers_of_{~std::uint64_t{0}, nullptr};
    // Whether no robot moved when the results in answers_ were computed.
    bool at_rest_ = false;
    // Robot that moved last; checked first by is_at_rest().
    NodeId mover_{};
    // Parent of each node: the node by which it was last reached; the node itself if there is none.
    std::vector<NodeId> parents_;
    // Marks by node: 4 x number of the search + State.
    std::vector<std::uint32_t> marks_;
    std::uint32_t round_ = 0;
    std::uint64_t searches_ = 0;
    // Reached nodes, in the order in which they were reached.
    std::vector<NodeId> reached_;
    // Number of nodes in reached_ whose receivers were searched, from the first on.
    std::size_t expanded_ = 0;
    // Nodes that are on and not reached.
    std::vector<NodeId> open_;
    // Nodes that look_back() has found from one node; kept to reuse the memory.
    std::vector<NodeId> path_;
};

}  // namespace rovernet
