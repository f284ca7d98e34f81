// SPDX-License-Identifier: MIT
#pragma once

#include "sim/ids.hpp"
#include "sim/legs.hpp"
#include "sim/time.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

// The metric `reach` needs to know, with every message, how many robots any protocol could bring it
// to. A search of the whole network for each message would cost more than the messages.

namespace rovernet {

class Medium;
class Scene;

/// Number of robots that a chain of links joins to a sender, for when it is asked for with every
/// message. Applications have one.
///
/// While nobody moves, answers are kept until a robot moves, is switched or added. Otherwise every
/// robot remembers from whom a chain reached it last: that link is looked at first, and only robots
/// that are not reached by such links are searched for. A robot counts as reached by links that are
/// up now and as not reached once all that could reach it have been looked at, so the number is
/// exact. It takes 12 bytes a robot, once it is asked for.
class Reachability {
  public:
    /// Number of searches for those who hear a robot that are cheap, beside one for each frame
    /// sent: a run then spends on this number 0.1 s or so, and no more than on its frames.
    static constexpr std::uint64_t cheap_searches = 10'000;

    /// Number of nodes other than `from` that a chain of links joins to it at `t`, which must not
    /// decrease.
    /// @param medium, legs  always the same
    std::uint32_t count(Medium& medium, NodeId from, Time t, const Legs& legs);
    /// Number of those nodes, searched for anew: slow, for tests.
    static std::uint32_t count_anew(Medium& medium, NodeId from, Time t, const Legs& legs);
    /// Whether a chain of links joins `to` to `from` at `t`, which must not decrease. Their own
    /// link is looked at first.
    bool reaches(Medium& medium, NodeId from, NodeId to, Time t, const Legs& legs);
    /// Searches for those who hear a robot, so far.
    std::uint64_t searches() const { return searches_; }

  private:
    // Network at the time of the question.
    struct Now {
        Medium& medium;
        const Legs& legs;
        Time t;
        NodeId from;
    };
    // State of a node in this round: not looked at; its remembered links were looked at; joined;
    // cut off.
    enum class State : std::uint32_t { open, tried, reached, cut };

    // Whether nobody moves.
    bool is_at_rest(const Now& now);
    // Finds all nodes that are joined to the sender.
    void search(const Now& now);
    // Notes that a node is joined.
    void reach(NodeId node) {
        set(node, State::reached);
        reached_.push_back(node);
    }
    // State of a node; open if nobody has set it in this round.
    State state(NodeId node) const {
        const std::uint32_t mark = marks_[node.index()];
        return mark / 4 == round_ ? static_cast<State>(mark % 4) : State::open;
    }
    void set(NodeId node, State state) {
        marks_[node.index()] = 4 * round_ + static_cast<std::uint32_t>(state);
    }
    // Joins nodes by the links that they remember.
    void follow_parents(const Now& now);
    // Makes open_ the nodes that are on and not joined.
    void list_open(const Now& now);
    // Joins those that hear a node that is joined.
    void expand(const Now& now, NodeId node);
    // Looks from the nodes that are not joined, where links go both ways: a part of the network
    // that hears nobody who is joined is cut off.
    void look_back(const Now& now);
    // Joins a chain of nodes by the link to its last.
    void join(NodeId reached, NodeId node, NodeId first);

    static constexpr std::uint32_t unknown = 0xffffffff;

    // Answers by node, while nobody moves.
    std::vector<std::uint32_t> answers_;
    // Medium::changes() when they were found, and the scene then.
    std::pair<std::uint64_t, const Scene*> answers_of_{~std::uint64_t{0}, nullptr};
    // Whether nobody moved then.
    bool at_rest_ = false;
    // Robot that moved lately: looked at first, whether it still does.
    NodeId mover_{};
    // Node that reached each one last; itself: nobody yet.
    std::vector<NodeId> parents_;
    // Marks by node: 4 x round + State.
    std::vector<std::uint32_t> marks_;
    std::uint32_t round_ = 0;
    std::uint64_t searches_ = 0;
    // Nodes that are joined, in the order in which they were.
    std::vector<NodeId> reached_;
    // Number of them that have been looked from.
    std::size_t expanded_ = 0;
    // Nodes that are not joined.
    std::vector<NodeId> open_;
    // Nodes under work, kept for their memory.
    std::vector<NodeId> path_;
};

}  // namespace rovernet
