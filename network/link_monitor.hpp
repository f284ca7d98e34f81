// SPDX-License-Identifier: MIT
#pragma once

#include "network/callback.hpp"
#include "network/link_watch.hpp"
#include "sim/ids.hpp"
#include "sim/time.hpp"

#include <map>
#include <optional>
#include <vector>

namespace rovernet {

struct World;

/// Monitor of links that come and go. It works only if somebody wants to know: a sink of LinkUp and
/// LinkDown, or a callback of a lost link. Otherwise it costs the test of a bit.
///
/// It looks ahead for the next change (LinkWatch) and queues an event for it. Changes of legs and
/// radios make it look again. Records come at the instant of a change, to the nanosecond where the
/// loss goes by distance; callbacks 1 us later.
class LinkMonitor {
  public:
    explicit LinkMonitor(World& world) : world_(world) {}

    /// Asks for link changes, from now on or from the beginning of the run.
    void want() { wanted_ = true; }
    /// Looks at all links if they are wanted and that was not done yet; from then on it has to be
    /// told of every change. Engine calls it whenever it goes on.
    void begin();
    /// Takes note of a node that was added.
    void added(NodeId node);
    /// Takes note that the node's leg or radio has changed just now.
    void look_at(NodeId node);
    /// Takes note that the scene has changed just now.
    void scene_changed();
    /// Serves the event of link changes: emits the records, and lets robots react 1 us later, in
    /// the order of their keys.
    void change_links();
    /// Calls react(from) whenever `node` cannot hear `from` any more.
    void on_link_lost(NodeId node, Callback<NodeId> react);

  private:
    // Queues an event for the next change, unless one is due no later.
    void expect_change();
    // Lets the node react to a link that it has lost.
    void tell_lost(NodeId node, NodeId from);

    World& world_;
    bool wanted_ = false;
    // All links, once they are wanted and the run has begun.
    std::optional<LinkWatch> watch_;
    // Time of the next event that is queued; earlier ones are void.
    Time expected_ = never;
    // Callbacks by the node that hears.
    std::map<NodeId, std::vector<Callback<NodeId>>> on_lost_;
};

}  // namespace rovernet
