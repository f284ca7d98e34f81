// SPDX-License-Identifier: MIT
#include "live/carriers/web_sockets.hpp"

#include "experiment/version.hpp"
#include "live/carriers/acceptor.hpp"
#include "live/carriers/admission.hpp"
#include "live/carriers/http_request.hpp"
#include "live/carriers/input_rate.hpp"
#include "live/carriers/page_fields.hpp"

#include <boost/asio.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <list>
#include <map>
#include <optional>
#include <simdjson.h>
#include <utility>

namespace rovernet {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using boost::system::error_code;
using websocket::close_code;
using Clock = std::chrono::steady_clock;

constexpr std::uint32_t longest_request = 8U << 10U;          // [bytes]
constexpr std::size_t longest_input = std::size_t{1} << 20U;  // [bytes] of a client
constexpr std::size_t most_input = std::size_t{64} << 20U;    // [bytes] of all clients
constexpr std::size_t most_connections = 500;
constexpr std::size_t most_messages = 1'024;                   // queued messages of a client
constexpr std::size_t most_waiting = std::size_t{4} << 20U;    // [bytes] of queued messages
constexpr std::size_t much_waiting = std::size_t{256} << 10U;  // [bytes]; then input is not read
constexpr int system_buffer = 256 << 10;  // [bytes] of a socket; small, as messages become outdated
constexpr std::size_t portion = 16'384;   // [bytes] of one read

struct Output {
    std::string bytes;
    bool is_text;
};

/// Listener with its access rule, the handlers of its connections, and its pages.
struct Gate {
    asio::ip::tcp::acceptor acceptor;
    Admission admission;
    Listeners::Streams users;
    WebPages pages;
};

/// Reason why the admission rule of a gate rejects a request; empty if it is accepted.
std::string refusal(const Gate& gate, const HttpRequest& request) {
    WebRequest asked{text_of(request.target()), text_of(request[http::field::host])};
    if (const auto origin = request.find(http::field::origin); origin != request.end())
        asked.origin = text_of(origin->value());
    return gate.admission.refusal(asked);
}

/// One client's connection.
struct Client {
    Client(asio::ip::tcp::socket socket, WebSockets::Connection number, const Gate& entered)
        : stream(std::move(socket)), id(number), gate(entered) {}

    websocket::stream<beast::tcp_stream> stream;
    WebSockets::Connection id;
    const Gate& gate;
    http::request_parser<http::empty_body> request = {};
    http::response<http::string_body> response = {};  // of a request that opens no WebSocket
    beast::flat_buffer input = {};
    InputRate rate = {};
    std::deque<Output> output = {};  // the first is being written
    std::size_t waiting = 0;         // [bytes] of those behind the first
    bool is_open = false;            // its users know it
    bool is_reading = false;
    bool is_closing = false;                      // no message goes out any more
    std::optional<close_code> close_reason = {};  // sent in the close frame, once all data is sent
};

}  // namespace

struct WebSockets::State {
    State(asio::io_context& context, Timeouts given) : io(context), timeouts(given) {}

    using Shared = std::shared_ptr<Client>;

    void add(asio::ip::tcp::socket socket, const Gate& gate) {
        if (clients.size() >= most_connections && !make_room()) return;
        error_code ignored;
        socket.set_option(asio::ip::tcp::no_delay(true), ignored);
        socket.set_option(asio::socket_base::send_buffer_size(system_buffer), ignored);
        const auto client = std::make_shared<Client>(std::move(socket), next++, gate);
        clients[client->id] = client;
        client->request.header_limit(longest_request);
        client->stream.next_layer().expires_after(timeouts.request);
        http::async_read(client->stream.next_layer(), client->input, client->request,
                         [this, client](error_code error, std::size_t) {
                             error ? remove(client) : answer(client);
                         });
    }

    /// Closes the oldest connection that is not admitted yet. @return whether there was one
    bool make_room() {
        const auto outside = std::find_if(clients.begin(), clients.end(),
                                          [](const auto& each) { return !each.second->is_open; });
        if (outside == clients.end()) return false;
        const Shared client = outside->second;  // remove() takes it off the table
        remove(client);
        return true;
    }

    /// Admits a client, or sends it the reason for the rejection.
    void answer(const Shared& client) {
        const auto& request = client->request.get();
        if (const std::string fault = fault_of(request); !fault.empty())
            return refuse(client, http::status::bad_request, fault);
        const bool is_upgrade = websocket::is_upgrade(request);
        if (!is_upgrade && client->gate.pages.empty()) {
            return refuse(client, http::status::upgrade_required,
                          "this address accepts only WebSockets");
        }
        const WebPage* page = is_upgrade ? nullptr : page_of(client);
        const std::string why = page && page->is_public && !client->gate.admission.is_loopback()
                                    ? ""
                                    : refusal(client->gate, request);
        if (!why.empty()) return refuse(client, http::status::forbidden, why);
        if (!is_upgrade) return send_page(client);
        // A client must wait for the answer before it sends a message (RFC 6455, 4.1).
        client->input.clear();
        client->stream.next_layer().expires_never();
        client->stream.set_option(
            websocket::stream_base::timeout{timeouts.request, timeouts.silence, true});
        client->stream.read_message_max(longest_input);
        client->stream.auto_fragment(false);
        client->stream.async_accept(request, [this, client](error_code error) {
            if (error) return remove(client);
            client->is_open = true;
            client->gate.users.opened(client->id);
            read(client);
        });
    }

