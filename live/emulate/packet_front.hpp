// SPDX-License-Identifier: MIT
#pragma once

#include "live/emulate/packet_format.hpp"
#include "live/carriers/front.hpp"

#include <cstdint>
#include <memory>
#include <string_view>

namespace rovernet {

/// Front of programs that send packets by the radio of a robot, over one hop, and get what it
/// hears, whoever drives it: each robot has a port of its own.
///
/// A packet goes on air at the time at which it comes in, and a message is handed over at the time
/// at which the robot hears it. So the front asks for the time of every event.
class PacketFront : public Front {
  public:
    PacketFront(std::unique_ptr<PacketFormat> format, Carrier carrier);

    void begin(Session& session, const Scenario& scenario) override;
    void opened(Connection, Entrance) override {}
    std::size_t received(Connection from, std::string_view packet) override;
    void closed(Connection) override {}
    Time next() const override { return session_->network().next_event(); }
    void tell() override;
    /// Adds how many packets programs sent and got, and how many of those sent were lost at once.
    void report(Table& counts) const override;

  private:
    struct Counts {
        std::uint64_t sent = 0;      // by programs
        std::uint64_t received = 0;  // by programs
        std::uint64_t malformed = 0, unknown_destination = 0, robot_off = 0;
    };

    std::unique_ptr<PacketFormat> format_;
    Carrier carrier_;
    Session* session_ = nullptr;
    ClientId client_ = 0;
    Counts counts_;
};

}  // namespace rovernet
