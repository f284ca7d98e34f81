// SPDX-License-Identifier: MIT
#include "routing/aodv/route_table.hpp"

#include <algorithm>

namespace rovernet {

bool RouteTable::is_kept(Route& route, Time now, Duration delete_period) {
    if (route.until > now) return true;
    if (route.is_valid) {
        route.is_valid = false;
        route.number += route.has_number ? 1 : 0;
        route.until += delete_period;
    }
    return route.until > now;
}

Route* RouteTable::find(NodeId destination, Time now, Duration delete_period) {
    Route* const found = routes_.find(destination);
    if (!found || is_kept(*found, now, delete_period)) return found;
    routes_.erase(destination);
    clear_precursors(destination);
    return nullptr;
}

Route& RouteTable::add(NodeId destination, Time now, Duration delete_period) {
    if (Route* known = find(destination, now, delete_period)) return *known;
    if (routes_.is_full()) clean(now, delete_period);
    return routes_.insert({.destination = destination});
}

/// Brings all entries up to date, and removes those whose time is over.
void RouteTable::clean(Time now, Duration delete_period) {
    routes_.erase_if([&](Route& route) {
        if (is_kept(route, now, delete_period)) return false;
        clear_precursors(route.destination);
        return true;
    });
}

void RouteTable::add_precursor(NodeId destination, NodeId neighbour) {
    if (!routes_.find(destination)) return;
    const Precursor added{destination, neighbour};
    const auto at = std::lower_bound(precursors_.begin(), precursors_.end(), added);
    if (at == precursors_.end() || *at != added) precursors_.insert(at, added);
}

std::vector<NodeId> RouteTable::precursors(NodeId destination) const {
    std::vector<NodeId> neighbours;
    auto each =
        std::lower_bound(precursors_.begin(), precursors_.end(), Precursor{destination, NodeId{0}});
    for (; each != precursors_.end() && each->destination == destination; ++each) {
        neighbours.push_back(each->neighbour);
    }
    return neighbours;
}

void RouteTable::clear_precursors(NodeId destination) {
    std::erase_if(precursors_,
                  [&](const Precursor& each) { return each.destination == destination; });
}

}  // namespace rovernet
