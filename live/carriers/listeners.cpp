// SPDX-License-Identifier: MIT
#include "live/carriers/listeners.hpp"

#include "live/carriers/acceptor.hpp"
#include "live/carriers/address.hpp"
#include "live/carriers/child.hpp"
#include "live/carriers/client_connection.hpp"
#include "live/carriers/left_behind.hpp"
#include "sim/error.hpp"

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
using Clock = DoorLink::Clock;
using Socket = DoorLink::Socket;

constexpr std::size_t longest_line = std::size_t{1} << 20U;  // [bytes]
constexpr std::size_t most_input = std::size_t{64} << 20U;   // [bytes] of all connections
constexpr std::size_t most_connections = 500;
constexpr std::size_t most_messages = 1'024;                   // that wait in a stream
constexpr std::size_t most_waiting = std::size_t{4} << 20U;    // [bytes] the same
constexpr std::size_t much_waiting = std::size_t{256} << 10U;  // [bytes] then it is not read
constexpr int stream_buffer = 256 << 10;  // [bytes] of the system: what it holds gets old
constexpr std::size_t portion = 16'384;   // [bytes] that one read takes
constexpr auto first_line_within = std::chrono::seconds(60);
constexpr auto farewell_within = std::chrono::seconds(1);

}  // namespace

struct Doors::State {
    explicit State(Users given) : users(std::move(given)) {}

    using Shared = std::shared_ptr<DoorLink>;

    /// An address of TCP, and who is told of those who come in there; nobody: they carry lines.
    struct Gate {
        asio::ip::tcp::acceptor acceptor;
        std::optional<Streams> streams = {};
    };

    /// A descriptor of somebody else, who is told when it can be read.
    struct Watch {
        asio::posix::stream_descriptor descriptor;
        std::function<bool()> readable;
    };
    using Watched = std::shared_ptr<Watch>;

    void add(Socket socket, const Streams* streams = nullptr) {
        if (links.size() >= most_connections && !make_room()) return;
        const auto link = std::make_shared<DoorLink>(std::move(socket), next++, streams);
        links[link->id] = link;
        if (streams) streams->opened(link->id);
        read(link);
    }

    /// Closes the oldest connection that has said nothing. @return whether there was one
    bool make_room() {
        const auto silent = std::find_if(links.begin(), links.end(),
                                         [](const auto& each) { return !each.second->has_spoken; });
        if (silent == links.end()) return false;
        const Shared link = silent->second;  // close() takes it off the table
        close(link);
        return true;
    }

    template <class Acceptor>
    void accept(Acceptor& acceptor, const Streams* streams = nullptr) {
        accept_all(acceptor, [this, streams](auto socket) {
            prepare(socket, streams);
            add(std::move(socket), streams);
        });
    }
    static void prepare(asio::ip::tcp::socket& socket, const Streams* streams) {
        error_code ignored;
        socket.set_option(asio::ip::tcp::no_delay(true), ignored);
        keep_alive(socket.native_handle());
        if (!streams) return;
        socket.set_option(asio::socket_base::send_buffer_size(stream_buffer), ignored);
    }
    static void prepare(asio::local::stream_protocol::socket&, const Streams*) {}

    static bool is_busy(const DoorLink& link) {
        if (link.streams) return link.sending.size() + link.queued.size() > much_waiting;
        return link.is_writing || link.input.size() > longest_line;
    }

    void read(const Shared& link) {
        if (link->is_reading || link->has_ended || link->is_closing || is_busy(*link)) return;
        link->is_reading = true;
        if (link->rate.read_again() > Clock::now()) return read_later(link);
        link->socket.async_wait(Socket::wait_read,
                                [this, link](error_code error) { take_in(link, error); });
    }

    /// Goes on reading once the client may say more.
    void read_later(const Shared& link) {
        const auto pause = std::make_shared<asio::steady_timer>(io, link->rate.read_again());
        pause->async_wait([this, link, pause](error_code) {
            link->is_reading = false;
            if (links.contains(link->id)) read(link);
        });
    }

    /// Takes what has come in. Memory is made only now, so that an idle connection has none.
    void take_in(const Shared& link, error_code error) {
        link->is_reading = false;
        if (!links.contains(link->id)) return;
        if (!error) {
            const std::size_t before = link->input.size();
            link->input.resize(before + portion);
            const std::size_t got =
                link->socket.read_some(asio::buffer(link->input.data() + before, portion), error);
            link->input.resize(before + got);
            if (link->streams) acknowledge_at_once(link->socket.native_handle());
        }
        if (error) link->has_ended = true;
        serve(link);
    }

