// SPDX-License-Identifier: MIT
#pragma once

#include "live/emulate/packet_front.hpp"
#include "test/live/talk.hpp"

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace rovernet::test {

/// Programs of robots, whose packets the test passes to the front and back.
class Programs {
  public:
    struct Packet {
        Time time;
        NodeId robot;
        std::string bytes;
    };

    Programs(std::unique_ptr<PacketFormat> format, const Scenario& scenario)
        : session_(scenario),
          front_(std::move(format),
                 {.send =
                      [this](auto to, auto bytes) {
                          got.push_back({session_.network().now(), NodeId{to}, std::string(bytes)});
                      },
                  .close = [](auto) {}}) {
        session_.step(start_of_run);
        front_.begin(session_, scenario);
    }

    void send(std::uint32_t robot, const std::string& packet) { front_.received(robot, packet); }
    /// Advances the session to `end`, from event to event.
    void run_to(Time end) {
        while (session_.network().now() < end) {
            session_.step(std::min(front_.next(), end));
            front_.tell();
        }
    }
    Session& session() { return session_; }
    /// Value of one of the front's counters.
    std::uint64_t count(std::string_view what) const {
        Table counts;
        front_.report(counts);
        return static_cast<std::uint64_t>(std::get<std::int64_t>(counts.find(what)->data));
    }

    std::vector<Packet> got;  // packets that the programs have received

  private:
    Session session_;
    PacketFront front_;
};

}  // namespace rovernet::test
