// SPDX-License-Identifier: MIT
#pragma once

#include "live/carriers/front.hpp"

#include <chrono>
#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace rovernet::test {

/// Front for tests. For every byte from a client, robot 0 sends a message and turns. Every 100 ms
/// all clients receive a line with the time, followed by `flood` more bytes.
class Parrot : public Front {
  public:
    explicit Parrot(Carrier carrier, std::size_t flood = 0)
        : carrier_(std::move(carrier)), flood_(flood) {}

    void begin(Session& session, const Scenario&) override {
        session_ = &session;
        robot_ = session.attach({NodeId{0}}, "parrot");
    }
    void opened(Connection client, ListenerId at) override {
        clients_[client] = at;
        carrier_.send(client, "port " + std::to_string(at.port) + "\n");
    }
    std::size_t received(Connection from, std::string_view bytes) override {
        for (const char c : bytes) {
            if (c == 'q') carrier_.close(from);
            session_->send(robot_, NodeId{0}, {}, std::string(1, c));
            session_->drive(robot_, NodeId{0}, MetersPerSecond{1}, RadiansPerSecond{c * 0.01});
        }
        return bytes.size();
    }
    void closed(Connection gone) override { clients_.erase(gone); }
    Time next() const override { return next_; }
    void tell() override {
        const auto time = std::chrono::duration_cast<std::chrono::milliseconds>(
            session_->network().now().time_since_epoch());
        for (const auto& [client, listener] : clients_) {
            carrier_.send(client, std::to_string(time.count()) + std::string(flood_, '.') + "\n");
        }
        next_ += std::chrono::milliseconds(100);
    }

  protected:
    Session* session_ = nullptr;
    std::map<Connection, ListenerId> clients_;
    Time next_ = start_of_run;

  private:
    Carrier carrier_;
    ClientId robot_ = 0;
    std::size_t flood_;
};

}  // namespace rovernet::test
