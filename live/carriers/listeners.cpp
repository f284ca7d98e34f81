// SPDX-License-Identifier: MIT
#include "live/carriers/listeners.hpp"

#include "files/left_behind.hpp"
#include "live/carriers/acceptor.hpp"
#include "live/carriers/child.hpp"
#include "live/carriers/client_connection.hpp"

#include <boost/asio.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <list>
#include <map>
#include <optional>
#include <unistd.h>
#include <utility>

namespace rovernet {
namespace {

namespace asio = boost::asio;
using boost::system::error_code;
using Clock = ClientConnection::Clock;
using Socket = ClientConnection::Socket;

constexpr std::size_t longest_line = std::size_t{1} << 20U;  // [bytes]
constexpr std::size_t most_input = std::size_t{64} << 20U;   // [bytes] of all connections
constexpr std::size_t most_connections = 500;
constexpr std::size_t most_messages = 1'024;                   // queued messages of a stream
constexpr std::size_t most_waiting = std::size_t{4} << 20U;    // [bytes] of queued messages
constexpr std::size_t much_waiting = std::size_t{256} << 10U;  // [bytes] that stop the reading
constexpr int stream_buffer = 256 << 10;  // [bytes] of the socket; small, as messages grow old
constexpr std::size_t portion = 16'384;   // [bytes] of one read
constexpr auto first_line_within = std::chrono::seconds(60);
constexpr auto closing_time = std::chrono::seconds(1);

}  // namespace

struct Listeners::State {
    using Shared = std::shared_ptr<ClientConnection>;

    /// Descriptor owned by the caller, with the function to call when it is readable.
    struct Watch {
        asio::posix::stream_descriptor descriptor;
        std::function<bool()> readable;
    };
    using Watched = std::shared_ptr<Watch>;

    /// @return the new connection; null if there is no room for it
    Shared add(Socket socket, const Streams& streams) {
        if (clients.size() >= most_connections && !make_room()) return nullptr;
        const auto client = std::make_shared<ClientConnection>(std::move(socket), next++, streams);
        clients[client->id] = client;
        streams.opened(client->id);
        read(client);
        return client;
    }

    /// Closes the oldest connection that has sent nothing. @return whether there was one
    bool make_room() {
        const auto silent = std::find_if(clients.begin(), clients.end(),
                                         [](const auto& each) { return !each.second->has_sent; });
        if (silent == clients.end()) return false;
        const Shared client = silent->second;  // close() takes it off the table
        close(client);
        return true;
    }

    template <class Acceptor>
    void accept(Acceptor& acceptor, const Streams& streams) {
        accept_all(acceptor, [this, &streams](auto socket) {
            prepare(socket, streams);
            add(std::move(socket), streams);
        });
    }
    static void prepare(asio::ip::tcp::socket& socket, const Streams& streams) {
        error_code ignored;
        socket.set_option(asio::ip::tcp::no_delay(true), ignored);
        keep_alive(socket.native_handle());
        if (streams.line_error) return;
        socket.set_option(asio::socket_base::send_buffer_size(stream_buffer), ignored);
    }
    static void prepare(asio::local::stream_protocol::socket&, const Streams&) {}

    static bool is_busy(const ClientConnection& client) {
        if (client.carries_lines()) return client.is_writing || client.input.size() > longest_line;
        return client.sending.size() + client.queued.size() > much_waiting;
    }

    void read(const Shared& client) {
        if (client->is_reading || client->has_ended || client->is_closing || is_busy(*client))
            return;
        client->is_reading = true;
        if (client->rate.read_again() > Clock::now()) return read_later(*this, client);
        client->socket.async_wait(Socket::wait_read,
                                  [this, client](error_code error) { take_in(client, error); });
    }

    /// Reads the available bytes. Memory is allocated only now, so that idle connections need none.
    void take_in(const Shared& client, error_code error) {
        client->is_reading = false;
        if (!clients.contains(client->id)) return;
        if (!error) {
            const std::size_t before = client->input.size();
            client->input.resize(before + portion);
            const std::size_t got = client->socket.read_some(
                asio::buffer(client->input.data() + before, portion), error);
            client->input.resize(before + got);
            if (!client->carries_lines()) acknowledge_at_once(client->socket.native_handle());
        }
        if (error) client->has_ended = true;
        serve(client);
    }

    std::size_t input_of_all() const {
        std::size_t bytes = 0;
        for (const auto& [id, client] : clients) bytes += client->input.size();
        return bytes;
    }

