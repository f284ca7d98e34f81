// SPDX-License-Identifier: MIT
#include "live/doors.hpp"

#include "live/child.hpp"
#include "sim/error.hpp"

#include <boost/asio.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <map>
#include <optional>
#include <stdexcept>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>
#include <utility>

namespace rovernet {
namespace {

namespace asio = boost::asio;
using boost::system::error_code;
using Clock = std::chrono::steady_clock;
using Socket = asio::generic::stream_protocol::socket;

constexpr std::size_t longest_line = std::size_t{1} << 20U;  // [bytes]
constexpr std::size_t most_input = std::size_t{64} << 20U;   // [bytes] of all connections
constexpr std::size_t most_connections = 500;
constexpr std::size_t portion = 16'384;  // [bytes] that one read takes
constexpr auto first_line_within = std::chrono::seconds(60);
constexpr auto accepts_again_after = std::chrono::milliseconds(100);

[[noreturn]] void fail_address(const std::string& address, const std::string& why) {
    throw std::invalid_argument(fmt::format(
        "{}: {}; expected an address of this machine alone, such as 127.0.0.1:7007", address, why));
}

asio::ip::tcp::endpoint loopback(const std::string& address) {
    const std::size_t colon = address.rfind(':');
    if (colon == std::string::npos) fail_address(address, "found no port");
    std::string host = address.substr(0, colon);
    const std::string port = address.substr(colon + 1);
    if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
    if (host == "localhost") host = "127.0.0.1";
    constexpr unsigned long last_port = 65'535;
    const bool is_number = !port.empty() && port.size() <= 5 &&
                           port.find_first_not_of("0123456789") == std::string::npos;
    if (!is_number || std::stoul(port) > last_port) {
        fail_address(address, fmt::format("found the port \"{}\"", port));
    }
    error_code error;
    const auto ip = asio::ip::make_address(host, error);
    if (error) fail_address(address, fmt::format("found the host \"{}\"", host));
    if (!ip.is_loopback()) fail_address(address, "this door has no password");
    return {ip, static_cast<std::uint16_t>(std::stoul(port))};
}

}  // namespace

/// One controller's connection.
struct Link {
    Link(Socket taken, Doors::Connection number) : socket(std::move(taken)), id(number) {}

    Socket socket;
    Doors::Connection id;
    Clock::time_point since = Clock::now();
    std::string input, sending, queued;
    std::size_t searched = 0;  // of the input: there is no end of line
    bool has_spoken = false;   // a whole line
    bool is_reading = false, is_writing = false;
    bool is_answered = true;  // its last line
    bool has_ended = false;   // no more comes in
    bool is_closing = false;  // once all is out
};

struct Doors::State {
    explicit State(Users given) : users(std::move(given)) {}

    using Shared = std::shared_ptr<Link>;

    void add(Socket socket) {
        if (links.size() >= most_connections) return;
        const auto link = std::make_shared<Link>(std::move(socket), next++);
        links[link->id] = link;
        read(link);
    }

    template <class Acceptor>
    void accept(Acceptor& acceptor) {
        acceptor.async_accept([this, &acceptor](error_code error, auto socket) {
            if (error == asio::error::operation_aborted) return;
            if (!error) {
                add_accepted(std::move(socket));
                return accept(acceptor);
            }
            // No descriptor is free, say: that passes.
            auto timer = std::make_shared<asio::steady_timer>(io, accepts_again_after);
            timer->async_wait([this, &acceptor, timer](error_code) { accept(acceptor); });
        });
    }
    void add_accepted(asio::ip::tcp::socket socket) {
        error_code ignored;
        socket.set_option(asio::ip::tcp::no_delay(true), ignored);
        socket.set_option(asio::socket_base::keep_alive(true), ignored);
        add(std::move(socket));
    }
    void add_accepted(asio::local::stream_protocol::socket socket) { add(std::move(socket)); }

    void read(const Shared& link) {
        if (link->is_reading || link->is_writing || link->has_ended || link->is_closing) return;
        if (link->input.size() > longest_line) return;
        link->is_reading = true;
        link->socket.async_wait(Socket::wait_read,
                                [this, link](error_code error) { take_in(link, error); });
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
        }
        if (error) link->has_ended = true;
        serve(link);
    }

    std::size_t input_of_all() const {
        std::size_t bytes = 0;
        for (const auto& [id, link] : links) bytes += link->input.size();
        return bytes;
    }

    /// Hands over the next line, if the last one is answered; then goes on reading.
    void serve(const Shared& link) {
        const bool may_speak = link->is_answered && !link->is_writing && !link->is_closing;
        if (may_speak) hand_over(link);
        const bool has_spoken_now = may_speak && !link->is_answered;
        const bool is_out = link->has_ended && !link->is_writing && !has_line(*link);
        if (is_out && !has_spoken_now) return close(link);
        read(link);
    }

    static bool has_line(Link& link) {
        const std::size_t end = link.input.find('\n', link.searched);
        link.searched = std::min(end, link.input.size());
        return end != std::string::npos;
    }

    void hand_over(const Shared& link) {
        if (!has_line(*link)) {
            const bool is_long = link->input.size() > longest_line;
            if (is_long || (link->input.size() > portion && input_of_all() > most_input)) {
                refuse(link);
            }
            return;
        }
        std::size_t length = link->searched;
        if (length > longest_line) return refuse(link);
        std::string line = link->input.substr(0, length);
        link->input.erase(0, length + 1);
        link->searched = 0;
        if (link->input.empty()) link->input.shrink_to_fit();
        if (line.ends_with('\r')) line.pop_back();
        link->has_spoken = true;
        link->is_answered = false;
        users.line(link->id, line);
    }

