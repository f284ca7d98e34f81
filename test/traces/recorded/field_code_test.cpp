// SPDX-License-Identifier: MIT
// Fields of a record that is none of the tree's: of all types that a new kind may have.
#include "traces/recorded/field_reader.hpp"
#include "traces/recorded/field_writer.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace field_code_test {
using namespace rovernet;

namespace {

struct Toy {
    Time time;
    NodeId node, to;
    std::optional<NodeId> helper;
    std::optional<std::uint16_t> left;
    std::int32_t balance;
    std::uint8_t level;
    bool on;
    double share;
    Dbm power;
    Duration pause;
    Time until;
    DropReason reason;
    Frame frame;
    std::uint32_t added = 3;

    static constexpr auto fields() {
        return describe(
            field("time", &Toy::time), field("node", &Toy::node),
            field<or_everyone>("to", &Toy::to), field("helper", &Toy::helper),
            field("left", &Toy::left), field("balance", &Toy::balance), field("level", &Toy::level),
            field("on", &Toy::on), field("share", &Toy::share), field("power", &Toy::power),
            field("pause", &Toy::pause), field("until", &Toy::until), field("reason", &Toy::reason),
            field("frame", &Toy::frame), field<since(6)>("added", &Toy::added));
    }
};

Time at(std::int64_t ns) { return Time{Duration{ns}}; }

const Toy toy{.time = at(1'000),
              .node = {1},
              .to = everyone,
              .helper = NodeId{2},
              .left = std::uint16_t{65'535},
              .balance = -70'000,
              .level = 255,
              .on = true,
              .share = -0.25,
              .power = {-61.5},
              .pause = Duration{4},
              .until = at(900),
              .reason = DropReason::end,
              .frame = {.message = {5}, .sender = {6}, .ttl = 7, .hops = 8, .next_hop = {9}},
              .added = 10};

std::string written(const Toy& record) {
    ByteWriter to;
    FieldWriter(to, record.time).put(record);
    return std::string(to.view());
}

/// The record in the bytes; empty if they are none.
std::optional<Toy> read(std::string_view bytes, unsigned format) {
    std::vector<Reception> receptions;
    FieldReader from(bytes, toy.time, format, receptions);
    Toy record{};
    from.take(record);
    return from.is_done() ? std::optional(record) : std::nullopt;
}

}  // namespace

TEST_CASE("fields of a record: all types are read back as written") {
    const std::string bytes = written(toy);
    const auto back = read(bytes, 6);
    REQUIRE(back);
    CHECK(written(*back) == bytes);
    CHECK(back->time == toy.time);
    CHECK(back->to == everyone);
    CHECK(back->helper == toy.helper);
    CHECK(back->left == toy.left);
    CHECK(back->balance == toy.balance);
    CHECK(back->level == toy.level);
    CHECK(back->on);
    CHECK(back->share == toy.share);
    CHECK(back->power == toy.power);
    CHECK(back->pause == toy.pause);
    CHECK(back->until == toy.until);
    CHECK(back->reason == toy.reason);
    CHECK(back->frame.next_hop == toy.frame.next_hop);
    CHECK(back->added == 10);
}

TEST_CASE(
    "fields of a record: fields missing in a trace of an earlier format get their default values") {
    const std::string bytes = written(toy);  // `added`, a byte, is the last
    const auto back = read(std::string_view(bytes).substr(0, bytes.size() - 1), 5);
    REQUIRE(back);
    CHECK(back->added == 3);
    CHECK(back->frame.hops == toy.frame.hops);
    CHECK_FALSE(read(bytes, 5));
    CHECK_FALSE(read(std::string_view(bytes).substr(0, bytes.size() - 1), 6));
}

TEST_CASE("fields of a record: values out of their range are refused") {
    const auto is_refused = [](auto change) {
        Toy record = toy;
        change(record);
        return !read(written(record), 6);
    };
    CHECK_FALSE(is_refused([](Toy&) {}));
    CHECK(is_refused([](Toy& t) { t.node = everyone; }));
    CHECK(is_refused([](Toy& t) { t.share = 1e16; }));
    CHECK(is_refused([](Toy& t) { t.power = {std::numeric_limits<double>::quiet_NaN()}; }));
    CHECK(is_refused([](Toy& t) { t.until = at(-1); }));
    CHECK(is_refused([](Toy& t) { t.pause = Duration{-4}; }));
    CHECK(is_refused([](Toy& t) { t.pause = Duration::max(); }));
    CHECK(is_refused([](Toy& t) {
        t.reason = static_cast<DropReason>(static_cast<int>(last_drop_reason) + 1);
    }));
}

}  // namespace field_code_test
