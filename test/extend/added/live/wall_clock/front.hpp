// SPDX-License-Identifier: MIT
#pragma once

#include "live/carriers/front.hpp"
#include "live/paced_run.hpp"

#include <set>

namespace rovernet {

/// Front that sends the simulated time to its clients each second, and ignores their input.
class WallClockFront : public Front {
  public:
    explicit WallClockFront(Carrier carrier) : carrier_(std::move(carrier)) {}

    void begin(Session& session, const Scenario&) override { session_ = &session; }
    void opened(Connection client, ListenerId) override { clients_.insert(client); }
    std::size_t received(Connection, std::string_view) override { return 1; }
    void closed(Connection gone) override { clients_.erase(gone); }
    Time next() const override { return next_; }
    void tell() override;

  private:
    Carrier carrier_;
    Session* session_ = nullptr;
    std::set<Connection> clients_;
    Time next_ = start_of_run;
};

/// Listener that serves the time at an address; port 0: any free port.
FrontListeners wall_clock_listener(const Address& at);

inline constexpr FrontOption wall_clock_option{"--wall-clock", "clients that want to know the time",
                                               "127.0.0.1:9191", wall_clock_listener};

}  // namespace rovernet
