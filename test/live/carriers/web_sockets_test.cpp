// SPDX-License-Identifier: MIT
// WebSockets against a client that was written from RFC 6455.
#include "live/carriers/web_sockets.hpp"

#include "live/carriers/address.hpp"
#include "live/carriers/admission.hpp"
#include "test/live/web_client.hpp"

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace web_sockets_test {
using namespace rovernet;
using namespace rovernet::test;
using namespace std::chrono_literals;

namespace {

constexpr std::size_t longest = std::size_t{1} << 20U;  // [bytes] of a message

/// A server that says back what it is told, in a thread of its own. "close" closes it; "flood"
/// sends 20 MiB, "crowd" 2,000 messages, "map" one of 9 MiB among short ones.
class Echo {
  public:
    explicit Echo(WebSockets::Timeouts patience = {}, WebPages pages = {})
        : web_(listeners_, patience) {
        Listeners::Streams users;
        users.opened = [this](auto client) { here_.insert(client); };
        users.received = [this](auto from, auto bytes) {
            answer(from, bytes);
            return std::size_t{1};
        };
        users.closed = [this](auto gone) { here_.erase(gone); };
        const Address own = web_.listen({"127.0.0.1", 0}, users, std::move(pages));
        const std::string address = web_.address_with_token(own);
        port = own.port;
        token = address.substr(address.find("token=") + 6);
        thread_ = std::thread([this] {
            while (!stopped_) {
                listeners_.wait(10ms);
                open = here_.size();
            }
            web_.close(1s, 60s);
        });
    }
    ~Echo() { stop(); }
    void stop() {
        stopped_ = true;
        if (thread_.joinable()) thread_.join();
    }
    /// Waits until so many clients are there. @return whether they are, within 10 s
    bool has(std::size_t clients) const {
        for (int i = 0; i < 1000 && open != clients; ++i) std::this_thread::sleep_for(10ms);
        return open == clients;
    }

    int port = 0;
    std::string token;
    std::atomic<std::size_t> open = 0;

  private:
    void answer(WebSockets::Connection from, std::string_view bytes) {
        if (bytes == "close") {
            web_.send(from, "bye");
            return web_.close(from);
        }
        if (bytes == "flood") {
            for (int i = 0; i < 20; ++i) web_.send(from, std::string(longest, '.'));
            return;
        }
        if (bytes == "crowd") {
            for (int i = 0; i < 2'000; ++i) web_.send(from, std::string(1'000, '.'));
            return;
        }
        if (bytes == "map") {
            for (const std::size_t size : {1UL, 9 * longest, 1UL}) {
                web_.send(from, std::string(size, '.'));
            }
            return;
        }
        bytes.starts_with('b') ? web_.send_binary(from, bytes) : web_.send(from, bytes);
    }

    Listeners listeners_;
    WebSockets web_;
    std::set<WebSockets::Connection> here_;
    std::atomic<bool> stopped_ = false;
    std::thread thread_;
};

}  // namespace

TEST_CASE("web sockets: the handshake equals the example of RFC 6455") {
    const Echo echo;
    const WebClient client(echo.port, "Sec-WebSocket-Extensions: permessage-deflate\r\n");
    REQUIRE(client.is_in());
    CHECK(client.answer().find("Sec-WebSocket-Accept: s3pPLMBiTxaQ9kYGzzhZRbK+xOo=\r") !=
          std::string::npos);
    CHECK(client.answer().find("deflate") == std::string::npos);
    CHECK(echo.has(1));
}

TEST_CASE("web sockets: messages of any length arrive complete, as text or binary") {
    const Echo echo;
    WebClient client(echo.port);
    for (const std::size_t length : {0UL, 1UL, 125UL, 126UL, 65'535UL, 65'536UL, longest}) {
        CAPTURE(length);
        const std::string message(length, 'a');
        client.send(message);
        const WebClient::Frame answer = client.frame();
        CHECK(answer.kind == WebClient::text);
        CHECK(answer.is_last);
        CHECK((answer.bytes == message));
    }
    const std::string bytes("b\0\xff", 3);
    client.send(bytes, WebClient::binary);
    const WebClient::Frame answer = client.frame();
    CHECK(answer.kind == WebClient::binary);
    CHECK(answer.bytes == bytes);
}

