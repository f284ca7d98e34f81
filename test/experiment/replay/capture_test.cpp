// SPDX-License-Identifier: MIT
#include "experiment/replay/recorded_air.hpp"
#include "sim/error.hpp"
#include "test/experiment/replay/captured_run.hpp"
#include "traces/recorded/recorded_reader.hpp"
#include "traces/recorded/recorded_trace.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace capture_test {
using namespace rovernet;
using namespace rovernet::testing;

namespace {

/// Robots that flood messages and send unicasts: behind RTS and CTS, and to one who cannot hear
/// them.
const std::string busy = R"(
[scenario]
duration = "4 s"
[access]
model = "csma"
rts_threshold = "60 B"
[reception]
model = "sinr"
[routing]
protocol = "flood"
[[robot]]
name = "A"
at = ["0 m", "0 m"]
move = { model = "waypoints", path = [["0 m", "200 m"]], speed = "40 m/s" }
[[robot]]
name = "B"
at = ["150 m", "0 m"]
[[robot]]
name = "rover C"
at = ["380 m", "0 m"]
radio = { mac = "0a:0b:0c:0d:0e:0f", ip = "192.168.7.9" }
[[traffic]]
from = "A"
payload = "hello"
start = "0.1 s"
every = "0.2 s"
[[traffic]]
kind = "unicast"
from = "B"
to = "rover C"
payload = "data"
size = "700 B"
start = "0.15 s"
every = "0.2 s"
[[traffic]]
kind = "unicast"
from = "rover C"
to = "A"
payload = "too far"
start = "0.17 s"
every = "1 s"
)";

std::uint64_t little(std::string_view bytes, std::size_t at, std::size_t size) {
    std::uint64_t value = 0;
    for (std::size_t i = size; i-- > 0;) {
        value = value << 8 | static_cast<std::uint8_t>(bytes[at + i]);
    }
    return value;
}
std::uint64_t big(std::string_view bytes, std::size_t at, std::size_t size) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < size; ++i) {
        value = value << 8 | static_cast<std::uint8_t>(bytes[at + i]);
    }
    return value;
}

struct Packet {
    std::string interface;
    std::uint64_t ns;
    std::uint64_t flags;
    std::string bytes;
};

/// The packets of a pcapng file, read by its specification.
std::vector<Packet> packets_in(const std::string& path) {
    const std::string file = content(path);
    std::vector<std::string> interfaces;
    std::vector<Packet> packets;
    for (std::size_t at = 0; at < file.size();) {
        const std::uint64_t type = little(file, at, 4), length = little(file, at + 4, 4);
        REQUIRE(length % 4 == 0);
        REQUIRE(at + length <= file.size());
        CHECK(little(file, at + length - 4, 4) == length);
        const std::string_view block = std::string_view(file).substr(at, length);
        at += length;
        if (type == 0x0A0D0D0A) {
            CHECK(little(block, 8, 4) == 0x1A2B3C4D);
        } else if (type == 1) {
            CHECK(little(block, 8, 2) == 127);
            CHECK(little(block, 16, 2) == 2);  // the name comes first
            interfaces.emplace_back(block.substr(20, little(block, 18, 2)));
        } else {
            REQUIRE(type == 6);
            const std::size_t captured = little(block, 20, 4), end = 28 + (captured + 3) / 4 * 4;
            CHECK(little(block, 24, 4) == captured);
            CHECK(little(block, end, 2) == 2);
            packets.push_back({interfaces.at(little(block, 8, 4)),
                               little(block, 12, 4) << 32 | little(block, 16, 4),
                               little(block, end + 4, 4), std::string(block.substr(28, captured))});
        }
    }
    return packets;
}

const std::string macs[] = {"02:00:00:00:00:01", "02:00:00:00:00:02", "0a:0b:0c:0d:0e:0f"};
const std::string ips[] = {"10.0.0.1", "10.0.0.2", "192.168.7.9"};

std::string mac_of_hop(NodeId node) {
    return node == everyone ? "ff:ff:ff:ff:ff:ff" : macs[node.index()];
}

