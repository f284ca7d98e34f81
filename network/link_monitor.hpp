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

/// Monitor of links that go up and down. It works only if a sink wants LinkUp or LinkDown, or if a
/// callback for lost links exists; otherwise it costs the test of a bit.
///
/// It predicts the next change (LinkWatch) and queues an event for it. Changes of legs and radios
/// cause a new prediction. Records are emitted at the instant of a change, to the nanosecond if the
/// loss depends on distance; callbacks run 1 us later.
class LinkMonitor {
  public:
    explicit LinkMonitor(World& world) : world_(world) {}

    /// Requests link changes, from now on or from the start of the run.
    void want() { wanted_ = true; }
    /// Searches all links, if link changes are requested and this was not done yet; after that
    /// every change must be reported to the monitor. Engine calls it whenever the run continues.
    void begin();
    /// Adds a node, whose links are monitored from now on.
    void added(NodeId node);
    /// Updates the links of a node whose leg or radio has changed now.
    void look_at(NodeId node);
    /// Updates all links after a scene change now.
    void scene_changed();
    /// Handles the queued event of a link change. Emits LinkUp and LinkDown. Queues the callbacks
    /// of on_link_lost() for 1 us later, in the order of the key of the node that lost the link,
    /// then of the key of the node that it cannot hear any more (see World::key).
    void change_links();
    /// Calls react(from) whenever `node` cannot hear `from` any more.
    void on_link_lost(NodeId node, Callback<NodeId> react);

  private:
    // Queues an event for the next change, unless an earlier or equal one is queued.
    void expect_change();
    // Queues the node's reaction to a lost link.
    void tell_lost(NodeId node, NodeId from);

    World& world_;
    bool wanted_ = false;
    // State of all links, once they are requested and the run has begun.
    std::optional<LinkWatch> watch_;
    // Time of the next valid event; earlier events are void.
    Time expected_ = never;
    // Callbacks, by the node that hears.
    std::map<NodeId, std::vector<Callback<NodeId>>> on_lost_;
};

}  // namespace rovernet