TEST_CASE("web sockets: fragments form one message, and a ping between them is answered") {
    const Echo echo;
    WebClient client(echo.port);
    client.send("one ", WebClient::text, false);
    client.send("?", WebClient::ping);
    client.send("and ", WebClient::more, false);
    client.send("two", WebClient::more);
    const WebClient::Frame pong = client.frame();
    CHECK(pong.kind == WebClient::pong);
    CHECK(pong.bytes == "?");
    CHECK(client.message() == "one and two");
}

TEST_CASE("web sockets: a client that violates protocol or limits gets a close code of RFC 6455") {
    const Echo echo;
    WebClient long_one(echo.port), no_text(echo.port), unmasked(echo.port);
    long_one.send(std::string(longest + 1, 'a'));
    CHECK(long_one.reason() == 1009);
    no_text.send("\xff");
    CHECK(no_text.reason() == 1007);
    for (const std::string cut : {"a\xc3", "\xed", "\xe2\x82", "\xf0\x9f\x98"}) {
        // A character that is cut, and where the end of its message may be found.
        for (const std::string last : {"", "b"}) {
            CAPTURE(cut);
            CAPTURE(last);
            WebClient whole(echo.port), in_frames(echo.port);
            whole.send(cut + last);
            CHECK(whole.reason() == 1007);
            in_frames.send(cut, WebClient::text, false);
            in_frames.send("?", WebClient::ping);
            in_frames.send(last, WebClient::more);
            CHECK(in_frames.reason() == 1007);
        }
    }
    unmasked.socket().send_bytes("\x81\x01x");
    CHECK(unmasked.reason() == 1002);
    CHECK(echo.has(0));
    WebClient another(echo.port);
    another.send("still there");
    CHECK(another.message() == "still there");
}

TEST_CASE("web sockets: a client that does not read is disconnected, and others are served") {
    const Echo echo;
    WebClient deaf(echo.port), crowded(echo.port), reader(echo.port);
    CHECK(echo.has(3));
    deaf.send("flood");
    crowded.send("crowd");
    CHECK(echo.has(1));
    reader.send("hello");
    CHECK(reader.message() == "hello");
    CHECK(deaf.reason() == 1013);
    CHECK(crowded.reason() == 1013);
}

TEST_CASE(
    "web sockets: a client that reads gets even a message that is longer than the send queue") {
    const Echo echo;
    WebClient reader(echo.port);
    reader.send("map");
    CHECK(reader.message().size() == 1);
    CHECK(reader.message().size() == 9 * longest);
    CHECK(reader.message().size() == 1);
}

TEST_CASE(
    "web sockets: when the server stops, it waits for slow readers, but not long for clients that "
    "do not read") {
    Echo echo;
    WebClient slow(echo.port), deaf(echo.port);
    for (WebClient* each : {&slow, &deaf}) {
        each->socket().limit_buffer(128 << 10);
        each->send("map");
        CHECK(each->message().size() == 1);
    }
    const auto begun = std::chrono::steady_clock::now();
    std::thread stopping([&] { echo.stop(); });
    std::size_t got = 0;
    constexpr std::size_t portion = 64 << 10;
    for (std::size_t part = portion; part == portion; got += part) {
        part = slow.socket().bytes(portion).size();
        std::this_thread::sleep_for(15ms);
    }
    stopping.join();
    CHECK(got > 9 * longest);
    CHECK(std::chrono::steady_clock::now() - begun < 30s);
}

TEST_CASE("web sockets: the server sends all data and a close frame before it disconnects") {
    Echo echo;
    WebClient closed(echo.port), stays(echo.port);
    closed.send("close");
    CHECK(closed.message() == "bye");
    CHECK(closed.reason() == 1000);
    stays.send("x");
    CHECK(stays.message() == "x");
    std::thread stop([&] { echo.stop(); });
    CHECK(stays.reason() == 1001);
    stop.join();
}

TEST_CASE("web sockets: silent clients get a ping, and are disconnected if they do not answer") {
    const Echo echo({.request = 100ms, .silence = 1s});
    WebClient alive(echo.port), dead(echo.port);
    LineClient asks_nothing(echo.port);
    CHECK(echo.has(2));
    CHECK(asks_nothing.line().empty());
    for (int i = 0; i < 4; ++i) {
        const WebClient::Frame ping = alive.frame();
        CHECK(ping.kind == WebClient::ping);
        alive.send(ping.bytes, WebClient::pong);
    }
    CHECK(echo.has(1));
    alive.send("still there");
    CHECK(alive.message() == "still there");
}