    /// Passes on the next line, if the previous one is answered, or all bytes; then continues
    /// reading.
    void serve(const Shared& client) {
        if (!client->carries_lines()) return serve_stream(client);
        const bool may_speak = client->is_answered && !client->is_writing && !client->is_closing;
        if (may_speak) hand_over(client);
        const bool has_spoken_now = may_speak && !client->is_answered;
        const bool is_out = client->has_ended && !client->is_writing && !client->has_line();
        if (is_out && !has_spoken_now) return close(client);
        read(client);
    }

    void serve_stream(const Shared& client) {
        const std::string bytes = std::exchange(client->input, {});
        if (!bytes.empty() && !client->is_closing) {
            const std::size_t messages = client->streams.received(client->id, bytes);
            if (messages > 0) client->has_sent = true;
            if (client->streams.has_rate) client->rate.add(messages, bytes.size(), Clock::now());
        }
        if (!client->has_ended) return read(client);
        client->is_closing = true;
        if (!client->is_writing) close(client);
    }

    void hand_over(const Shared& client) {
        if (!client->has_sent && client->cannot_be_json()) {
            return refuse(client, client->not_json_error());
        }
        if (!client->has_line()) {
            const bool is_long = client->input.size() > longest_line;
            if (is_long || (client->input.size() > portion && input_of_all() > most_input)) {
                refuse_long(client);
            }
            return;
        }
        std::size_t length = client->searched;
        if (length > longest_line) return refuse_long(client);
        std::string line = client->input.substr(0, length);
        client->input.erase(0, length + 1);
        client->searched = 0;
        if (client->input.empty()) client->input.shrink_to_fit();
        if (line.ends_with('\r')) line.pop_back();
        const bool is_first = !std::exchange(client->has_sent, true);
        client->is_answered = false;
        if (client->streams.received(client->id, line) == 0 && is_first) client->is_closing = true;
    }

    void refuse_long(const Shared& client) {
        refuse(client,
               RequestError("too_long", "",
                            fmt::format("expected lines of {} bytes at most", longest_line)));
    }

    /// Sends an error to a client, ignores further input, and closes the connection once the error
    /// is sent.
    void refuse(const Shared& client, const RequestError& why) {
        client->input.clear();
        client->input.shrink_to_fit();
        client->is_closing = true;
        send_line(client, client->streams.line_error(why));
    }

    /// Answers the last line of a client.
    void send_line(const Shared& client, std::string_view line) {
        client->queued += line;
        client->queued += '\n';
        client->is_answered = true;
        if (!client->is_writing) write(client);
    }

    void write(const Shared& client) {
        client->is_writing = true;
        client->messages = 0;
        client->sending = std::exchange(client->queued, {});
        asio::async_write(client->socket, asio::buffer(client->sending),
                          [this, client](error_code error, std::size_t) {
                              client->is_writing = false;
                              client->sending.clear();
                              if (!clients.contains(client->id)) return;
                              if (error) return close(client);
                              if (!client->queued.empty()) return write(client);
                              if (client->is_closing) return close(client);
                              serve(client);
                          });
    }

    /// Queues a message of a stream. A client that does not read is disconnected.
    void queue(const Shared& client, std::string_view message) {
        if (client->is_closing) return;
        client->queued += message;
        ++client->messages;
        if (client->messages > most_messages || client->queued.size() > most_waiting) {
            client->is_closing = true;
            client->closes_at = Clock::now() + closing_time;
            client->queued = client->streams.closing_message(client->messages);
        }
        if (!client->is_writing) write(client);
    }

    void close_later(const Shared& client) {
        asio::post(io, [this, client] { close(client); });
    }

    /// @param client  not the one in `clients`, which goes
    void close(const Shared& client) {
        if (clients.erase(client->id) == 0) return;
        error_code ignored;
        client->socket.shutdown(Socket::shutdown_both, ignored);
        client->socket.close(ignored);
        client->streams.closed(client->id);
    }

    /// Makes wait() return at this time with microsecond accuracy; epoll timeouts are in
    /// milliseconds.
    void ring_at(Clock::time_point time) {
        if (rings_at <= time) return;
        rings_at = time;
        alarm.expires_at(time);
        alarm.async_wait([this](error_code error) {
            if (!error) rings_at = Clock::time_point::max();
        });
    }

    void watch(const Watched& watched) {
        watched->descriptor.async_wait(asio::posix::stream_descriptor::wait_read,
                                       [this, watched](error_code error) {
                                           if (error || has_closed) return;
                                           if (watched->readable()) watch(watched);
                                       });
    }

    /// Closes connections that have not sent or not read anything for too long.
    void close_idle() {
        const auto now = Clock::now();
        if (now - looked < closing_time) return;
        looked = now;
        std::vector<Shared> idle;
        for (const auto& [id, client] : clients) {
            const bool is_silent = !client->has_sent && now - client->since > first_line_within;
            if (is_silent || now >= client->closes_at) idle.push_back(client);
        }
        for (const auto& client : idle) close(client);
    }

