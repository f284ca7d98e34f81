// SPDX-License-Identifier: MIT
// What every kind of record has without code of its own: bytes in recorded traces, text, rows and a
// place in fingerprints. A new kind is tested here as soon as it is in RecordKinds.
#include "models/access/wifi_frames.hpp"
#include "sim/legs.hpp"
#include "sim/record.hpp"
#include "traces/fingerprint.hpp"
#include "traces/record_walk.hpp"
#include "traces/recorded/record_code.hpp"
#include "traces/recorded/record_match.hpp"
#include "traces/recorded/record_text.hpp"
#include "traces/row_sink.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <string>
#include <vector>

namespace record_kinds_test {
using namespace rovernet;

namespace {

/// Two messages, which records may be about.
struct World {
    Legs legs;
    MessageTable messages;
    World() {
        messages.add({.origin = {1}, .uid = 40, .size = 8, .payload = {}});
        messages.add({.origin = {2}, .uid = 41, .size = 9, .payload = {}});
    }
    RecordContext context() const { return {legs, messages}; }
};

/// Calls visit(value, use) for each value in a record, with the uses of all fields around it.
template <class T, class Visit>
void for_each_leaf(T& value, FieldUse use, const Visit& visit) {
    if constexpr (DescribedPart<T>) {
        for_each_field_of<T>(
            [&]<class F>(const F& f) { for_each_leaf(value.*f.member, use | F::use, visit); });
    } else if constexpr (is_span<T>) {
        for (auto& each : value) {
            using Plain = typename T::value_type;  // the test's own
            for_each_leaf(const_cast<Plain&>(each), use, visit);
        }
    } else {
        visit(value, use);
    }
}

// Changes of one value to another valid one.
template <class T>
requires std::is_arithmetic_v<T>
void change(T& value) { value = static_cast<T>(value + 1); }
void change(bool& value) { value = !value; }
template <class E>
requires std::is_enum_v<E>
void change(E& value) { value = static_cast<E>(static_cast<int>(value) + 1); }
void change(Time& time) { time += Duration{1'000}; }
void change(Duration& time) { time += Duration{1'000}; }
template <class T>
requires requires(T t) { t.value = 1; }
void change(T& value) { change(value.value); }
void change(Vec3& v) { v.y += 1; }
void change(const ControlFrame*& control) { control = control ? nullptr : &wifi_rts; }
void change(std::string_view& text) { text = text.empty() ? "other" : ""; }
template <class T>
void change(std::optional<T>& value) {
    value ? value.reset() : void(value.emplace());
}

/// A record of one kind, whose receptions are its own.
template <class R>
struct Filled {
    std::vector<Reception> receptions{{Time{Duration{70'000}}, {3}}, {Time{Duration{80'000}}, {5}}};
    std::vector<Dbm> levels{{-60}, {-70}};
    R record{};
    Filled() {
        if constexpr (requires { record.receptions; }) {
            record.receptions = receptions;
            record.levels = levels;
        }
        for_each_in<MessageId>(record, [](MessageId& id) { id = {0}; });
        int ns = 50'000;
        for_each_leaf(record, 0, [&]<class T>(T& value, FieldUse) {
            if constexpr (std::same_as<T, Time>) value = Time{Duration{ns += 1'000}};
        });
    }
    Filled(const Filled&) = delete;
};

/// All that sinks of any kind of record make of one.
struct Made {
    std::string bytes, text;
    std::uint64_t fingerprint;
    Made(const Record& record, const World& world) {
        ByteWriter writer;
        const Time time = time_of(record, start_of_run);
        writer.signed_varint(time.time_since_epoch().count());
        encode(record, time, writer);
        bytes = writer.view();
        append_text(record, world.context(), text);
        Fingerprint of_one;
        if ((KindMask{1} << record.index()) & of_one.kinds()) of_one.on(record, world.context());
        fingerprint = of_one.value();
    }
};

template <class Test, class... R>
void for_each_kind(const Test& test, RecordList<R...>) {
    (test.template operator()<R>(), ...);
}

/// What changes in the things made of a record when its value `number` changes; empty: no such
/// value.
template <class R>
std::string changes(const World& world, int number) {
    Filled<R> before, after;
    std::string expected, found;
    int i = 0;
    for_each_leaf(after.record, 0, [&]<class T>(T& value, FieldUse use) {
        if (i++ != number) return;
        change(value);
        const bool is_hashed = (kind_of<R>() & kind_unhashed) == 0 && (use & not_hashed) == 0;
        const bool is_recorded = (use & not_recorded) == 0;
        expected = std::string(is_recorded ? "bytes text match " : "") + (is_hashed ? "hash" : "");
        const Made a(before.record, world), b(after.record, world);
        if (a.bytes != b.bytes) found += "bytes ";
        if (a.text != b.text) found += "text ";
        if (!are_same(before.record, world.context(), after.record, world.context())) {
            found += "match ";
        }
        if (a.fingerprint != b.fingerprint) found += "hash";
        CHECK_MESSAGE(found == expected, R::name << ": value " << number);
    });
    return i > number ? "found" : "";
}

/// A value of any type, to find how many members a struct has.
struct AnyMember {
    template <class T>
    requires(!is_optional<T>) operator T() const { std::abort(); }
};
template <class T, class... Members>
consteval std::size_t count_members() {
    if constexpr (requires { T{Members{}..., AnyMember{}}; }) {
        return count_members<T, Members..., AnyMember>();
    } else {
        return sizeof...(Members);
    }
}
template <class T>
std::size_t count_fields() {
    std::size_t count = 0;
    for_each_field_of<T>([&](const auto&) { ++count; });
    return count;
}

}  // namespace

TEST_CASE("kinds of records: fields() describes every data member of each kind of record") {
    struct Forgetful {
        Time time;
        std::optional<NodeId> node;
        static constexpr auto fields() { return describe(field("time", &Forgetful::time)); }
    };
    CHECK(count_members<Forgetful>() == 2);  // the control
    CHECK(count_fields<Forgetful>() == 1);
    const auto check = []<class R>() {
        CHECK_MESSAGE(count_fields<R>() == count_members<R>(), sizeof(R) << " bytes");
    };
    for_each_kind(check, RecordKinds{});
    for_each_kind(check, RecordList<Frame, AirFrame, Leg, Reception>{});
}

TEST_CASE(
    "kinds of records: a change of a field changes bytes, text and fingerprint as the field's "
    "description says") {
    const World world;
    for_each_kind(
        [&]<class R>() {
            int number = 0;
            while (!changes<R>(world, number).empty()) ++number;
            CHECK(number > 1);
        },
        RecordKinds{});
}

TEST_CASE("kinds of records: a record is equal after it was written to bytes and read back") {
    const World world;
    for_each_kind(
        [&]<class R>() {
            const Filled<R> filled;
            const Record record = filled.record;
            const Time time = time_of(record, start_of_run);
            ByteWriter bytes;
            encode(record, time, bytes);
            std::vector<Reception> receptions;
            Record back;
            const std::uint16_t channel = channel_of(record.index());
            REQUIRE(decode(channel, time, bytes.view(), receptions, back));
            CHECK(are_same(record, world.context(), back, world.context()));
            CHECK(Made(record, world).bytes == Made(back, world).bytes);
            const auto cut = bytes.view().substr(0, bytes.size() - 1);
            CHECK_FALSE(decode(channel, time, cut, receptions, back));
        },
        RecordKinds{});
}

TEST_CASE(
    "kinds of records: each kind of record has a row in a table, a name and a channel in the "
    "trace") {
    const World world;
    const std::vector<RecordedKind> kinds = recorded_kinds();
    const std::vector<std::string> names = record_names();
    RowSink rows(kind_all);
    for_each_kind(
        [&]<class R>() {
            const Filled<R> filled;
            const Record record = filled.record;
            rows.on(record, world.context());
            const RowSink::Table table = rows.table(kind_of<R>());
            CHECK(table.size() == (kind_of<R>() == kind_of<Received>() ? 2 : 1));
            REQUIRE(table.columns.size() >= 2);
            CHECK(table.columns[0].name == "t_ns");
            CHECK(record_named(names[record.index()]) == kind_of<R>());
            CHECK(kinds[channel_of(record.index()) - 1U].topic == R::name);
        },
        RecordKinds{});
    CHECK(kinds.size() == std::variant_size_v<Record> + 1);
}

// The layouts are those of format 5, which readers elsewhere were written for.
TEST_CASE("kinds of records: the layouts in recorded traces are those of format 5") {
    const std::vector<RecordedKind> kinds = recorded_kinds();
    const std::string frame = "message:v sender:v ttl:v hops:v next_hop:node? bytes:v";
    const std::string air = frame + " heard_from:node? kind:b attempt:b number:v reserved:z";
    const std::string expected[] = {
        "slot:v uid:v origin:v number:v to:node? size:v created:z(before this time) flow:v "
        "is_routed:b port:v kind:s payload:s",
        "node:v message:v ttl:v robots:v reachable:v(0 unknown, else + 1) "
        "shortest:v(0 unknown, else + 1)",
        frame + " heard_from:node?",
        frame +
            " reserved:z header:v n:v n*time:z(after the one before, the first after this time) "
            "n*node:z(after the one before, the first after the sender) n*fate:b(2 fate + "
            "delivered)",
        "node:v " + frame + " reason:b protocol_decides:b",
        "node:v start:z(after this time) end:v(0 never, else + 1 - start) from:3d parts:b(1 "
        "velocity:3d to:3d, 2 heading:d, 4 turning:d; what is left out is 0, `to` is `from`)",
        "node:v",
        "node:v goal:3d",
        "node:v on:b",
        "from:v to:v",
        "from:v to:v",
        air + " bytes:v header:v airtime:z rate:d queue:v",
        air + " node:v fate:b(2 fate + delivered) bytes:v",
        frame + " heard_from:node?",
    };
    REQUIRE(kinds.size() == std::size(expected));
    for (std::size_t i = 0; i < std::size(expected); ++i) CHECK(kinds[i].layout == expected[i]);
}

}  // namespace record_kinds_test
