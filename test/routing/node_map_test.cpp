// SPDX-License-Identifier: MIT
// Map from nodes to values, beside std::map.
#include "routing/node_map.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <map>
#include <random>

namespace node_map_test {
using namespace rovernet;

struct Value {
    NodeId node;
    std::uint32_t number = 0;
};

TEST_CASE(
    "node map: after random inserts and removals, a node map has the same contents as a std::map") {
    std::mt19937 random{7};
    NodeMap<Value, &Value::node> map;
    std::map<std::uint32_t, std::uint32_t> expected;
    for (std::uint32_t step = 0; step < 20'000; ++step) {
        // 300 nodes: many share a remainder, so many indices of the last find are of other nodes.
        const NodeId node{static_cast<std::uint32_t>(random() % 300)};
        Value* const found = map.find(node);
        const auto known = expected.find(node.value);
        REQUIRE((found != nullptr) == (known != expected.end()));
        if (found) {
            REQUIRE(found->node == node);
            REQUIRE(found->number == known->second);
        }
        switch (random() % 4) {
            case 0:
                map.erase(node);
                expected.erase(node.value);
                break;
            case 1:
                if (step % 100 == 0) {
                    map.erase_if([](const Value& each) { return each.node.value % 3 == 0; });
                    std::erase_if(expected, [](const auto& each) { return each.first % 3 == 0; });
                }
                break;
            default:
                if (!found) {
                    CHECK(map.insert({node, step}).node == node);
                    expected[node.value] = step;
                }
        }
    }
    REQUIRE(map.values().size() == expected.size());
    auto next = expected.begin();
    for (const Value& each : map.values()) {  // in the order of ids
        CHECK(each.node.value == next->first);
        CHECK(each.number == (next++)->second);
    }
}

}  // namespace node_map_test
