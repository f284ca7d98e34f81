// SPDX-License-Identifier: MIT
// What is queued before a key, and whom it concerns.
#include "sim/event_queue.hpp"
#include "sim/node_filter.hpp"
#include "sim/random.hpp"
#include "sim/scheduler.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>

using namespace rovernet;

namespace {

constexpr EventKey key_at(std::int64_t t, std::uint64_t sequence, Priority priority) {
    return {Time{Duration{t}}, priority, sequence, 0};
}

std::uint64_t roll(std::uint64_t index, std::uint64_t n) {
    return below({.purpose = Purpose::order, .index = index}, n);
}

}  // namespace

TEST_CASE("visit before: each key before another once, or the answer is that some may be missing") {
    std::size_t whole = 0, with_keys = 0, refused = 0;
    for (const std::uint64_t spread : {300U, 30'000U, 3'000'000U}) {
        EventQueue queue;
        std::set<EventKey> queued;
        for (std::uint64_t step = 0; step < 20'000; ++step) {
            const auto now = static_cast<std::int64_t>(3 * step);
            const auto delay = static_cast<std::int64_t>(roll(3 * step, spread));
            const bool ends = step % 3 == 0;  // of frames, nearly in order
            const EventKey key = ends ? key_at(now + 500 + delay % 50, step, Priority::frame_end)
                                      : key_at(now + delay, step, Priority::timer);
            queue.push(key);
            queued.insert(key);
            if (roll(3 * step + 1, 8) != 0 && queued.size() > 5) {
                REQUIRE(queue.top() == *queued.begin());
                queued.erase(queued.begin());
                queue.pop();
            }
            const auto ahead = static_cast<std::int64_t>(roll(3 * step + 2, spread / 10));
            const EventKey end = queue.top().at(queue.top().time() + Duration{ahead});
            std::set<EventKey> visited;
            const bool all = queue.visit_before(end, [&](EventKey each) {
                REQUIRE(visited.insert(each).second);
                return true;
            });
            const std::set<EventKey> expected(queued.begin(), queued.lower_bound(end));
            REQUIRE((all ? visited == expected
                         : std::includes(expected.begin(), expected.end(), visited.begin(),
                                         visited.end())));
            whole += all;
            with_keys += all && visited.size() > 3;
            refused += !all && expected.size() < 5;
            if (visited.empty()) continue;
            std::size_t calls = 0;
            CHECK_FALSE(queue.visit_before(end, [&](EventKey) { return ++calls < 1; }));
            CHECK(calls == 1);  // none after the one that was refused
        }
    }
    CHECK(whole > 20'000);
    CHECK(with_keys > 3'000);
    CHECK(refused < 3'000);
}

TEST_CASE(
    "visit before: a scheduler asks about the events that are live, up to the first refusal") {
    Scheduler<int> queue;
    const auto at = [](int t) { return Time{Duration{t}}; };
    for (int t = 10; t <= 50; t += 10) queue.schedule(at(t), Priority::timer, t);
    const auto cancelled = queue.schedule(at(25), Priority::timer, 25);
    const auto end = [](int t) { return EventKey{Time{Duration{t}}, Priority::timer, 0, 0}; };
    const auto all_below = [&](int limit, int t) {
        return queue.all_before(end(t), [&](int payload) { return payload < limit; });
    };
    CHECK(all_below(25, 25));
    CHECK_FALSE(all_below(25, 26));
    REQUIRE(queue.cancel(cancelled));
    CHECK(all_below(25, 26));
    CHECK(queue.all_before(end(30), [](int payload) { return payload == 10 || payload == 20; }));
    CHECK_FALSE(all_below(25, 31));
    CHECK(all_below(0, 10));
    CHECK(queue.next_key().time() == at(10));
    CHECK(Scheduler<int>{}.all_before(EventKey{}, [](int) { return false; }));
    CHECK(Scheduler<int>{}.next_key() == EventKey{});
}

TEST_CASE("node filter: has all that were added, few others, and none once they are removed") {
    NodeFilter filter;
    for (std::uint32_t round = 0; round < 50; ++round) {
        std::set<NodeId> nodes;
        while (nodes.size() < 12) {
            nodes.insert(NodeId{static_cast<std::uint32_t>(
                roll(100 * round + nodes.size(), std::uint64_t{1} << (8 + round % 24)))});
            if (nodes.size() < 12) nodes.insert(NodeId{static_cast<std::uint32_t>(nodes.size())});
        }
        for (const NodeId node : nodes) filter.add(node);
        for (const NodeId node : nodes) CHECK(filter.may_have(node));
        std::size_t others = 0;
        for (std::uint32_t id = 0; id < 100'000; ++id) {
            others += filter.may_have(NodeId{id}) && !nodes.contains(NodeId{id});
        }
        CHECK(others < 200);
        others = 0;
        for (const NodeId node : nodes) filter.remove(node);
        for (std::uint32_t id = 0; id < 100'000; ++id) others += filter.may_have(NodeId{id});
        CHECK(others == 0);
    }
}
