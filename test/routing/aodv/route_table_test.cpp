// SPDX-License-Identifier: MIT
// Tables of routing protocols: routes with lifetimes and users, numbers of packets that were seen,
// packets that wait.
#include "routing/aodv/route_table.hpp"

#include "routing/seen_ids.hpp"
#include "routing/send_buffer.hpp"
#include "routing/sequence.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cstdint>
#include <set>
#include <vector>

namespace route_table_test {
using namespace rovernet;
using namespace std::chrono_literals;

namespace {

constexpr Time start = start_of_run;
constexpr NodeId a{1}, b{2}, c{3};

void make_valid(Route& route, Time until, std::uint32_t number = 7) {
    route.is_valid = route.has_number = true;
    route.number = number;
    route.until = until;
}

}  // namespace

TEST_CASE(
    "route table: an expired route gets the next sequence number, and is deleted some time later") {
    RouteTable table;
    make_valid(table.add(a, start, 10s), start + 5s);
    CHECK(table.find(a, start + 4999ms, 10s)->is_valid);
    const Route* broken = table.find(a, start + 9s, 10s);
    REQUIRE(broken);
    CHECK_FALSE(broken->is_valid);
    CHECK(broken->number == 8);
    CHECK(broken->until == start + 15s);  // from the end of its life on
    CHECK(table.find(a, start + 14s, 10s)->number == 8);
    CHECK_FALSE(table.find(a, start + 15s, 10s));
    CHECK(table.stored().empty());
}

TEST_CASE("route table: the list of a route's users is removed together with the route") {
    RouteTable table;
    table.add_precursor(a, b);  // no entry
    make_valid(table.add(a, start, 10s), start + 5s);
    CHECK(table.precursors(a).empty());
    table.add_precursor(a, c);
    table.add_precursor(a, b);
    table.add_precursor(a, c);
    CHECK(table.precursors(a) == std::vector<NodeId>{b, c});
    CHECK(table.precursors(b).empty());
    CHECK_FALSE(table.find(a, start + 60s, 10s));
    make_valid(table.add(a, start + 60s, 10s), start + 65s);
    CHECK(table.precursors(a).empty());
}

TEST_CASE("route table: expired routes are removed, so the table does not grow") {
    RouteTable table;
    for (std::uint32_t i = 0; i < 10'000; ++i) {
        const Time now = start + i * 1s;
        make_valid(table.add(NodeId{i}, now, 10s), now + 5s);
        table.add_precursor(NodeId{i}, b);
    }
    CHECK(table.stored().size() < 64);
    table.add(NodeId{0}, start + 10'000s, 10s);
    CHECK(table.precursors(NodeId{0}).empty());
}

TEST_CASE(
    "seen ids: each request id is new only once, even if ids come in mixed order or wrap around at "
    "2^32") {
    for (const std::uint32_t first : {0U, 0xffffffe0U, 0x7fffffe0U}) {
        SeenIds seen;
        std::set<std::uint32_t> noted;
        for (std::uint32_t i = 0; i < 200; ++i) {
            const std::uint32_t step = i * 37 % 61 + i / 61 * 61;  // 0 ... 60 shuffled, 61 ...
            const std::uint32_t id = first + step;
            CHECK(seen.note(a, id, start, 5s) == noted.insert(id).second);
            CHECK_FALSE(seen.note(a, id, start, 5s));
        }
        CHECK(noted.size() == 200);
    }
}

TEST_CASE(
    "seen ids: after a higher id, seen ids stay known, and an unseen id up to 64 lower counts as "
    "new") {
    for (const std::uint32_t step : {1U, 63U, 64U, 65U, 1000U}) {
        SeenIds seen;
        CHECK(seen.note(a, 100, start, 5s));
        CHECK(seen.note(a, 99, start, 5s));
        CHECK(seen.note(a, 100 + step, start, 5s));
        CHECK_FALSE(seen.note(a, 100 + step, start, 5s));
        CHECK_FALSE(seen.note(a, 100, start, 5s));
        CHECK(seen.note(a, 100 + step - 64, start, 5s) == (step != 63 && step != 64));
    }
}

TEST_CASE(
    "seen ids: ids are stored for each originator, and forgotten after a silence of the "
    "originator") {
    SeenIds seen;
    CHECK(seen.note(a, 9, start, 5s));
    CHECK(seen.note(b, 9, start, 5s));
    CHECK_FALSE(seen.note(a, 9, start + 5s, 5s));
    CHECK_FALSE(seen.note(a, 9, start + 10s, 5s));  // a duplicate is no silence
    CHECK(seen.note(a, 9, start + 15s + 1ns, 5s));
    CHECK(seen.note(a, 8, start + 15s + 1ns, 5s));
    CHECK_FALSE(seen.note(a, 9, start + 15s + 1ns, 5s));
    CHECK(seen.note(a, 10, start + 16s, 5s));
}

TEST_CASE(
    "send buffer: a full buffer drops its oldest packet; packets are taken by destination or "
    "expiry time") {
    SendBuffer buffer;
    const auto packet = [](NodeId to, std::uint32_t id, Duration until) {
        return SendBuffer::Packet{
            to, {.frame = {.message = MessageId{id}, .sender = c}}, start + until};
    };
    CHECK_FALSE(buffer.first_end());
    CHECK_FALSE(buffer.add(packet(a, 1, 9s), 3));
    CHECK_FALSE(buffer.add(packet(b, 2, 5s), 3));
    CHECK_FALSE(buffer.add(packet(a, 3, 7s), 3));
    CHECK(buffer.add(packet(b, 4, 8s), 3)->queued.frame.message == MessageId{1});
    CHECK(buffer.first_end() == start + 5s);
    CHECK(buffer.has(a));
    CHECK(buffer.take_expired(start + 5s).size() == 1);
    CHECK(buffer.first_end() == start + 7s);
    const auto taken = buffer.take(b);
    REQUIRE(taken.size() == 1);
    CHECK(taken[0].queued.frame.message == MessageId{4});
    CHECK(buffer.take_all().size() == 1);
    CHECK(buffer.packets().empty());
}

TEST_CASE("sequence numbers: a number is newer if it is ahead by less than half of all numbers") {
    CHECK(is_newer(1, 0));
    CHECK_FALSE(is_newer(0, 0));
    CHECK_FALSE(is_newer(0, 1));
    CHECK(is_newer(0, 0xffffffff));
    CHECK(is_newer(0x7fffffff, 0));
    CHECK_FALSE(is_newer(0x80000001, 0));
    CHECK(newest(3, 0xfffffff0) == 3);
    CHECK(newest(0xfffffff0, 3) == 3);
}

}  // namespace route_table_test