    std::size_t input_of_all() const {
        std::size_t bytes = 0;
        for (const auto& [id, link] : links) bytes += link->input.size();
        return bytes;
    }

    /// Hands over the next line, if the last one is answered, or all bytes; then goes on reading.
    void serve(const Shared& link) {
        if (link->streams) return serve_stream(link);
        const bool may_speak = link->is_answered && !link->is_writing && !link->is_closing;
        if (may_speak) hand_over(link);
        const bool has_spoken_now = may_speak && !link->is_answered;
        const bool is_out = link->has_ended && !link->is_writing && !link->has_line();
        if (is_out && !has_spoken_now) return close(link);
        read(link);
    }

    void serve_stream(const Shared& link) {
        const std::string bytes = std::exchange(link->input, {});
        if (!bytes.empty() && !link->is_closing) {
            const std::size_t messages = link->streams->received(link->id, bytes);
            if (messages > 0) link->has_spoken = true;
            if (link->streams->has_rate) link->rate.add(messages, bytes.size(), Clock::now());
        }
        if (!link->has_ended) return read(link);
        link->is_closing = true;
        if (!link->is_writing) close(link);
    }

    void hand_over(const Shared& link) {
        if (!link->has_spoken && link->begins_strangely()) {
            return refuse(link, link->strange_beginning());
        }
        if (!link->has_line()) {
            const bool is_long = link->input.size() > longest_line;
            if (is_long || (link->input.size() > portion && input_of_all() > most_input)) {
                refuse_long(link);
            }
            return;
        }
        std::size_t length = link->searched;
        if (length > longest_line) return refuse_long(link);
        std::string line = link->input.substr(0, length);
        link->input.erase(0, length + 1);
        link->searched = 0;
        if (link->input.empty()) link->input.shrink_to_fit();
        if (line.ends_with('\r')) line.pop_back();
        const bool is_first = !std::exchange(link->has_spoken, true);
        link->is_answered = false;
        if (!users.line(link->id, line) && is_first) link->is_closing = true;
    }

    void refuse_long(const Shared& link) {
        refuse(link, RequestError("too_long", "",
                                  fmt::format("expected lines of {} bytes at most", longest_line)));
    }

    /// Tells a client what is wrong, obeys nothing any more, and closes once it is told.
    void refuse(const Shared& link, const RequestError& why) {
        link->input.clear();
        link->input.shrink_to_fit();
        link->is_closing = true;
        users.refuse(link->id, why);
    }

    void write(const Shared& link) {
        link->is_writing = true;
        link->messages = 0;
        link->sending = std::exchange(link->queued, {});
        asio::async_write(link->socket, asio::buffer(link->sending),
                          [this, link](error_code error, std::size_t) {
                              link->is_writing = false;
                              link->sending.clear();
                              if (!links.contains(link->id)) return;
                              if (error) return close(link);
                              if (!link->queued.empty()) return write(link);
                              if (link->is_closing) return close(link);
                              serve(link);
                          });
    }

    /// Adds a message to those that wait in a stream. A client that takes none is closed.
    void queue(const Shared& link, std::string_view message) {
        if (link->is_closing) return;
        link->queued += message;
        ++link->messages;
        if (link->messages > most_messages || link->queued.size() > most_waiting) {
            link->is_closing = true;
            link->closes_at = Clock::now() + farewell_within;
            link->queued = link->streams->farewell(link->messages);
        }
        if (!link->is_writing) write(link);
    }

    void close_later(const Shared& link) {
        asio::post(io, [this, link] { close(link); });
    }

    /// @param link  not the one in `links`, which goes
    void close(const Shared& link) {
        if (links.erase(link->id) == 0) return;
        error_code ignored;
        link->socket.shutdown(Socket::shutdown_both, ignored);
        link->socket.close(ignored);
        link->streams ? link->streams->closed(link->id) : users.closed(link->id);
    }

    /// Listens on an address. @return it, with its port
    Address listen(const Address& address, std::optional<Streams> streams) {
        gates.push_back({listen_on(io, address), std::move(streams)});
        Gate& gate = gates.back();
        accept(gate.acceptor, gate.streams ? &*gate.streams : nullptr);
        return {address.host, gate.acceptor.local_endpoint().port()};
    }

