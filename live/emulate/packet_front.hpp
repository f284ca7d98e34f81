// SPDX-License-Identifier: MIT
#pragma once

#include "live/carriers/front.hpp"
#include "live/emulate/packet_format.hpp"

#include <cstdint>
#include <memory>
#include <string_view>

namespace rovernet {

/// Front (protocol server) for programs that exchange packets by robots' radios: each robot has a
/// port. Packets from a program are sent over one hop; messages that the robot receives are passed
/// to the program. The robot may be driven by a different program.
///
/// A packet is sent at the time of its arrival, and a message is delivered at the time of its
/// reception. Therefore next() returns the time of the network's next event.
class PacketFront : public Front {
  public:
    PacketFront(std::unique_ptr<PacketFormat> format, Carrier carrier);

    void begin(Session& session, const Scenario& scenario) override;
    void opened(Connection, ListenerId) override {}
    std::size_t received(Connection from, std::string_view packet) override;
    void closed(Connection) override {}
    Time next() const override { return session_->network().next_event(); }
    void tell() override;
    /// Adds the numbers of packets sent and received by programs, and of sent packets that were
    /// rejected.
    void report(Table& counts) const override;

  private:
    struct Counts {
        std::uint64_t sent = 0;      // packets sent by programs
        std::uint64_t received = 0;  // packets received by programs
        std::uint64_t malformed = 0, unknown_destination = 0, robot_off = 0;
    };

    std::unique_ptr<PacketFormat> format_;
    Carrier carrier_;
    Session* session_ = nullptr;
    ClientId client_ = 0;
    Counts counts_;
};

}  // namespace rovernet