TEST_CASE("web sockets: clients that vanish are reported as gone") {
    const Echo echo;
    for (int i = 0; i < 100; ++i) {
        WebClient client(echo.port);
        REQUIRE(client.is_in());
        client.send("x");
        client.socket().reset();
    }
    CHECK(echo.has(0));
    WebClient polite(echo.port);
    CHECK(echo.has(1));
    polite.send("\x03\xe8", WebClient::closing);
    CHECK(polite.frame().reason() == 1000);
    polite.socket().close();
    CHECK(echo.has(0));
}

TEST_CASE(
    "web sockets: requests of foreign pages or hosts, or without an Upgrade header, are refused") {
    const Echo echo;
    const std::string own = "127.0.0.1:" + std::to_string(echo.port);
    const auto answer = [&](const std::string& origin, const std::string& target = "/",
                            const std::string& host = {}) {
        const std::string line = origin.empty() ? "" : "Origin: " + origin + "\r\n";
        return WebClient(echo.port, line, target, host).answer().substr(9, 3);
    };
    CHECK(answer("") == "101");
    CHECK(answer("http://" + own) == "101");
    CHECK(answer("null") == "403");
    CHECK(answer("null", "/?token=" + echo.token) == "101");
    CHECK(answer("", "/", "rebound.example:" + std::to_string(echo.port)) == "403");
    CHECK(answer("", "/", own + "\r\nHost: " + own) == "400");
    CHECK(answer("", "/", own + "\r\nSec-WebSocket-Version: 13") == "400");
    CHECK(answer("", "/", own + "\r\nOrigin: http://" + own + "\r\nOrigin: null") == "400");
    CHECK(answer("", "/", own + "\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==") == "400");
    LineClient hostless(echo.port);
    hostless.send_bytes("GET / HTTP/1.1\r\n\r\n");
    CHECK(hostless.line().starts_with("HTTP/1.1 400 "));
    struct Key {
        const char* text;
        const char* status;
    };
    for (const Key& key :
         {Key{"", "400"}, Key{"x", "400"}, Key{"dGhlIHNhbXBsZQ==", "400"},
          Key{"dGhlIHNhbXBsZSBub25jZQ", "400"}, Key{"dGhlIHNhbXBsZSBub25jZQ=", "400"},
          Key{"dGhlIHNhbXBsZSBub25jZSE=", "400"}, Key{"dGhlIHNhbXBsZSBub25jZQ==x", "400"},
          Key{"dGhlIHNhbX!sZSBub25jZQ==", "400"}, Key{"dGhlIHNhbXBsZSBub25jZSEhISEhISE=", "400"},
          Key{"AAAAAAAAAAAAAAAAAAAAAA==", "101"}}) {
        CAPTURE(key.text);
        LineClient client(echo.port);
        client.send_bytes("GET / HTTP/1.1\r\nHost: " + own +
                          "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                          "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: " +
                          key.text + "\r\n\r\n");
        CHECK(client.line().substr(9, 3) == key.status);
    }
    LineClient browser(echo.port);
    browser.send_bytes("GET / HTTP/1.1\r\nHost: " + own + "\r\n\r\n");
    CHECK(browser.line().starts_with("HTTP/1.1 426 "));
    LineClient endless(echo.port);
    endless.send_bytes("GET /" + std::string(9'000, 'x'));
    CHECK(endless.line().empty());
}

TEST_CASE("web sockets: fixed pages are served for GET and HEAD; other paths are not found") {
    const std::string large(std::size_t{3} << 20U, 'x');
    const Echo echo({}, {{"/", {"text/html; charset=utf-8", "<p>hello</p>\n"}},
                         {"/large", {"text/plain", large}}});
    const std::string own = "127.0.0.1:" + std::to_string(echo.port);
    const auto ask = [&](const std::string& request, const std::string& lines = {},
                         const std::string& host = {}) {
        LineClient browser(echo.port);
        browser.send_bytes(request + " HTTP/1.1\r\nHost: " + (host.empty() ? own : host) + "\r\n" +
                           lines + "\r\n");
        const std::string all = browser.bytes(2 * large.size());
        const std::size_t end = all.find("\r\n\r\n");
        return std::pair(all.substr(0, end + 2), all.substr(end + 4));
    };
    const auto [header, text] = ask("GET /");
    CHECK(header.starts_with("HTTP/1.1 200 "));
    CHECK(header.find("Content-Type: text/html; charset=utf-8\r\n") != header.npos);
    CHECK(header.find("Content-Length: 13\r\n") != header.npos);
    CHECK(text == "<p>hello</p>\n");
    CHECK(ask("HEAD /") == std::pair(header, std::string()));
    CHECK(ask("GET /?token=" + echo.token + "&x=/large").second == text);
    CHECK((ask("GET /large").second == large));
    const auto status = [&](const std::string& request, const std::string& lines = {},
                            const std::string& host = {}) {
        return ask(request, lines, host).first.substr(9, 3);
    };
    for (const char* other : {"/index.html", "//", "/large/", "/../etc/passwd", "/etc/passwd",
                              "/%6Carge", "*", "http://127.0.0.1/"}) {
        CAPTURE(other);
        CHECK(status(std::string("GET ") + other) == "404");
        CHECK(status(std::string("HEAD ") + other) == "404");
    }
    CHECK(ask("POST /").first.find("Allow: GET, HEAD\r\n") != std::string::npos);
    CHECK(status("POST /") == "405");
    CHECK(status("GET /", "Origin: http://page.example\r\n") == "403");
    CHECK(status("GET /", "Origin: http://" + own + "\r\n") == "200");
    CHECK(status("GET /", {}, "rebound.example:" + std::to_string(echo.port)) == "403");
    CHECK(WebClient(echo.port).is_in());
    CHECK(WebClient(echo.port, {}, "/large").is_in());
    CHECK_FALSE(WebClient(echo.port, "Origin: null\r\n").is_in());
}

TEST_CASE(
    "web socket admission: foreign pages need the token; on loopback, foreign host names are "
    "refused") {
    const std::string secret = "0123456789abcdef0123456789abcdef";
    const Admission admission({"127.0.0.1", 9090}, secret);
    const std::string right = "/any/path?x=1&token=" + secret, part = "/?token=0123",
                      wrong = "/?token=1123456789abcdef0123456789abcdef",
                      longer = "/?token=" + secret + "0", other_key = "/?atoken=" + secret;
    struct Row {
        std::string_view target, host;
        std::optional<std::string_view> origin;
        bool is_let_in;
    };
    const Row rows[] = {
        {"/", "127.0.0.1:9090", {}, true},
        {"/", "localhost:9090", {}, true},
        {"/", "[::1]:9090", {}, true},
        {"/", "localhost:9090", "http://localhost:9090", true},
        {"/", "localhost:9090", "http://127.0.0.1:9090", false},
        {"/", "127.0.0.1:9090", "https://127.0.0.1:9090", false},
        {"/", "127.0.0.1:9090", "http://127.0.0.1:8000", false},
        {"/", "127.0.0.1:9090", "null", false},
        {"/", "127.0.0.1:9090", "", false},
        {"/", "127.0.0.1:9090", "http://page.example", false},
        {right, "127.0.0.1:9090", "null", true},
        {right, "127.0.0.1:9090", "http://page.example", true},
        {part, "127.0.0.1:9090", "null", false},
        {wrong, "127.0.0.1:9090", "null", false},
        {longer, "127.0.0.1:9090", "null", false},
        {other_key, "127.0.0.1:9090", "null", false},
        {"/?token=", "127.0.0.1:9090", "null", false},
        {right, "127.0.0.1", {}, false},
        {right, "127.0.0.1:9091", {}, false},
        {right, "page.example:9090", "http://page.example:9090", false},
        {right, "", {}, false},
    };
    for (const Row& row : rows) {
        CAPTURE(row.target);
        CAPTURE(row.host);
        CAPTURE(row.origin.value_or("none"));
        CHECK(admission.refusal({row.target, row.host, row.origin}).empty() == row.is_let_in);
    }
    CHECK(Admission({"127.0.0.2", 9090}, secret).refusal({"/", "127.0.0.2:9090", {}}).empty());
    const Admission open({"10.0.0.1", 9090}, secret);  // other machines reach it
    CHECK(open.refusal({right, "10.0.0.1:9090", {}}).empty());
    CHECK(open.refusal({right, "robots.example:9090", "http://page.example"}).empty());
    for (const std::string& target : {std::string("/"), part, wrong, longer, other_key}) {
        CAPTURE(target);
        CHECK_FALSE(open.refusal({target, "10.0.0.1:9090", {}}).empty());
        CHECK_FALSE(open.refusal({target, "127.0.0.1:9090", "http://127.0.0.1:9090"}).empty());
    }
    CHECK_FALSE(Admission({"0.0.0.0", 9090}, "").refusal({"/?token=", "x", {}}).empty());
    const std::string first = random_token(), second = random_token();
    CHECK(first.size() == 32);
    CHECK(first.find_first_not_of("0123456789abcdef") == std::string::npos);
    CHECK(first != second);
}

}  // namespace web_sockets_test
