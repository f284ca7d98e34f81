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

/// Tells of links that come and go, if somebody wants to know. Costs nothing otherwise.
class LinkMonitor {
  public:
    explicit LinkMonitor(World& world) : world_(world) {}

    /// Somebody wants to know, from now on or from the beginning of the run.
    void want() { wanted_ = true; }
    /// Looks at all links if they are wanted; from then on it has to be told of every change.
    void begin();
    /// The node was added; its leg or its radio has changed.
    void added(NodeId node);
    void look_at(NodeId node);
    /// Serves the event of link changes.
    void change_links();
    /// Calls react(from) whenever `node` cannot hear `from` any more.
    void on_link_lost(NodeId node, Callback<NodeId> react);

  private:
    void expect_change();
    void tell_lost(NodeId node, NodeId from);

    World& world_;
    bool wanted_ = false;
    std::optional<LinkWatch> watch_;  // once links are wanted and the run has begun
    Time expected_ = never;           // the next change queued
    std::map<NodeId, std::vector<Callback<NodeId>>> on_lost_;
};

}  // namespace rovernet
