// SPDX-License-Identifier: MIT
#pragma once

#include "sim/ids.hpp"
#include "sim/message.hpp"
#include "sim/time.hpp"

#include <algorithm>
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
    /// Hops to the destination; of a broken route as they were.
    Hops hops = 0;
    bool has_number = false;
    /// Whether packets may be sent along the route, until `until`.
    bool is_valid = false;
    /// End of the lifetime of a valid route; of a broken one the time at which it is deleted.
    Time until = start_of_run;
    /// Time at which the route was learnt.
    Time since = start_of_run;
};

/// Routing table of a node, with the neighbours that use each route (precursors). Lifetimes end
/// without timers: an entry is brought up to date when it is looked at. A valid route whose
/// lifetime is over becomes a broken one with the next sequence number (RFC 3561, 6.1), and a
/// broken one is deleted after `delete_period`.
class RouteTable {
  public:
    /// Entry for a destination, up to date; null if there is none. Valid until the next add().
    Route* find(NodeId destination, Time now, Duration delete_period);
    /// Entry for a destination, up to date; a new one if there was none.
    Route& add(NodeId destination, Time now, Duration delete_period);
    /// Calls visit(route) for each entry, up to date, in the order of destinations.
    template <class Visit>
    void for_each(Time now, Duration delete_period, Visit visit) {
        clean(now, delete_period);
        for (Route& route : routes_) visit(route);
    }
    /// Entries as they are stored, in the order of destinations; expired ones are among them.
    std::span<const Route> stored() const { return routes_; }

    /// Adds a neighbour that uses the route to a destination, if there is an entry for it.
    void add_precursor(NodeId destination, NodeId neighbour);
    /// Neighbours that use the route to a destination, in order, each once.
    std::vector<NodeId> precursors(NodeId destination) const;
    void clear_precursors(NodeId destination);
    void clear() { routes_.clear(), precursors_.clear(); }

  private:
    struct Precursor {
        NodeId destination, neighbour;
        friend auto operator<=>(const Precursor&, const Precursor&) = default;
    };
    /// Ends a lifetime that is over. @return whether the entry remains
    static bool is_kept(Route& route, Time now, Duration delete_period);
    void clean(Time now, Duration delete_period);
    std::vector<Route>::iterator place(NodeId destination) {
        return std::lower_bound(routes_.begin(), routes_.end(), destination,
                                [](const Route& r, NodeId node) { return r.destination < node; });
    }

    // In the order of destinations, and of neighbours.
    std::vector<Route> routes_;
    std::vector<Precursor> precursors_;
};

}  // namespace rovernet
