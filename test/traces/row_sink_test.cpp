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

TEST_CASE("rows: each record of a flood by hand is a row, each reception one of its own") {
    const auto rows = std::make_shared<RowSink>(kind_all);
    Stream stream;
    stream.sinks = {rows};
    for (int i = 0; i < 3; ++i) stream.place(Vec3{10.0 * i, 0, 0});
    const auto m = stream.send(at(1'000), a, 2, 64, 3);
    stream.transmit(at(1'000), frame(m, a, 2, 1));
    stream.transmit(at(2'500), frame(m, b, 1, 2), a);
    stream.receive(frame(m, b, 1, 2),
                   {{at(3'000), a, Fate::duplicate, false}, {at(3'100), c, Fate::ttl, true}});

    REQUIRE(rows->of<SentRow>().size() == 1);
    const SentRow& sent = rows->of<SentRow>()[0];
    CHECK(sent.t_ns == at(1'000).time_since_epoch().count());
    CHECK(sent.robot == 0);
    CHECK(sent.to == -1);
    CHECK(sent.size == 64);
    CHECK(sent.ttl == 2);
    REQUIRE(rows->of<TransmittedRow>().size() == 2);
    CHECK(rows->of<TransmittedRow>()[0].heard_from == -1);
    CHECK(rows->of<TransmittedRow>()[1].heard_from == 0);
    CHECK(rows->of<TransmittedRow>()[1].next_hop == -1);
    REQUIRE(rows->of<ReceivedRow>().size() == 2);
    const ReceivedRow& lost = rows->of<ReceivedRow>()[0];
    const ReceivedRow& last = rows->of<ReceivedRow>()[1];
    CHECK(text(lost.reason) == "DUP");
    CHECK_FALSE(lost.delivered);
    CHECK(std::isnan(lost.level));
    CHECK(last.t_ns == at(3'100).time_since_epoch().count());
    CHECK(last.robot == 2);
    CHECK(last.sender == 1);
    CHECK(last.origin == 0);
    CHECK(last.hops == 2);
    CHECK(text(last.reason) == "TTL");
    CHECK(last.delivered);
}

TEST_CASE("rows: a table tells the places of its cells") {
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

TEST_CASE("rows: kinds are named as their records, and a misspelt one is told") {
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
