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

/// Programs of robots whose packets are carried by a test.
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
    /// Lets time go on, from one event to the next.
    void run_to(Time end) {
        while (session_.network().now() < end) {
            session_.step(std::min(front_.next(), end));
            front_.tell();
        }
    }
    Session& session() { return session_; }
    /// A number of those that the front counts.
    std::uint64_t count(std::string_view what) const {
        Table counts;
        front_.report(counts);
        return static_cast<std::uint64_t>(std::get<std::int64_t>(counts.find(what)->data));
    }

    std::vector<Packet> got;  // by programs

  private:
    Session session_;
    PacketFront front_;
};

}  // namespace rovernet::test