/// What tshark has to print of a packet: interface, time, length without radiotap, type, receiver,
/// transmitter, level, then of a message its ends and the length of UDP.
std::string line_of(const RecordedAir& air, const RecordedFrame& frame, const Message* message,
                    NodeId at, Time time) {
    const std::map<std::string_view, std::string_view> types{
        {"DATA", "0x0020"}, {"RTS", "0x001b"}, {"CTS", "0x001c"}, {"ACK", "0x001d"}};
    const bool has_sender = !frame.air.control || frame.air.is("RTS");
    const NodeId sender = frame.air.frame.sender;
    const std::int64_t ns = (time - start_of_run).count();
    std::string level;
    if (at != sender) level = fmt::format("{:.0f}", air.arrival(frame, at).level_dbm);
    const std::size_t size = message ? 24 + 8 + 20 + 8 + 32 + message->size + 4 : frame.bytes;
    std::string ends = "\t\t\t";
    if (message) {
        ends = fmt::format("\t{}\t{}\t{}", ips[message->origin.index()],
                           message->to == everyone ? "255.255.255.255" : ips[message->to.index()],
                           8 + 32 + message->size);
    }
    return fmt::format("{}\t{}.{:09}\t{}\t{}\t{}\t{}\t{}{}\n", air.names()[at.index()],
                       ns / 1'000'000'000, ns % 1'000'000'000, size + 16,
                       types.at(frame.air.kind()), mac_of_hop(frame.air.frame.next_hop),
                       has_sender ? macs[sender.index()] : "", level, ends);
}

/// The same of all packets that there should be, from the records.
std::string lines_of(const std::string& trace) {
    RecordedReader reader(trace);
    RecordedAir air(LoadedRun(reader.run(), trace));
    std::string lines;
    while (const Record* record = reader.next()) {
        air.take(*record, reader.context());
        const auto message_of = [&](const AirFrame& frame) {
            return frame.control ? nullptr : &reader.context().messages[frame.frame.message];
        };
        const auto received = [&](const AirFrame& sent, const Reception& at) {
            if (!is_decoded(at.fate)) return;
            const Message* message = message_of(sent);
            const RecordedFrame* frame = air.frame_of(sent, message ? message->uid : 0, at);
            REQUIRE(frame);
            lines += line_of(air, *frame, message, at.node, at.time);
        };
        if (const auto* sent = std::get_if<AirSent>(record)) {
            lines += line_of(air, air.frames().back(), message_of(sent->air),
                             sent->air.frame.sender, sent->time);
        } else if (const auto* got = std::get_if<Received>(record)) {
            for (const Reception& at : got->receptions) received({.frame = got->frame}, at);
        } else if (const auto* control = std::get_if<ControlReceived>(record)) {
            received(control->air, control->reception);
        }
    }
    return lines;
}

}  // namespace

TEST_CASE("capture: every frame is recorded at its sender and at all its receivers") {
    const CapturedRun run(busy);
    const Capture made = capture_recorded(run.trace, run.capture);
    CHECK(made.left_out == 0);
    CHECK(made.damage.empty());
    const std::vector<Packet> packets = packets_in(run.capture);
    CHECK(packets.size() == made.packets);
    const std::string lines = lines_of(run.trace);
    CHECK(packets.size() == static_cast<std::size_t>(std::count(lines.begin(), lines.end(), '\n')));
    std::size_t out = 0, with_retry = 0, last = 0;
    for (const Packet& packet : packets) {
        CHECK(packet.ns >= last);
        last = packet.ns;
        CHECK(little(packet.bytes, 2, 2) == 16);  // the radiotap header
        if (packet.flags == 2) ++out;
        if (packet.bytes[17] & 0x08) ++with_retry;
    }
    CHECK(out > 100);
    CHECK(packets.size() > out + 100);
    CHECK(with_retry > 0);
}

