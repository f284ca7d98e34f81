// SPDX-License-Identifier: MIT
#include "traces/row_sink.hpp"

#include "models/medium/medium.hpp"
#include "network/network.hpp"
#include "routing/flood.hpp"
#include "test/traces/record_stream.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

namespace row_sink_test {
using namespace rovernet;
using namespace rovernet::testing;
using namespace std::chrono_literals;

namespace {

std::string text(const CodeCell& cell) {
    std::string letters;
    for (const char32_t letter : cell) {
        if (letter != 0) letters += static_cast<char>(letter);
    }
    return letters;
}

/// A number of a table by its column's name, as a reader without these structs would find it.
template <class T>
T cell(const RowSink::Table& table, std::size_t row, std::string_view name) {
    T value{};
    for (const RowColumn& column : table.columns) {
        if (column.name != name) continue;
        std::memcpy(&value, table.bytes.data() + row * table.row_size + column.offset,
                    sizeof value);
        return value;
    }
    FAIL("no column " << name);
    return value;
}

constexpr NodeId a{0}, b{1}, c{2};

}  // namespace

TEST_CASE(
    "rows: each record gives one row, but a record of receptions gives one row per reception") {
    const auto rows = std::make_shared<RowSink>(kind_all);
    Stream stream;
    stream.sinks = {rows};
    for (int i = 0; i < 3; ++i) stream.place(Vec3{10.0 * i, 0, 0});
    const auto m = stream.send(at(1'000), a, 2, 64, 3);
    stream.transmit(at(1'000), frame(m, a, 2, 1));
    stream.transmit(at(2'500), frame(m, b, 1, 2), a);
    stream.receive(frame(m, b, 1, 2),
                   {{at(3'000), a, Fate::duplicate, false}, {at(3'100), c, Fate::ttl, true}});

    const RowSink::Table sent = rows->table(kind_of<Sent>());
    REQUIRE(sent.size() == 1);
    CHECK(cell<std::int64_t>(sent, 0, "t_ns") == at(1'000).time_since_epoch().count());
    CHECK(cell<std::int32_t>(sent, 0, "robot") == 0);
    CHECK(cell<std::int32_t>(sent, 0, "to") == -1);
    CHECK(cell<std::int32_t>(sent, 0, "size") == 64);
    CHECK(cell<std::int32_t>(sent, 0, "ttl") == 2);
    const RowSink::Table transmitted = rows->table(kind_of<Transmitted>());
    REQUIRE(transmitted.size() == 2);
    CHECK(cell<std::int32_t>(transmitted, 0, "heard_from") == -1);
    CHECK(cell<std::int32_t>(transmitted, 1, "heard_from") == 0);
    CHECK(cell<std::int32_t>(transmitted, 1, "robot") == 1);
    CHECK(cell<std::int32_t>(transmitted, 1, "next_hop") == -1);
    const RowSink::Table received = rows->table(kind_of<Received>());
    REQUIRE(received.size() == 2);
    CHECK(text(cell<CodeCell>(received, 0, "reason")) == "DUP");
    CHECK_FALSE(cell<bool>(received, 0, "delivered"));
    CHECK(std::isnan(cell<double>(received, 0, "level")));
    CHECK(cell<std::int64_t>(received, 1, "t_ns") == at(3'100).time_since_epoch().count());
    CHECK(cell<std::int32_t>(received, 1, "robot") == 2);
    CHECK(cell<std::int32_t>(received, 1, "sender") == 1);
    CHECK(cell<std::int32_t>(received, 1, "origin") == 0);
    CHECK(cell<std::int32_t>(received, 1, "hops") == 2);
    CHECK(text(cell<CodeCell>(received, 1, "reason")) == "TTL");
    CHECK(cell<bool>(received, 1, "delivered"));
}

TEST_CASE("rows: the rows of each kind of record have the expected columns and cell formats") {
    const char* const expected[] = {
        "t_ns<i8 robot<i4 uid<i8 to<i4 size<i4 flow<i4 ttl<i4",
        "t_ns<i8 robot<i4 uid<i8 origin<i4 heard_from<i4 next_hop<i4 ttl<i4 hops<i4",
        "t_ns<i8 robot<i4 uid<i8 origin<i4 sender<i4 ttl<i4 hops<i4 level<f8 reason<U4 delivered?",
        "t_ns<i8 robot<i4 uid<i8 origin<i4 sender<i4 ttl<i4 hops<i4 reason<U4",
        "t_ns<i8 end_ns<i8 robot<i4 x<f8 y<f8 z<f8 vx<f8 vy<f8 vz<f8 heading<f8 turning<f8",
        "t_ns<i8 robot<i4",
        "t_ns<i8 robot<i4 x<f8 y<f8 z<f8",
        "t_ns<i8 robot<i4 on?",
        "t_ns<i8 robot<i4 sender<i4",
        "t_ns<i8 robot<i4 sender<i4",
        "t_ns<i8 robot<i4 next_hop<i4 kind<U4 attempt<i4 bytes<i4 reserved_ns<i8",
        "t_ns<i8 robot<i4 sender<i4 kind<U4 bytes<i4 reason<U4",
    };
    const RowSink rows(kind_all);
    for (std::size_t kind = 0; kind < std::size(expected); ++kind) {
        const RowSink::Table table = rows.table(KindMask{1} << kind);
        std::string columns;
        for (const RowColumn& column : table.columns) {
            columns += (columns.empty() ? "" : " ") + column.name + std::string(column.format);
        }
        CHECK(columns == expected[kind]);
    }
}

TEST_CASE(
    "rows: the robot in a link's row is the receiver; a movement's row has the position at the "
    "row's time") {
    const auto rows = std::make_shared<RowSink>(kind_all);
    Stream stream;
    stream.sinks = {rows};
    stream.emit(LinkUp{at(5), a, b});
    stream.emit(
        Moved{at(2'000'000'000), c, Leg{.start = at(1'000'000'000), .velocity = {3, 0, 0}}});
    const RowSink::Table up = rows->table(kind_of<LinkUp>());
    REQUIRE(up.size() == 1);
    CHECK(cell<std::int32_t>(up, 0, "robot") == 1);
    CHECK(cell<std::int32_t>(up, 0, "sender") == 0);
    const RowSink::Table moved = rows->table(kind_of<Moved>());
    REQUIRE(moved.size() == 1);
    CHECK(cell<double>(moved, 0, "x") == 3);
    CHECK(cell<double>(moved, 0, "vx") == 3);
}

TEST_CASE("rows: the cells of a table have the values of the records") {
    const auto rows = std::make_shared<RowSink>(kind_of<Received>() | kind_of<Moved>());
    Network network;
    network.add_sink(rows);
    const NodeId sender = network.add({.name = "A", .at = {0, 0}});
    network.add({.name = "B", .at = {100, 0}});
    network.route(Flood{.ttl = 1});
    network.at(start_of_run + 1s, [&] { network.send(sender, everyone, "hello"); });
    network.run_for(2s);

    const RowSink::Table received = rows->table(kind_of<Received>());
    REQUIRE(received.size() == 1);
    CHECK(cell<std::int32_t>(received, 0, "robot") == 1);
    CHECK(cell<bool>(received, 0, "delivered"));
    CHECK(text(cell<CodeCell>(received, 0, "reason")) == "TTL");
    // Free space at 100 m and 2450 MHz: 20 log10(4 pi d f / c) = 80.23 dB.
    constexpr double half_a_digit = 0.005;
    const double level = network.medium().stations().radio(sender).power.value - 80.23;
    CHECK(std::abs(cell<double>(received, 0, "level") - level) < half_a_digit);
    const RowSink::Table moved = rows->table(kind_of<Moved>());
    REQUIRE(moved.size() == 2);
    CHECK(cell<double>(moved, 1, "x") == 100);
    CHECK(cell<std::int64_t>(moved, 1, "end_ns") == -1);
    CHECK(rows->table(kind_of<Sent>()).size() == 0);
    rows->clear();
    CHECK(rows->table(kind_of<Moved>()).size() == 0);
}

TEST_CASE("rows: a kind of record is found by its name, and a misspelt name is refused") {
    CHECK(record_named("sent") == kind_of<Sent>());
    CHECK(record_named("no_way") == kind_of<NoWay>());
    CHECK(record_named("control_received") == kind_of<ControlReceived>());
    try {
        record_named("recieved");
        FAIL("accepted");
    } catch (const std::invalid_argument& error) {
        CHECK(std::string(error.what()).ends_with("did you mean \"received\"?"));
    }
}

}  // namespace row_sink_test
