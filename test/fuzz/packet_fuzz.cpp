// SPDX-License-Identifier: MIT
// Any packets of programs are survived, as Ethernet frames and as datagrams, and none is forgotten:
// each is sent, or counted as lost.
#include "live/emulate/ethernet.hpp"
#include "live/emulate/packet_front.hpp"
#include "live/emulate/relay.hpp"
#include "scenario/document/toml.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string_view>

using namespace rovernet;

namespace {

constexpr std::string_view two_robots = R"(
scenario = { name = "two", duration = "1 s" }
propagation = { model = "friis" }
access = { model = "csma" }
robot = [ { name = "A", at = ["0 m", "0 m"] }, { name = "B", at = ["15 m", "0 m"] } ]
)";

std::int64_t count(const Table& counts, std::string_view what) {
    return std::get<std::int64_t>(counts.find(what)->data);
}

void carry(std::unique_ptr<PacketFormat> format, std::string_view packet) {
    const Scenario scenario = read_scenario(parse_toml(two_robots, "two.toml"), "two.toml");
    Session session(scenario);
    PacketFront front(std::move(format), {.send = [](auto, auto) {}, .close = [](auto) {}});
    session.step(start_of_run);
    front.begin(session, scenario);
    front.received(0, packet);
    while (session.network().now() < session.end()) {
        session.step(std::min(front.next(), session.end()));
        front.tell();
    }
    Table counts;
    front.report(counts);
    const auto lost = count(counts, "malformed") + count(counts, "unknown_destination");
    const auto sent = static_cast<std::int64_t>(session.network().metrics().messages);
    if (sent + lost != count(counts, "packets_sent")) std::abort();
    if (count(counts, "packets_received") > sent) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    const std::string_view packet(reinterpret_cast<const char*>(bytes), size);
    carry(std::make_unique<EthernetFormat>(), packet);
    carry(std::make_unique<RelayFormat>(), packet);
    return 0;
}
