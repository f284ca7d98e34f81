// SPDX-License-Identifier: MIT
#include "experiment/reports/link_graph.hpp"

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/biconnected_components.hpp>
#include <boost/graph/connected_components.hpp>
#include <boost/range/iterator_range.hpp>

#include <algorithm>
#include <iterator>

namespace rovernet {
namespace {

using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS>;

std::vector<std::size_t> connected_parts(const Graph& graph) {
    std::vector<std::size_t> part(boost::num_vertices(graph));
    boost::connected_components(graph, part.data());
    return part;
}

/// How many hops the farthest robot of a part with so many robots is away. The search ends once it
/// has found them all: where most are linked, it looks at the links of a few robots only.
int eccentricity(const Graph& graph, std::size_t from, std::size_t robots) {
    std::vector<int> hops(boost::num_vertices(graph), -1);
    std::vector<std::size_t> found{from};
    found.reserve(robots);
    hops[from] = 0;
    for (std::size_t next = 0; found.size() < robots; ++next) {
        const std::size_t at = found[next];
        for (const std::size_t to :
             boost::make_iterator_range(boost::adjacent_vertices(at, graph))) {
            if (hops[to] >= 0) continue;
            hops[to] = hops[at] + 1;
            found.push_back(to);
        }
    }
    return hops[found.back()];
}

/// The longest of the shortest ways between robots that are joined, in hops.
int diameter(const Graph& graph, const std::vector<std::size_t>& parts) {
    std::vector<std::size_t> robots(parts.size());
    for (const std::size_t part : parts) ++robots[part];
    int longest = 0;
    for (std::size_t from = 0; from < parts.size(); ++from) {
        longest = std::max(longest, eccentricity(graph, from, robots[parts[from]]));
    }
    return longest;
}

std::vector<std::size_t> articulation_points(const Graph& graph) {
    std::vector<std::size_t> cut;
    boost::articulation_points(graph, std::back_inserter(cut));
    std::sort(cut.begin(), cut.end());
    return cut;
}

}  // namespace

LinkGraph link_graph(std::size_t robots,
                     const std::vector<std::pair<std::uint32_t, std::uint32_t>>& links) {
    const Graph graph(links.begin(), links.end(), robots);
    std::vector<std::size_t> parts = connected_parts(graph);
    const int longest = diameter(graph, parts);
    return {std::move(parts), articulation_points(graph), longest};
}

}  // namespace rovernet
