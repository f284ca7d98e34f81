// SPDX-License-Identifier: MIT
#pragma once

#include "live/carriers/front.hpp"
#include "live/player/devices.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// Settings of a Player server.
struct PlayerSettings {
    std::vector<PlayerPlace> places = {};
    /// True for lock-step: simulated time advances by 100 ms once all clients in PULL mode have
    /// requested data. The run ends when the last client has left.
    bool is_lockstep = false;
    /// Number of clients in PULL mode that must connect before simulated time starts, in lock-step.
    std::size_t wait_for = 1;
};

/// Player server, for programs written for Player and Stage. docs/guide/player.md lists the
/// supported messages.
///
/// A client in PULL mode requests data and is answered at the next multiple of 100 ms: data of each
/// subscribed device, then SYNCH. If no device has data, the request stays open until a device has
/// data. Clients in PUSH mode get every message immediately.
class PlayerFront : public Front {
  public:
    PlayerFront(PlayerSettings settings, Carrier carrier);
    ~PlayerFront() override;

    /// @throws std::invalid_argument if a robot does not exist
    void begin(Session& session, const Scenario& scenario) override;
    void opened(Connection client, ListenerId at) override;
    std::size_t received(Connection from, std::string_view bytes) override;
    void closed(Connection gone) override;
    Time next() const override { return next_; }
    void tell() override;
    Time limit() const override;
    bool is_done() const override;

  private:
    struct Client;
    /// Deferred command of a client. In lock-step, commands are executed once all clients have
    /// requested data.
    struct Deferred {
        PlacedDevice* device;
        Connection from;
        PlayerMessage message;
    };

    void handle(Connection from, const PlayerMessage& message);
    void take_command(const Client& client, const PlayerMessage& message);
    void answer(Client& client, const PlayerMessage& request);
    void answer_subscription(Client& client, const PlayerMessage& request, XdrReader payload);
    std::optional<std::string> server_answer(Client& client, std::uint32_t subtype,
                                             XdrReader payload);
    std::string device_list(const Client& client) const;
    std::optional<std::string> driver(const Client& client, XdrReader payload);
    void set_mode(Client& client, bool pulls);
    void send(const Client& to, const PlayerMessage& request, PlayerType type, std::string payload);
    void join(PlacedDevice& device, Client& client);
    void leave(PlacedDevice& device, Client& client);
    void tell_of(PlacedDevice& device);
    void hold(Client& client, std::string message);
    void end_round(Client& client);
    void carry_out_deferred();
    bool everyone_asks() const;
    void go_on();
    Time now() const { return session_->network().now(); }

    PlayerSettings settings_;
    Carrier carrier_;
    Session* session_ = nullptr;
    std::optional<PlayerDevices> devices_;
    std::map<Connection, Client> clients_;
    std::vector<Deferred> deferred_;
    std::size_t deferred_bytes_ = 0;
    bool has_begun_ = false;  // whether simulated time has started, in lock-step
    Time next_ = never;
};

}  // namespace rovernet
