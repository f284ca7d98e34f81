// SPDX-License-Identifier: MIT
#include "traces/fingerprint.hpp"

#include "test/traces/record_stream.hpp"

#include <doctest/doctest.h>

#include <functional>
#include <memory>
#include <set>

namespace fingerprint_test {
using namespace rovernet;
using namespace rovernet::testing;

namespace {

/// Every record once, each field with a value of its own.
struct Run {
    Message message{.origin = {2},
                    .uid = 0x0123456789abcdef,
                    .number = 4,
                    .key = 5,
                    .size = 64,
                    .created = at(1),
                    .payload = "F"};
    Frame frame{.message = {0}, .sender = {6}, .path = 7, .ttl = 3, .hops = 2};
    Sent sent{at(10'000'000'000), {2}, {0}, 4, 9, 8};
    Transmitted transmitted{at(-2), frame, NodeId{11}};
    std::vector<Reception> receptions{{at(13), {12}, Fate::waiting, true},
                                      {at(15), {14}, Fate::duplicate, false}};
    Dropped dropped{at(16), {17}, frame, DropReason::off};
    Moved moved{at(18), {19}, {at(20), at(21), {1.5, -2, 3}, {9, 9, 9}, {4, 5, 6.0000005}}};

    std::string text() const {
        Stream stream;
        stream.messages.add(message);
        const auto fingerprint = std::make_shared<Fingerprint>();
        stream.sinks.push_back(fingerprint);
        stream.emit(sent);
        stream.emit(transmitted);
        stream.receive(frame, receptions);
        stream.emit(dropped);
        stream.emit(moved);
        return fingerprint->text();
    }
};

}  // namespace

TEST_CASE("fingerprint: without records, the fingerprint is the XXH64 of an empty input") {
    CHECK(Fingerprint{}.text() == "ef46db3751d8e999");  // the reference value of xxHash
    CHECK(Fingerprint{}.value() == 0xef46db3751d8e999);
}

// The value is that of another implementation of XXH64, fed with the bytes that the header lists.
TEST_CASE("fingerprint: the value for one record of each kind is the expected constant") {
    CHECK(Run{}.text() == "d05f6eb83126bfae");
}

TEST_CASE("fingerprint: a change of any covered field of a record changes the fingerprint") {
    const std::function<void(Run&)> changes[] = {
        [](Run&) {},
        [](Run& r) { r.message.origin = {3}; },
        [](Run& r) { ++r.message.uid; },
        [](Run& r) { ++r.message.size; },
        [](Run& r) { r.sent.time += Duration{1}; },
        [](Run& r) { r.sent.node = {3}; },
        [](Run& r) { ++r.sent.ttl; },
        [](Run& r) { ++r.sent.robots; },
        [](Run& r) { r.transmitted.time += Duration{1}; },
        [](Run& r) { r.transmitted.frame.sender = {7}; },
        [](Run& r) { ++r.transmitted.frame.ttl; },
        [](Run& r) { ++r.transmitted.frame.hops; },
        [](Run& r) { r.transmitted.heard_from = NodeId{12}; },
        [](Run& r) { r.transmitted.heard_from.reset(); },
        [](Run& r) { r.frame.sender = {7}; },
        [](Run& r) { ++r.frame.ttl; },
        [](Run& r) { ++r.frame.hops; },
        [](Run& r) { r.receptions[0].node = {13}; },
        [](Run& r) { r.receptions[0].time += Duration{1}; },
        [](Run& r) { r.receptions[0].fate = Fate::ttl; },
        [](Run& r) { r.receptions[0].delivered = false; },
        [](Run& r) { std::swap(r.receptions[0], r.receptions[1]); },
        [](Run& r) { r.receptions.pop_back(); },
        [](Run& r) { r.dropped.time += Duration{1}; },
        [](Run& r) { r.dropped.node = {18}; },
        [](Run& r) { ++r.dropped.frame.ttl; },
        [](Run& r) { r.moved.time += Duration{1}; },
        [](Run& r) { r.moved.node = {20}; },
        [](Run& r) { r.moved.leg.start += Duration{1}; },
        [](Run& r) { r.moved.leg.end += Duration{1}; },
        [](Run& r) { r.moved.leg.from.x += 1e-6; },
        [](Run& r) { r.moved.leg.from.y += 1e-6; },
        [](Run& r) { r.moved.leg.from.z += 1e-6; },
        [](Run& r) { r.moved.leg.to.x += 1e-6; },
        [](Run& r) { r.moved.leg.to.y += 1e-6; },
        [](Run& r) { r.moved.leg.to.z += 1e-6; },
    };
    std::set<std::string> seen;
    for (const auto& change : changes) {
        Run run;
        change(run);
        seen.insert(run.text());
    }
    CHECK(seen.size() == std::size(changes));
}

TEST_CASE(
    "fingerprint: payloads, message keys and moves below 1 um do not change the fingerprint") {
    Run run;
    run.sent.reachable.reset();
    run.message.payload = "other";
    run.message.key = run.frame.path = 99;
    run.transmitted.frame.path = run.dropped.frame.path = 98;
    run.moved.leg.from.x += 1e-7;  // rounds to the same micrometre
    CHECK(run.text() == Run{}.text());
}

TEST_CASE("fingerprint: receptions in one record give the same fingerprint as in several records") {
    Run whole;
    Stream stream;
    stream.messages.add(whole.message);
    const auto one = std::make_shared<Fingerprint>();
    const auto two = std::make_shared<Fingerprint>();
    stream.sinks = {one};
    stream.receive(whole.frame, whole.receptions);
    stream.sinks = {two};
    for (const auto& rx : whole.receptions) stream.receive(whole.frame, {rx});
    CHECK(one->value() == two->value());
}

TEST_CASE(
    "fingerprint: two positions 1e300 m away in opposite directions have different fingerprints") {
    Run a, b;
    a.moved.leg.to.x = 1e300;
    b.moved.leg.to.x = -1e300;
    CHECK(a.text() != b.text());
}

}  // namespace fingerprint_test
