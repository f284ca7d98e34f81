// SPDX-License-Identifier: MIT
#pragma once

#include "routing/node_map.hpp"
#include "sim/ids.hpp"
#include "sim/message.hpp"
#include "sim/time.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace rovernet {

/// Entry of a node's routing table for one destination.
struct Route {
    NodeId destination;
    NodeId next_hop = everyone;
    /// Sequence number of the destination, if `has_number`.
    std::uint32_t number = 0;
    /// Number of hops to the destination; of a broken route, the number before the route broke.
    Hops hops = 0;
    bool has_number = false;
    /// Whether packets may be sent along the route, until `until`.
    bool is_valid = false;
    /// Time at which a valid route expires, or at which a broken route is deleted.
    Time until = start_of_run;
    /// Time at which the route was learnt.
    Time since = start_of_run;
};

/// Routing table of a node, with the neighbours that use each route (precursors). Routes expire
/// without timers: an entry is updated when it is accessed. A valid route that has expired becomes
/// a broken route with the next sequence number (RFC 3561, 6.1); a broken route is deleted after
/// `delete_period`.
class RouteTable {
  public:
    /// Entry for a destination, updated to `now`; null if there is none. The pointer is valid until
    /// the next call of find(), add() or for_each().
    Route* find(NodeId destination, Time now, Duration delete_period);
    /// Entry for a destination, updated to `now`; a new entry if there was none. See find().
    Route& add(NodeId destination, Time now, Duration delete_period);
    /// Calls visit(route) for each entry, updated to `now`, in the order of destinations.
    template <class Visit>
    void for_each(Time now, Duration delete_period, Visit visit) {
        clean(now, delete_period);
        for (Route& route : routes_.values()) visit(route);
    }
    /// Entries as stored, in the order of destinations, including expired routes not yet updated.
    std::span<const Route> stored() const { return routes_.values(); }

    /// Adds a neighbour that uses the route to a destination, if the table has an entry for this
    /// route.
    void add_precursor(NodeId destination, NodeId neighbour);
    /// Neighbours that use the route to a destination, each once, in the order of ids.
    std::vector<NodeId> precursors(NodeId destination) const;
    void clear_precursors(NodeId destination);
    void clear() { routes_.clear(), precursors_.clear(); }

    /// Fetches the entry for a destination into the processor's cache; see NodeMap.
    void prefetch(NodeId destination) const { routes_.prefetch(destination); }

  private:
    struct Precursor {
        NodeId destination, neighbour;
        friend auto operator<=>(const Precursor&, const Precursor&) = default;
    };
    /// Updates an entry to `now`: an expired valid route becomes a broken route.
    /// @return whether the entry remains; false if its broken route has expired, too
    static bool is_kept(Route& route, Time now, Duration delete_period);
    void clean(Time now, Duration delete_period);

    // Routes by destination; precursors in the order of destinations, then neighbours.
    NodeMap<Route, &Route::destination> routes_;
    std::vector<Precursor> precursors_;
};

}  // namespace rovernet