    /// Page that a client asks for; null if there is none.
    static const WebPage* page_of(const Shared& client) {
        const std::string_view target = text_of(client->request.get().target());
        const auto page = client->gate.pages.find(target.substr(0, target.find('?')));
        return page == client->gate.pages.end() ? nullptr : &page->second;
    }

    /// Answers a request that opens no WebSocket.
    void send_page(const Shared& client) {
        const auto& request = client->request.get();
        const bool is_head = request.method() == http::verb::head;
        if (!is_head && request.method() != http::verb::get) {
            client->response.set(http::field::allow, "GET, HEAD");
            return refuse(client, http::status::method_not_allowed, "expected GET or HEAD");
        }
        if (const WebPage* page = page_of(client))
            return respond(client, http::status::ok, *page, is_head);
        respond(client, http::status::not_found, {"text/plain", "there is no such page\n"},
                is_head);
    }

    void refuse(const Shared& client, http::status status, const std::string& why) {
        if (status == http::status::upgrade_required)
            client->response.set(http::field::upgrade, "websocket");
        respond(client, status, {"text/plain", why + "\n"}, false);
    }

    /// @param is_head  whether the client asked for the header alone
    void respond(const Shared& client, http::status status, const WebPage& page, bool is_head) {
        auto& response = client->response;
        response.result(status);
        response.set(http::field::content_type, page.type);
        set_page_fields(response, page.policy);
        response.content_length(page.text.size());
        if (!is_head) response.body() = page.text;
        client->stream.next_layer().expires_after(timeouts.request);
        http::async_write(client->stream.next_layer(), response,
                          [this, client](error_code, std::size_t) { remove(client); });
    }

    void read(const Shared& client) {
        const bool is_busy = client->waiting > much_waiting;
        if (client->is_reading || client->is_closing || is_busy) return;
        client->is_reading = true;
        if (client->rate.read_again() > Clock::now()) return read_later(*this, client);
        client->stream.async_read_some(
            client->input, portion,
            [this, client](error_code error, std::size_t) { take_in(client, error); });
    }

    void take_in(const Shared& client, error_code error) {
        client->is_reading = false;
        if (error) return remove(client);
        acknowledge_at_once(client->stream.next_layer().socket().native_handle());
        beast::flat_buffer& input = client->input;
        if (client->is_closing) return;
        if (!client->stream.is_message_done()) {
            const bool is_too_much = input.size() > portion && input_of_all() > most_input;
            return is_too_much ? send_close(client, close_code::try_again_later) : read(client);
        }
        const std::string_view message{static_cast<const char*>(input.cdata().data()),
                                       input.size()};
        // Beast does not see that an empty last frame leaves a character cut.
        if (client->stream.got_text() && !simdjson::validate_utf8(message))
            return send_close(client, close_code::bad_payload);
        client->gate.users.received(client->id, message);
        if (client->gate.users.has_rate) client->rate.add(1, input.size(), Clock::now());
        input.clear();
        if (input.capacity() > portion) input.shrink_to_fit();
        read(client);
    }

    std::size_t input_of_all() const {
        std::size_t bytes = 0;
        for (const auto& [id, client] : clients) bytes += client->input.size();
        return bytes;
    }

    /// Bytes that no client has taken yet: queued here, or sent but not acknowledged.
    std::size_t unsent() const {
        std::size_t bytes = 0;
        for (const auto& [id, client] : clients) {
            bytes += client->waiting +
                     unacknowledged(client->stream.next_layer().socket().native_handle());
        }
        return bytes;
    }

    void send(Connection to, Output message) {
        const auto found = clients.find(to);
        if (found == clients.end()) return;
        const Shared client = found->second;
        if (!client->is_open || client->is_closing || client->close_reason) return;
        if (!client->output.empty()) client->waiting += message.bytes.size();
        client->output.push_back(std::move(message));
        if (is_overdue(*client)) return send_close(client, close_code::try_again_later);
        if (client->output.size() == 1) write(client);
    }

    /// Whether too much is queued for a client. Its longest message does not count, since a map may
    /// exceed the limit.
    static bool is_overdue(const Client& client) {
        if (client.output.size() > most_messages) return true;
        if (client.waiting <= most_waiting) return false;
        std::size_t longest = 0;
        for (auto each = client.output.begin() + 1; each != client.output.end(); ++each)
            longest = std::max(longest, each->bytes.size());
        return client.waiting - longest > most_waiting;
    }