    bool has_output(bool of_lines_only) const {
        return std::any_of(clients.begin(), clients.end(), [&](const auto& each) {
            const ClientConnection& client = *each.second;
            if (of_lines_only && !client.carries_lines()) return false;
            return client.is_writing || !client.queued.empty();
        });
    }

    asio::io_context io{1};
    asio::executor_work_guard<asio::io_context::executor_type> work = asio::make_work_guard(io);
    std::map<Connection, Shared> clients;
    Connection next = 0;
    std::vector<Child> children;
    std::list<Streams> users;  // clients refer to them
    std::list<asio::ip::tcp::acceptor> acceptors;
    std::optional<asio::local::stream_protocol::acceptor> local;
    std::optional<NotedFile> unix_path;
    Clock::time_point looked = Clock::now();
    bool has_closed = false;
    asio::steady_timer alarm{io};
    Clock::time_point rings_at = Clock::time_point::max();
};

Listeners::Listeners() : state_(std::make_unique<State>()) {}

Listeners::~Listeners() { Child::end(state_->children); }

std::optional<Listeners::Connection> Listeners::start(const std::string& command, Streams streams) {
    if (state_->children.size() >= most_connections) {
        throw RunError(fmt::format("{}: cannot start this program; expected {} programs at most",
                                   command, most_connections));
    }
    Child child(command);
    Socket socket(state_->io);
    socket.assign(asio::generic::stream_protocol(AF_UNIX, 0), child.take_socket());
    state_->children.push_back(std::move(child));
    const auto client =
        state_->add(std::move(socket), state_->users.emplace_back(std::move(streams)));
    if (!client) return std::nullopt;
    client->has_sent = true;  // it may take its time
    return client->id;
}

Address Listeners::listen(const Address& address, Streams streams) {
    auto& acceptor = state_->acceptors.emplace_back(listen_on(state_->io, address));
    state_->accept(acceptor, state_->users.emplace_back(std::move(streams)));
    return {address.host, acceptor.local_endpoint().port()};
}

void Listeners::listen_unix(const std::string& path, Streams streams) {
    state_->local.emplace(listen_on_path(state_->io, path));
    state_->unix_path.emplace(path);
    state_->accept(*state_->local, state_->users.emplace_back(std::move(streams)));
}

void Listeners::watch(int descriptor, std::function<bool()> readable) {
    const int own = dup(descriptor);  // the other is closed by whoever has opened it
    if (own < 0) throw RunError(std::strerror(errno));
    state_->watch(std::make_shared<State::Watch>(
        State::Watch{asio::posix::stream_descriptor(state_->io, own), std::move(readable)}));
}

void Listeners::send(Connection to, std::string_view message) {
    const auto found = state_->clients.find(to);
    if (found == state_->clients.end()) return;
    found->second->carries_lines() ? state_->send_line(found->second, message)
                                   : state_->queue(found->second, message);
}

void Listeners::close(Connection which) {
    const auto found = state_->clients.find(which);
    if (found == state_->clients.end()) return;
    found->second->is_closing = true;
    if (!found->second->is_writing) state_->close_later(found->second);
}

boost::asio::io_context& Listeners::io() { return state_->io; }

void Listeners::wait(std::chrono::nanoseconds most) {
    // One event at a time, so that a request is answered before the end of its connection is
    // handled.
    if (most <= most.zero()) {
        state_->io.poll_one();
    } else {
        state_->ring_at(Clock::now() + most);
        state_->io.run_one();
    }
    state_->close_idle();
}

std::vector<std::string> Listeners::close(std::chrono::milliseconds soon,
                                          std::chrono::milliseconds most) {
    state_->has_closed = true;
    for (Streams& users : state_->users) {  // nobody is told any more
        users.opened = users.closed = [](auto) {};
        users.received = [](auto, auto) { return std::size_t{1}; };
    }
    const auto begun = Clock::now();
    while (state_->has_output(Clock::now() >= begun + soon) && Clock::now() < begun + most) {
        state_->io.run_one_for(std::chrono::milliseconds(10));
    }
    while (!state_->clients.empty()) {
        const State::Shared client =
            state_->clients.begin()->second;  // close() takes it off the table
        state_->close(client);
    }
    std::vector<std::string> failed;
    const auto last = Clock::now() + most;
    for (Child& child : state_->children) {
        if (auto fault = child.wait_until(last); !fault.empty()) failed.push_back(std::move(fault));
    }
    Child::end(state_->children);
    return failed;
}

}  // namespace rovernet