    /// Has wait() return at that time, to the microsecond: epoll counts in milliseconds.
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

    /// Closes connections that have said nothing or taken nothing for too long.
    void close_idle() {
        const auto now = Clock::now();
        if (now - looked < farewell_within) return;
        looked = now;
        std::vector<Shared> idle;
        for (const auto& [id, link] : links) {
            const bool is_silent = !link->has_spoken && now - link->since > first_line_within;
            if (is_silent || now >= link->closes_at) idle.push_back(link);
        }
        for (const auto& link : idle) close(link);
    }

    bool has_output() const {
        return std::any_of(links.begin(), links.end(), [](const auto& each) {
            return each.second->is_writing || !each.second->queued.empty();
        });
    }

    Users users;
    asio::io_context io{1};
    asio::executor_work_guard<asio::io_context::executor_type> work = asio::make_work_guard(io);
    std::map<Connection, Shared> links;
    Connection next = 0;
    std::vector<Child> children;
    std::list<Gate> gates;  // links refer to them
    std::optional<asio::local::stream_protocol::acceptor> local;
    std::optional<NotedFile> unix_path;
    Clock::time_point looked = Clock::now();
    bool has_closed = false;
    asio::steady_timer alarm{io};
    Clock::time_point rings_at = Clock::time_point::max();
};

Doors::Doors(Users users) : state_(std::make_unique<State>(std::move(users))) {}

Doors::~Doors() { Child::end(state_->children); }

void Doors::start(const std::string& command) {
    if (state_->children.size() >= most_connections) {
        throw RunError(fmt::format("{}: expected {} programs at most", command, most_connections));
    }
    Child child(command);
    Socket socket(state_->io);
    socket.assign(asio::generic::stream_protocol(AF_UNIX, 0), child.take_socket());
    state_->children.push_back(std::move(child));
    state_->add(std::move(socket));
    state_->links.rbegin()->second->has_spoken = true;  // it may take its time
}

Address Doors::listen(const Address& address) { return state_->listen(address, std::nullopt); }

Address Doors::listen(const Address& address, Streams streams) {
    return state_->listen(address, std::move(streams));
}

void Doors::listen_unix(const std::string& path) {
    state_->local.emplace(listen_on_path(state_->io, path));
    state_->unix_path.emplace(path);
    state_->accept(*state_->local);
}

void Doors::watch(int descriptor, std::function<bool()> readable) {
    const int own = dup(descriptor);  // the other is closed by whoever has opened it
    if (own < 0) throw RunError(std::strerror(errno));
    state_->watch(std::make_shared<State::Watch>(
        State::Watch{asio::posix::stream_descriptor(state_->io, own), std::move(readable)}));
}

void Doors::send(Connection to, std::string_view message) {
    const auto found = state_->links.find(to);
    if (found == state_->links.end()) return;
    DoorLink& link = *found->second;
    if (link.streams) return state_->queue(found->second, message);
    link.queued += message;
    link.queued += '\n';
    link.is_answered = true;
    if (!link.is_writing) state_->write(found->second);
}

void Doors::close(Connection which) {
    const auto found = state_->links.find(which);
    if (found == state_->links.end()) return;
    found->second->is_closing = true;
    if (!found->second->is_writing) state_->close_later(found->second);
}

std::size_t Doors::connections() const { return state_->links.size(); }
bool Doors::listens() const { return !state_->gates.empty() || state_->local; }

boost::asio::io_context& Doors::io() { return state_->io; }

void Doors::wait(std::chrono::nanoseconds most) {
    // One event at a time: a question is answered before its asker is seen to have gone.
    if (most <= most.zero()) {
        state_->io.poll_one();
    } else {
        state_->ring_at(Clock::now() + most);
        state_->io.run_one();
    }
    state_->close_idle();
}

std::vector<std::string> Doors::close(std::chrono::milliseconds most) {
    state_->has_closed = true;
    state_->users = {.line = [](auto, auto) { return true; },
                     .refuse = [](auto, auto&) {},
                     .closed = [](auto) {}};
    for (State::Gate& gate : state_->gates) {
        if (gate.streams) gate.streams.emplace();  // nobody is told any more
    }
    const auto until = Clock::now() + most;
    while (state_->has_output() && Clock::now() < until) {
        state_->io.run_one_for(std::chrono::milliseconds(10));
    }
    while (!state_->links.empty()) {
        const State::Shared link = state_->links.begin()->second;  // close() takes it off the table
        state_->close(link);
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
