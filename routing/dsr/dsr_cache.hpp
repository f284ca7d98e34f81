// SPDX-License-Identifier: MIT
#pragma once

#include "routing/dsr/dsr_path.hpp"
#include "sim/ids.hpp"
#include "sim/time.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace rovernet::dsr {

/// Path cache of a node (RFC 4728, 4.1): routes that begin at the node. Every beginning of a stored
/// route is also a route. Routes have no timeout: a route ends if one of its links is reported as
/// broken, or is removed if it is the oldest one and the cache is full.
class Cache {
  public:
    /// Origin of a route: the answer to the node's own request (own), or forwarded or overheard
    /// packets of other nodes (others).
    enum class Origin { own, others };
    struct Known {
        Path path;
        Time since;
    };

    /// Adds a route of at least one hop, unless the cache contains the route.
    void add(const Path& path, Origin origin, Time now);
    /// Removes a broken link: each route that contains the link is cut off at node `from`.
    void remove_link(NodeId from, NodeId to);
    /// Shortest route to `destination`, of equal ones the first in own(), then in others(); empty
    /// if no route is known.
    std::optional<Path> find(NodeId destination) const;
    /// Stored routes of Origin::own, and of Origin::others; oldest first.
    std::span<const Known> own() const { return own_; }
    std::span<const Known> others() const { return others_; }

  private:
    // Stored routes of each Origin, oldest first; at most 30 and 64, as in ns-2.
    std::vector<Known> own_, others_;
};

}  // namespace rovernet::dsr