TEST_CASE(
    "capture: before each message there is a header of rovernet with origin, size, TTL and hops") {
    const CapturedRun run(busy);
    capture_recorded(run.trace, run.capture);
    const std::size_t header = 16 + 24 + 8 + 20 + 8;
    std::size_t floods = 0, unicasts = 0;
    for (const Packet& packet : packets_in(run.capture)) {
        if (packet.bytes[16] != 0x08) continue;
        const std::string_view message = std::string_view(packet.bytes).substr(header);
        CHECK(message.substr(0, 6) == std::string_view("rvnt\1\0", 6));
        const std::uint64_t origin = big(message, 20, 4), size = big(message, 24, 4);
        if (origin == 2) continue;
        const bool is_flood = origin == 0;
        CHECK(size == (is_flood ? 5 : 700));
        CHECK(big(message, 28, 4) == size + 28);  // bytes in the run: those of csma in it
        const std::uint64_t ttl = big(message, 6, 2), hops = big(message, 8, 2);
        CHECK(hops >= 1);
        if (is_flood) CHECK(ttl + hops == 4);
        CHECK(message.substr(32, is_flood ? 5 : 4) == (is_flood ? "hello" : "data"));
        CHECK(message.size() == 32 + size + 4);
        ++(is_flood ? floods : unicasts);
    }
    CHECK(floods > 50);
    CHECK(unicasts > 20);
}

TEST_CASE(
    "tshark reads a capture: no frame is malformed, and times, addresses and lengths equal the "
    "trace") {
    if (!has_tshark()) return;
    const CapturedRun run(busy);
    capture_recorded(run.trace, run.capture);
    CHECK(run.tshark("-Y _ws.malformed").empty());
    CHECK(run.tshark("-o wlan.check_checksum:TRUE -Y 'not wlan.fcs.status == 1'").empty());
    CHECK(run.tshark("-o ip.check_checksum:TRUE -Y 'ip and not ip.checksum.status == 1'").empty());
    CHECK(run.tshark("-T fields -e frame.interface_name -e frame.time_epoch -e frame.len "
                     "-e wlan.fc.type_subtype -e wlan.ra -e wlan.ta -e radiotap.dbm_antsignal "
                     "-e ip.src -e ip.dst -e udp.length") == lines_of(run.trace));
}

TEST_CASE("capture: a damaged or incomplete trace gives a capture of its intact part") {
    const CapturedRun run(busy);
    const std::uint64_t all = capture_recorded(run.trace, run.capture).packets;
    std::filesystem::resize_file(run.trace, std::filesystem::file_size(run.trace) - 40);
    const Capture made = capture_recorded(run.trace, run.capture);
    CHECK(made.packets == all);
    CHECK(made.damage == std::vector<std::string>{"the end is missing"});
    testing::write_file(run.folder / "text.tr",
                        "s 1.000000000 _0_ AGT  --- 0 cbr 512 [0 0 0 0] \n");
    CHECK_THROWS_AS(capture_recorded(run.folder / "text.tr", run.capture), InputError);
}

TEST_CASE("capture: even a broadcast ARP packet, which only a damaged trace contains, is written") {
    const testing::TempFolder folder;
    const CapturedRun run("[[robot]]\nname = \"A\"\nat = [\"0 m\", \"0 m\"]\n");
    RecordedReader whole(run.trace);
    testing::Stream stream;
    const auto trace = std::make_shared<RecordedTrace>(
        folder / "t.mcap", RecordedTrace::Contents{.version = "test", .scenario = {}});
    trace->begin({.scenario = [&] { return whole.run().scenario; },
                  .robots = 1,
                  .name = [](NodeId) { return std::string_view("A"); },
                  .seed = 1,
                  .replication = 0});
    stream.sinks.emplace_back(trace);
    const NodeId a = stream.place(Vec3{});
    const MessageId packet = stream.messages.add(
        {.origin = a, .to = everyone, .size = 28, .payload = {}, .kind = "ARP REPLY"});
    stream.transmit(start_of_run + 1s, testing::frame(packet, a, 1, 1));
    trace->finish();
    trace->close();
    CHECK(capture_recorded(folder / "t.mcap", folder / "t.pcapng").packets == 1);
}

}  // namespace capture_test
