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

/// Monitor of link changes: detects when a link between two robots goes up or down. The monitor
/// works only if a sink wants LinkUp or LinkDown, or if a callback for lost links exists. Otherwise
/// the cost is the test of a bit.
///
/// The monitor predicts the next link change (LinkWatch) and queues an event for the change.
/// Changes of legs and radios cause a new prediction. LinkUp and LinkDown are emitted at the time
/// of the change, to the nanosecond if the path loss depends on distance; callbacks run 1 us later.
class LinkMonitor {
  public:
    explicit LinkMonitor(World& world) : world_(world) {}

    /// Enables the monitor, from the next call of begin() on.
    void want() { wanted_ = true; }
    /// Begins to monitor: searches all links, if the monitor is enabled and has not begun. From
    /// then on every change of a leg, a radio or the scene must be reported to the monitor. Engine
    /// calls begin() whenever the run continues.
    void begin();
    /// Adds a node, whose links are monitored from now on.
    void added(NodeId node);
    /// Updates the links of a node whose leg or radio has changed now.
    void look_at(NodeId node);
    /// Updates all links after a scene change now.
    void scene_changed();
    /// Handles the queued event of a link change. Emits LinkUp and LinkDown. Queues the callbacks
    /// of on_link_lost() for 1 us later: ordered by the key (see World::key) of the node that lost
    /// the link, then by the key of the node at the transmitting end.
    void change_links();
    /// Calls react(from) 1 us after `node` has lost the link from `from`: `node` cannot hear `from`
    /// any more.
    void on_link_lost(NodeId node, Callback<NodeId> react);

  private:
    // Queues an event for the next link change, unless an event at that time or earlier is queued.
    void expect_change();
    // Queues the callbacks of `node` for the loss of the link from `from`.
    void tell_lost(NodeId node, NodeId from);

    World& world_;
    bool wanted_ = false;
    // State and next changes of all links; empty until the monitor has begun.
    std::optional<LinkWatch> watch_;
    // Time of the queued event for the next link change; events at other times are ignored.
    Time expected_ = never;
    // Callbacks for lost links, by the node at the receiving end of the link.
    std::map<NodeId, std::vector<Callback<NodeId>>> on_lost_;
};

}  // namespace rovernet
