// SPDX-License-Identifier: MIT
#include "experiment/reports/link_graph.hpp"

#include <doctest/doctest.h>

namespace link_graph_test {
using namespace rovernet;

TEST_CASE("link graph: connected parts, cut vertices and the diameter are found") {
    // 0 - 1 - 2 - 3 and a triangle 4 5 6; 7 is alone.
    const LinkGraph graph = link_graph(8, {{1, 0}, {2, 1}, {3, 2}, {5, 4}, {6, 5}, {6, 4}});
    CHECK(graph.parts == std::vector<std::size_t>{0, 0, 0, 0, 1, 1, 1, 2});
    CHECK(graph.cut == std::vector<std::size_t>{1, 2});
    CHECK(graph.diameter == 3);
    CHECK(link_graph(2, {}).diameter == 0);
}

}  // namespace link_graph_test
