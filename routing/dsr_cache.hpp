// SPDX-License-Identifier: MIT
#pragma once

#include "routing/dsr_path.hpp"
#include "sim/ids.hpp"
#include "sim/time.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace rovernet::dsr {

/// Routes that a node knows, each from the node itself: a path cache (RFC 4728, 4.1). Every
/// beginning of a route is a route, too. Routes have no timeout: they end as a link of theirs is
/// reported to be broken, or as others need their room.
class Cache {
  public:
    /// How a route was learnt: from the answer to the node's own request, or by forwarding or
    /// overhearing packets of others.
    enum class Origin { own, others };
    struct Known {
        Path path;
        Time since;
    };

    /// Adds a route of at least one hop, unless it is known.
    void add(const Path& path, Origin origin, Time now);
    /// Removes a link: routes end before it.
    void remove_link(NodeId from, NodeId to);
    /// Shortest route to a node, the first one that was learnt among equals; none if there is none.
    std::optional<Path> find(NodeId destination) const;
    /// Routes that are stored.
    std::span<const Known> own() const { return own_; }
    std::span<const Known> others() const { return others_; }

  private:
    // Routes of both origins, oldest first, as in ns-2: at most 30 and 64.
    std::vector<Known> own_, others_;
};

}  // namespace rovernet::dsr