    void refuse(const Shared& link) {
        link->input.clear();
        link->input.shrink_to_fit();
        users.refuse(link->id,
                     RequestError("too_long", "",
                                  fmt::format("expected lines of {} bytes at most", longest_line)));
        link->is_closing = true;
    }

    void write(const Shared& link) {
        link->is_writing = true;
        link->sending = std::exchange(link->queued, {});
        asio::async_write(link->socket, asio::buffer(link->sending),
                          [this, link](error_code error, std::size_t) {
                              link->is_writing = false;
                              if (!links.contains(link->id)) return;
                              if (error) return close(link);
                              if (!link->queued.empty()) return write(link);
                              if (link->is_closing) return close(link);
                              serve(link);
                          });
    }

    /// @param link  not the one in `links`, which goes
    void close(const Shared& link) {
        if (links.erase(link->id) == 0) return;
        error_code ignored;
        link->socket.shutdown(Socket::shutdown_both, ignored);
        link->socket.close(ignored);
        users.closed(link->id);
    }

    /// Closes connections that have not said a line for too long.
    void close_silent() {
        const auto now = Clock::now();
        if (now - looked < std::chrono::seconds(1)) return;
        looked = now;
        std::vector<Shared> silent;
        for (const auto& [id, link] : links) {
            if (!link->has_spoken && now - link->since > first_line_within) silent.push_back(link);
        }
        for (const auto& link : silent) close(link);
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
    std::optional<asio::ip::tcp::acceptor> tcp;
    std::optional<asio::local::stream_protocol::acceptor> local;
    std::string unix_path;
    Clock::time_point looked = Clock::now();
};

Doors::Doors(Users users) : state_(std::make_unique<State>(std::move(users))) {}

Doors::~Doors() {
    if (!state_->unix_path.empty()) unlink(state_->unix_path.c_str());
}

void Doors::start(const std::string& command) {
    Child child(command);
    Socket socket(state_->io);
    socket.assign(asio::generic::stream_protocol(AF_UNIX, 0), child.take_socket());
    state_->children.push_back(std::move(child));
    state_->add(std::move(socket));
    state_->links.rbegin()->second->has_spoken = true;  // it may take its time
}

std::string Doors::listen(const std::string& address) {
    const auto endpoint = loopback(address);
    try {
        auto& acceptor = state_->tcp.emplace(state_->io, endpoint);
        state_->accept(acceptor);
        const auto bound = acceptor.local_endpoint();
        const std::string host = bound.address().to_string();
        return fmt::format("{}:{}", bound.address().is_v6() ? "[" + host + "]" : host,
                           bound.port());
    } catch (const boost::system::system_error& fault) {
        throw RunError(fmt::format("{}: {}", address, fault.code().message()));
    }
}

void Doors::listen_unix(const std::string& path) {
    if (path.empty() || path.size() >= sizeof(sockaddr_un::sun_path)) {
        throw std::invalid_argument(fmt::format("{}: expected a path of 1 to {} bytes", path,
                                                sizeof(sockaddr_un::sun_path) - 1));
    }
    const asio::local::stream_protocol::endpoint endpoint(path);
    struct stat found {};
    if (lstat(path.c_str(), &found) == 0) {
        asio::local::stream_protocol::socket probe(state_->io);
        error_code error;
        probe.connect(endpoint, error);
        if (!S_ISSOCK(found.st_mode) || !error) throw RunError(path + ": is there already");
        unlink(path.c_str());
    }
    const mode_t mask = umask(0077);
    try {
        auto& acceptor = state_->local.emplace(state_->io, endpoint);
        umask(mask);
        state_->unix_path = path;
        state_->accept(acceptor);
    } catch (const boost::system::system_error& fault) {
        umask(mask);
        throw RunError(fmt::format("{}: {}", path, fault.code().message()));
    }
}

void Doors::send(Connection to, std::string_view line) {
    const auto found = state_->links.find(to);
    if (found == state_->links.end()) return;
    Link& link = *found->second;
    link.queued += line;
    link.queued += '\n';
    link.is_answered = true;
    if (!link.is_writing) state_->write(found->second);
}

std::size_t Doors::connections() const { return state_->links.size(); }
bool Doors::listens() const { return state_->tcp || state_->local; }

void Doors::wait(std::chrono::milliseconds most) {
    // One event at a time: a question is answered before its asker is seen to have gone.
    state_->io.run_one_for(most);
    state_->close_silent();
}

std::vector<std::string> Doors::close(std::chrono::milliseconds most) {
    const auto until = Clock::now() + most;
    while (state_->has_output() && Clock::now() < until) {
        state_->io.run_one_for(std::chrono::milliseconds(10));
    }
    state_->users = {
        .line = [](auto, auto) {}, .refuse = [](auto, auto&) {}, .closed = [](auto) {}};
    while (!state_->links.empty()) {
        const State::Shared link = state_->links.begin()->second;  // close() takes it off the table
        state_->close(link);
    }
    std::vector<std::string> failed;
    for (Child& child : state_->children) {
        if (auto fault = child.wait(most); !fault.empty()) failed.push_back(std::move(fault));
    }
    return failed;
}

}  // namespace rovernet
