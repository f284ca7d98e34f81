// SPDX-License-Identifier: MIT
#pragma once

#include "models/medium/medium.hpp"
#include "sim/ids.hpp"
#include "sim/legs.hpp"
#include "sim/time.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace rovernet {

/// How many robots a chain of links joins to a sender: the number of Medium::reachable(), found
/// with less work, for when it is asked for with every message.
///
/// While nobody moves, answers are kept until a robot moves, is switched or added. Otherwise every
/// robot remembers from whom a chain reached it last: that link is looked at first, and only robots
/// that are not reached by such links are searched for. A robot counts as reached by links that are
/// up now and as not reached once all that could reach it have been looked at, so the number is
/// exact. Memory: 12 bytes a robot, once it is asked for.
class Reachability {
  public:
    /// Searches for those who hear a robot that are cheap, beside one for each frame sent: a run
    /// then spends on this number 0.1 s or so, and no more than on its frames.
    static constexpr std::uint64_t cheap_searches = 10'000;

    /// Nodes other than `from` that a chain of links joins to it at `t`, which must not decrease.
    /// @param medium, legs  always the same
    std::uint32_t count(Medium& medium, NodeId from, Time t, const Legs& legs);
    /// A chain of links joins `to` to `from` at `t`, which must not decrease.
    bool reaches(Medium& medium, NodeId from, NodeId to, Time t, const Legs& legs);
    std::uint64_t searches() const { return searches_; }  ///< for those who hear a robot, so far

  private:
    /// The network at the time of the question.
    struct Now {
        Medium& medium;
        const Legs& legs;
        Time t;
        NodeId from;
    };
    enum class State : std::uint32_t { open, tried, reached, cut };  ///< of a node, this round

    bool is_at_rest(const Now& now);
    void search(const Now& now);
    void reach(NodeId node) {
        set(node, State::reached);
        reached_.push_back(node);
    }
    State state(NodeId node) const {
        const std::uint32_t mark = marks_[node.index()];
        return mark / 4 == round_ ? static_cast<State>(mark % 4) : State::open;
    }
    void set(NodeId node, State state) {
        marks_[node.index()] = 4 * round_ + static_cast<std::uint32_t>(state);
    }
    void follow_parents(const Now& now);
    void list_open(const Now& now);
    void expand(const Now& now, NodeId node);
    void look_back(const Now& now);
    void join(NodeId reached, NodeId node, NodeId first);

    static constexpr std::uint32_t unknown = 0xffffffff;

    std::vector<std::uint32_t> answers_;            // by node, of those at rest
    std::uint64_t answers_of_ = ~std::uint64_t{0};  // Medium::changes() when they were found
    bool at_rest_ = false;                          // at that time
    NodeId mover_{};                                // a robot that moved lately
    std::vector<NodeId> parents_;       // by node: who reached it last; itself: nobody yet
    std::vector<std::uint32_t> marks_;  // by node: 4 x round + State
    std::uint32_t round_ = 0;
    std::uint64_t searches_ = 0;
    std::vector<NodeId> reached_;  // in the order in which they were ...
    std::size_t expanded_ = 0;     // ... the first of them have been looked from
    std::vector<NodeId> open_;     // nodes that are not reached
    std::vector<NodeId> path_;     // what is under work, kept for its memory
};

}  // namespace rovernet