    void write(const Shared& client) {
        client->stream.text(client->output.front().is_text);
        client->stream.async_write(asio::buffer(client->output.front().bytes),
                                   [this, client](error_code error, std::size_t) {
                                       error ? remove(client) : go_on_writing(client);
                                   });
    }

    void go_on_writing(const Shared& client) {
        client->output.pop_front();
        if (!client->output.empty()) {
            client->waiting -= client->output.front().bytes.size();
            write(client);
        } else if (client->close_reason) {
            send_close(client, *client->close_reason);
        }
        read(client);
    }

    /// Closes a connection once all data is sent.
    void leave(const Shared& client, close_code why) {
        client->close_reason = why;
        if (client->output.empty()) send_close(client, why);
    }

    /// Closes a connection once the current message is sent. The handler `closed` is called later.
    void send_close(const Shared& client, close_code why) {
        if (std::exchange(client->is_closing, true)) return;
        while (client->output.size() > 1) client->output.pop_back();
        client->waiting = 0;
        asio::post(io, [this, client] { tell_closed(*client); });
        client->stream.async_close(why, [this, client](error_code) { remove(client); });
    }

    void tell_closed(Client& client) {
        if (std::exchange(client.is_open, false)) client.gate.users.closed(client.id);
    }

    /// @param client  not the one in `clients`, which goes
    void remove(const Shared& client) {
        clients.erase(client->id);
        client->is_closing = true;
        client->stream.next_layer().close();
        tell_closed(*client);
    }

    asio::io_context& io;
    const Timeouts timeouts;
    std::string token = random_token();
    std::list<Gate> gates;  // clients refer to them
    std::map<Connection, Shared> clients;
    Connection next = first;
};

WebSockets::WebSockets(Listeners& listeners, Timeouts timeouts)
    : state_(std::make_unique<State>(listeners.io(), timeouts)) {}
WebSockets::~WebSockets() = default;

Address WebSockets::listen(const Address& address, Listeners::Streams users, WebPages pages) {
    auto acceptor = listen_on(state_->io, address);
    const Address own{address.host, acceptor.local_endpoint().port()};
    Gate& gate = state_->gates.emplace_back(Gate{std::move(acceptor), Admission(own, state_->token),
                                                 std::move(users), std::move(pages)});
    accept_all(gate.acceptor, [state = state_.get(), &gate](asio::ip::tcp::socket socket) {
        state->add(std::move(socket), gate);
    });
    return own;
}

std::string WebSockets::address_with_token(const Address& own) const {
    const bool is_any = own.host == "0.0.0.0" || own.host == "::";
    const std::string at =
        is_any ? fmt::format("{}:{}", asio::ip::host_name(), own.port) : own.text();
    return fmt::format("{}/?token={}", at, state_->token);
}

std::string WebSockets::page_address(const Address& own) const {
    return "http://" + (own.is_loopback() ? own.text() + "/" : address_with_token(own));
}

std::string WebSockets::token_notice(const Address& own) const {
    return fmt::format("for {}: ws://{}",
                       own.is_loopback() ? "a page" : "each client, with the token in the address",
                       address_with_token(own));
}

void WebSockets::send(Connection to, std::string_view text) {
    state_->send(to, {std::string(text), true});
}

void WebSockets::send_binary(Connection to, std::string_view bytes) {
    state_->send(to, {std::string(bytes), false});
}

std::size_t WebSockets::unsent(Connection to) const {
    const auto found = state_->clients.find(to);
    if (found == state_->clients.end() || found->second->output.empty()) return 0;
    return found->second->output.front().bytes.size() + found->second->waiting;
}

void WebSockets::close(Connection which) {
    const auto found = state_->clients.find(which);
    if (found != state_->clients.end()) state_->leave(found->second, close_code::normal);
}

void WebSockets::close(std::chrono::milliseconds patience, std::chrono::milliseconds most) {
    for (Gate& gate : state_->gates) {
        gate.acceptor.close();
        gate.users = {};
    }
    const auto clients = state_->clients;  // remove() takes them off the table
    for (const auto& [id, client] : clients)
        client->is_open ? state_->leave(client, close_code::going_away) : state_->remove(client);
    const auto until = Clock::now() + most;
    auto unsent = state_->unsent();
    auto gives_up = Clock::now() + patience;
    while (!state_->clients.empty() && Clock::now() < std::min(gives_up, until)) {
        state_->io.run_one_for(std::chrono::milliseconds(10));
        const auto before = std::exchange(unsent, state_->unsent());
        if (unsent != before) gives_up = Clock::now() + patience;
    }
    for (const auto& [id, client] : clients) state_->remove(client);
}

}  // namespace rovernet
