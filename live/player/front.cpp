// SPDX-License-Identifier: MIT
#include "live/player/front.hpp"

#include <algorithm>
#include <deque>
#include <iterator>
#include <utility>

namespace rovernet {
namespace {

/// Requests to the server, its device player:0.
enum ServerRequest : std::uint32_t {
    list_devices = 1,
    tell_driver = 2,
    subscribe = 3,
    ask_data = 4,
    set_data_mode = 5,
    add_replace_rule = 10,
};
/// What a client wants of a device, and what it got.
enum Access : std::uint32_t { access_open = 1, access_close = 2, access_error = 3 };

constexpr PlayerAddress server{PlayerInterface::player, 0};
constexpr std::uint32_t pull_mode = 2;  // 1: push
constexpr std::uint32_t newest_data = 1;
constexpr std::size_t most_held = 1'024;                   // for a client that does not ask
constexpr std::size_t most_bytes = std::size_t{3} << 20U;  // of them; a message has 1 MiB at most
constexpr std::size_t most_deferred = std::size_t{16} << 20U;  // [bytes] commands of one round
constexpr std::string_view driver_name = "rovernet";

bool is_multiple(Time time, Duration period) {
    return time.time_since_epoch() % period == Duration{0};
}
/// The first multiple of a period after a time.
Time next_multiple(Time time, Duration period) {
    return start_of_run + (time.time_since_epoch() / period + 1) * period;
}

}  // namespace

struct PlayerFront::Client {
    Connection connection = 0;
    ListenerId at{};
    PlayerStream stream = {};
    bool pulls = false;
    bool asks = false;  // for data: its round is open
    std::size_t subscriptions = 0;
    std::deque<std::string> held = {};  // messages for the end of the round
    std::size_t held_bytes = 0;
    std::size_t lost = 0;  // messages that were too many
};

PlayerFront::PlayerFront(PlayerSettings settings, Carrier carrier)
    : settings_(std::move(settings)), carrier_(std::move(carrier)) {}
PlayerFront::~PlayerFront() = default;

void PlayerFront::begin(Session& session, const Scenario&) {
    session_ = &session;
    devices_.emplace(session, settings_.places);
}

void PlayerFront::opened(Connection client, ListenerId at) {
    clients_[client] = {client, at};
    carrier_.send(client, player_banner());
}

std::size_t PlayerFront::received(Connection from, std::string_view bytes) {
    PlayerStream& stream = clients_.at(from).stream;
    stream.add(bytes);
    std::size_t messages = 0;
    try {
        for (; const auto message = stream.next(); ++messages) handle(from, *message);
    } catch (const MalformedMessage&) {
        carrier_.close(from);  // where the next message begins is not known
    }
    go_on();
    return messages;
}

void PlayerFront::closed(Connection gone) {
    for (PlacedDevice& each : devices_->all()) leave(each, clients_.at(gone));
    clients_.erase(gone);
    go_on();
}

void PlayerFront::handle(Connection from, const PlayerMessage& message) {
    Client& client = clients_.at(from);
    if (message.type == PlayerType::command) return take_command(client, message);
    if (message.type != PlayerType::request) return;
    try {
        answer(client, message);
    } catch (const MalformedMessage&) {
        send(client, message, PlayerType::nack, {});
    }
}

void PlayerFront::take_command(const Client& client, const PlayerMessage& message) {
    PlacedDevice* device = devices_->find(client.at.number, message.device);
    if (!device || device->users.empty()) return;
    deferred_bytes_ += sizeof message + message.payload.size();
    if (deferred_bytes_ > most_deferred) return carrier_.close(client.connection);
    deferred_.push_back({device, client.connection, message});
    if (!settings_.is_lockstep) carry_out_deferred();
}

/// Sends a message of the type and with the payload given; the rest is that of the request.
void PlayerFront::send(const Client& to, const PlayerMessage& request, PlayerType type,
                       std::string payload) {
    carrier_.send(to.connection, encode({request.device, type, request.subtype, seconds(now()),
                                         request.sequence, std::move(payload)},
                                        to.at.port));
}

void PlayerFront::answer(Client& client, const PlayerMessage& request) {
    const XdrReader payload(request.payload);
    if (request.device == server && request.subtype == subscribe) {
        return answer_subscription(client, request, payload);
    }
    std::optional<std::string> answer;
    if (request.device == server) {
        answer = server_answer(client, request.subtype, payload);
    } else if (PlacedDevice* device = devices_->find(client.at.number, request.device)) {
        answer = device->device->answer(request.subtype, payload);
    }
    const PlayerType type = answer ? PlayerType::ack : PlayerType::nack;
    send(client, request, type, std::move(answer).value_or(""));
}

/// Payload of the answer to a request to the server; nothing: it is refused.
std::optional<std::string> PlayerFront::server_answer(Client& client, std::uint32_t subtype,
                                                      XdrReader payload) {
    switch (subtype) {
        case list_devices: return device_list(client);
        case tell_driver: return driver(client, payload);
        case ask_data: client.asks = client.pulls; return "";
        case set_data_mode: set_mode(client, payload.u32() == pull_mode); return "";
        case add_replace_rule:  // of data the newest counts anyway
            return "";
        default: return std::nullopt;
    }
}

void PlayerFront::set_mode(Client& client, bool pulls) {
    client.pulls = pulls;
    client.asks = false;
    if (pulls) return;
    for (const std::string& each : client.held) carrier_.send(client.connection, each);
    client.held.clear();
    client.held_bytes = 0;
}

std::string PlayerFront::device_list(const Client& client) const {
    XdrWriter addresses;
    std::size_t count = 0;
    for (const PlacedDevice& each : devices_->all()) {
        if (each.listener != client.at.number) continue;
        put_address(addresses, each.address, client.at.port);
        ++count;
    }
    return XdrWriter().count(count).take() + addresses.take();
}

std::optional<std::string> PlayerFront::driver(const Client& client, XdrReader payload) {
    const PlayerAddress address = read_address(payload);
    if (!devices_->find(client.at.number, address)) return std::nullopt;
    XdrWriter out;
    return put_address(out, address, client.at.port).text(driver_name).take();
}

/// Answers a request to open or close a device; the answer always has the device's address.
void PlayerFront::answer_subscription(Client& client, const PlayerMessage& request,
                                      XdrReader payload) {
    const PlayerAddress address = read_address(payload);
    const std::uint32_t access = payload.u32();
    PlacedDevice* device = devices_->find(client.at.number, address);
    XdrWriter out;
    put_address(out, address, client.at.port);
    if (device && access == access_open) {
        join(*device, client);
    } else if (device && access == access_close) {
        leave(*device, client);
    } else {
        out.u32(access_error).count(0);
        return send(client, request, PlayerType::nack, out.take());
    }
    send(client, request, PlayerType::ack, out.u32(access).text(driver_name).take());
}

void PlayerFront::join(PlacedDevice& device, Client& client) {
    auto& users = device.users;
    if (std::find(users.begin(), users.end(), client.connection) != users.end()) return;
    users.push_back(client.connection);
    ++client.subscriptions;
    if (users.size() == 1) device.device->subscribed();
}

void PlayerFront::leave(PlacedDevice& device, Client& client) {
    if (std::erase(device.users, client.connection) == 0) return;
    --client.subscriptions;
    std::erase_if(deferred_, [&](const Deferred& each) {
        return each.device == &device && each.from == client.connection;
    });
    if (device.users.empty()) device.device->unsubscribed();
}

void PlayerFront::tell() {
    for (PlacedDevice& each : devices_->all()) tell_of(each);
    if (is_multiple(now(), player_tick)) {
        for (auto& [connection, client] : clients_) end_round(client);
    }
    go_on();
}

/// Sends the data of a device to the clients that are due.
void PlayerFront::tell_of(PlacedDevice& device) {
    const bool is_tick = is_multiple(now(), player_tick);
    const bool is_due = is_multiple(now(), device.device->period());
    const bool has_events = device.device->has_events();
    std::vector<Connection> told;
    for (const Connection user : device.users) {
        const Client& client = clients_.at(user);
        const bool wants = client.pulls ? is_tick && (client.asks || has_events) : is_due;
        if (wants) told.push_back(user);
    }
    if (told.empty()) return;
    for (std::string& payload : device.device->data()) {
        const PlayerMessage message{
            device.address, PlayerType::data, newest_data, seconds(now()), 0, std::move(payload)};
        for (const Connection user : told) {
            Client& client = clients_.at(user);
            std::string bytes = encode(message, client.at.port);
            client.pulls ? hold(client, std::move(bytes)) : carrier_.send(user, bytes);
        }
    }
}

/// Queues a message for the client's next PULL answer; drops the oldest one if the queue is full.
void PlayerFront::hold(Client& client, std::string message) {
    client.held_bytes += message.size();
    client.held.push_back(std::move(message));
    while (client.held.size() > most_held || client.held_bytes > most_bytes) {
        client.held_bytes -= client.held.front().size();
        client.held.pop_front();
        ++client.lost;
    }
}

/// Answers a client that has asked for data, if there is any.
void PlayerFront::end_round(Client& client) {
    if (!client.asks || client.held.empty()) return;
    std::string bytes;
    if (client.lost > 0) bytes = player_overflow(client.lost);
    for (const std::string& each : client.held) bytes += each;
    carrier_.send(client.connection, bytes + player_round_end());
    client.held.clear();
    client.held_bytes = 0;
    client.lost = 0;
    client.asks = false;
}

/// Executes deferred commands in the order of robots, and for each client in the order of arrival.
void PlayerFront::carry_out_deferred() {
    std::stable_sort(deferred_.begin(), deferred_.end(), [](const Deferred& a, const Deferred& b) {
        return std::pair(a.device->robot, a.from) < std::pair(b.device->robot, b.from);
    });
    deferred_bytes_ = 0;
    for (const Deferred& each : std::exchange(deferred_, {})) {
        try {
            each.device->device->command(each.message.subtype, XdrReader(each.message.payload));
        } catch (const MalformedMessage&) {
            // A command has no answer.
        }
    }
}

/// Whether, in lock-step, all clients in PULL mode have requested data, and enough clients are
/// connected.
bool PlayerFront::everyone_asks() const {
    std::size_t pulling = 0;
    for (const auto& [connection, client] : clients_) {
        if (!client.pulls || client.subscriptions == 0) continue;
        if (!client.asks) return false;
        ++pulling;
    }
    return pulling >= (has_begun_ ? 1 : settings_.wait_for);
}

/// Updates next() after any change.
void PlayerFront::go_on() {
    if (settings_.is_lockstep && everyone_asks()) {
        has_begun_ = true;
        carry_out_deferred();
    }
    next_ = never;
    for (const PlacedDevice& each : devices_->all()) {
        for (const Connection user : each.users) {
            const Client& client = clients_.at(user);
            if (!client.pulls) {
                next_ = std::min(next_, next_multiple(now(), each.device->period()));
            } else if (client.asks || each.device->has_events()) {
                next_ = std::min(next_, next_multiple(now(), player_tick));
            }
        }
    }
}

Time PlayerFront::limit() const {
    return settings_.is_lockstep && !everyone_asks() ? now() : never;
}

bool PlayerFront::is_done() const { return has_begun_ && clients_.empty(); }

}  // namespace rovernet
