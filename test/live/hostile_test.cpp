// SPDX-License-Identifier: MIT
// The command `live` among clients that break, stall, lie or die: limits hold, others are served.
#include "live/carriers/web_sockets.hpp"
#include "test/live/emulate/emulation.hpp"
#include "test/live/live_command.hpp"
#include "test/live/web_client.hpp"
#include "test/sanitizer.hpp"

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <list>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace hostile_test {
using namespace rovernet;
using namespace rovernet::test;
using namespace std::chrono_literals;

namespace {

constexpr std::size_t most_connections = 500;  // of all listeners

/// Memory of the command [MiB], whatever comes in. The address sanitizer keeps what was freed.
constexpr long most_memory = test::has_address_sanitizer ? 1024 : 256;

/// Waits until something holds, 20 s at most. @return whether it does
bool comes_true(const std::function<bool()>& holds) {
    for (int i = 0; i < 2000; ++i, std::this_thread::sleep_for(10ms)) {
        if (holds()) return true;
    }
    return false;
}

/// A run by the clock that serves Player and ROS clients.
class Served : public Live {
  public:
    explicit Served(const std::string& file = long_live_row())
        : Live({"--player", "127.0.0.1:0", "--player-one-port", "--rosbridge", "127.0.0.1:0"},
               file),
          player(port("(Player, all robots)")),
          rosbridge(port("(rosbridge)")) {}

    /// Ends it by Ctrl-C: with results, whoever is there.
    void end() const {
        CHECK(megabytes_of(process().pid()) < most_memory);
        process().interrupt();
        CHECK(wait().exit == 0);
        CHECK(replay().exit == 0);
    }

    const int player, rosbridge;
};

/// A Player client that behaves.
class Good {
  public:
    explicit Good(const Served& served) : client_(served.player) { open_position(client_); }

    /// One round. @return the speed of the first robot
    double speed() {
        client_.send_bytes(ask());
        CHECK(message_of(client_).type == ack);
        const Wire told = message_of(client_);
        CHECK(message_of(client_).type == sync_message);
        return double_at(told.payload, 24);
    }

  private:
    LineClient client_;
};

std::string subscribe(const std::string& topic, int id = 0) {
    return R"({"op":"subscribe","id":")" + std::to_string(id) + R"(","topic":")" + topic + "\"}";
}

const std::string call_time = R"({"op":"call_service","id":"time","service":"rosapi/get_time"})";

/// A list in a list in a list.
std::string nested(std::size_t levels) {
    return std::string(levels, '[') + std::string(levels, ']');
}

/// The row of robots in the office of the examples, whose map takes 250 kB to tell.
std::string in_office() {
    return long_live_row() + "[scene]\nmap = \"" ROVERNET_EXAMPLES "/rescue/map.yaml\"\n";
}

}  // namespace

TEST_CASE("hostile: connections beyond the limit are closed until another connection ends") {
    const Served served;
    std::list<LineClient> players;
    std::list<WebClient> pages;
    const auto enters_player = [&] {
        LineClient& player = players.emplace_back(served.player);
        player.send_bytes(request(1, 0, 5, be32(pull)));  // whoever has said nothing makes room
        return player.bytes(32).size() == 32 && !player.bytes(40).empty();
    };
    const auto enters_rosbridge = [&] { return pages.emplace_back(served.rosbridge).is_in(); };
    for (std::size_t i = 0; i < most_connections; ++i) REQUIRE(enters_player());
    CHECK_FALSE(enters_player());
    players.pop_front();
    CHECK(comes_true(enters_player));
    players.clear();
    for (std::size_t i = 0; i < most_connections; ++i) REQUIRE(enters_rosbridge());
    CHECK_FALSE(enters_rosbridge());
    pages.front().socket().reset();
    CHECK(comes_true(enters_rosbridge));
    served.end();
}

TEST_CASE("hostile: at the connection limit, a new client displaces the oldest silent client") {
    const Served served;
    const Live controlled({"--listen-json", "127.0.0.1:0", "--unix", "SOCKET"}, long_live_row());
    const int port = controlled.port();
    controlled.said("listening on /");
    const std::string path = controlled.folder.path("socket");
    const std::string early = R"({"type":"step","n":1})";

    LineClient first(port);  // has spoken, though nothing that makes sense: it stays
    CHECK(Json::parse(first.ask(early)).at("code") == "hello_first");
    WebClient page(served.rosbridge);  // is let in, and says nothing: it stays
    CHECK(page.is_in());
    Good good(served);
    std::list<LineClient> silent;
    for (std::size_t i = 0; i < most_connections + 20; ++i) {
        i % 2 == 0 ? silent.emplace_back(port) : silent.emplace_back(path);
        silent.back().send_bytes(R"({"type":)");  // no whole line
        silent.emplace_back(served.player);
        silent.emplace_back(served.rosbridge).send_bytes("GET / HTTP/1.1\r\n");
    }
    LineClient by_port(port), by_path(path);
    CHECK(Json::parse(by_port.ask(early)).at("code") == "hello_first");
    CHECK(Json::parse(by_path.ask(early)).at("code") == "hello_first");
    CHECK(Json::parse(first.ask(early)).at("code") == "hello_first");
    CHECK(silent.front().line().empty());  // the oldest has gone
    CHECK(WebClient(served.rosbridge).is_in());
    CHECK(Json::parse(page.ask(call_time)).at("result") == true);
    good.speed();
    Good(served).speed();
    served.end();
    controlled.process().interrupt();
    CHECK(controlled.wait().exit == 0);
}

TEST_CASE("hostile: on every listener, HTTP requests of a web page cannot drive a robot") {
    const Served served;
    const Live controlled(
        {"--listen-json", "127.0.0.1:0", "--unix", "SOCKET", "--listen-web", "127.0.0.1:0"},
        long_live_row());
    const int web = read_port(controlled.said("listening on ws://"));
    controlled.said("listening on /");
    const std::string lines =
        hello("\"A\"") + "\n" + R"({"type":"step","n":1,"do":{"A":{"v":1}}})" + "\n";
    const std::string orders = mode(pull) + device(4, 0) + rovernet::test::drive(1, 0);
    for (const std::string method : {"POST", "GET", "OPTIONS", "X", "!#$%&'*+-.^_`|~"}) {
        for (const std::string& body : {lines, orders}) {
            CAPTURE(method);
            const std::string bytes =
                method +
                " / HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: " + std::to_string(body.size()) +
                "\r\nContent-Type: text/plain\r\n\r\n" + body;
            LineClient by_port(controlled.port()), by_path(controlled.folder.path("socket"));
            for (LineClient* client : {&by_port, &by_path}) {
                client->send_bytes(bytes);
                const std::string answer = client->bytes(100'000);  // to its end
                CHECK(answer.find("welcome") == std::string::npos);
            }
            LineClient player(served.player), ros(served.rosbridge), page(web);
            CHECK(player.bytes(32).size() == 32);
            for (LineClient* client : {&player, &ros, &page}) {
                client->send_bytes(bytes);
                CHECK(client->bytes(100'000).find("101 ") == std::string::npos);
            }
        }
    }
    CHECK(Good(served).speed() == 0);
    served.end();
    controlled.process().interrupt();
    CHECK(controlled.wait().exit == 0);
    CHECK(controlled.replay().out.starts_with("identical: 0 inputs"));
}

TEST_CASE("hostile: a client whose first line is not a JSON object is disconnected") {
    const Live live({"--listen-json", "127.0.0.1:0"}, long_live_row());
    const int port = live.port();
    const std::string rest = hello("\"A\"") + "\n";
    for (const std::string& first :
         {std::string("hello"), std::string(), std::string(" \t\r"), std::string("[1]"),
          std::string("[{}]"), std::string("\"{}\""), std::string("1"), std::string("null"),
          std::string("{"), std::string("{}}"), std::string("{} {}"),
          std::string("{\"type\":\"\xff\"}"), std::string("{'type':'hello'}"),
          R"({"a":)" + nested(50'000) + "}", std::string(3, '\0'), std::string("\x16\x03\x01", 3),
          std::string("\xef\xbb\xbf{}"), nested(50'000)}) {
        CAPTURE(first.substr(0, 20));
        LineClient client(port);
        client.send_bytes(first + "\n" + rest);
        const std::string answer = client.line();
        if (!answer.empty()) CHECK(Json::parse(answer).at("type") == "error");
        CHECK(client.line().empty());
    }
    // Its first byte is enough, and a first line may not be endless.
    for (const std::string& first :
         {std::string("P"), std::string("  ["), "{" + std::string(std::size_t{2} << 20U, ' ')}) {
        CAPTURE(first.substr(0, 20));
        LineClient client(port);
        client.send_bytes(first);
        client.line();
        CHECK(client.line().empty());
    }
    LineClient typist(port);  // a JSON object that is wrong is told, and may be corrected
    for (const std::string words : {R"({"type":"step","n":1})", "{}", R"({"type":"hullo"})", "x"}) {
        CAPTURE(words);
        CHECK(Json::parse(typist.ask(words)).at("type") == "error");
    }
    CHECK(Json::parse(typist.ask(hello("\"A\""))).at("type") == "welcome");
    live.process().interrupt();
    CHECK(live.wait().exit == 0);
}

TEST_CASE("hostile: wrong sizes and counts from a Player client do not affect other clients") {
    const Served served;
    Good good(served);
    LineClient endless(served.player), liar(served.player);
    std::string header = Wire{0, 0, 51, 0, cmd, 1, 0, 0, {}}.bytes();
    header.replace(36, 4, be32(2'000'000));
    endless.send_bytes(header);
    CHECK(endless.bytes(33).size() == 32);  // the banner, then its end

    liar.bytes(32);
    const std::string many = be32(1'000'000'000) + be32(1'000'000'000) + "abcd";
    liar.send_bytes(request(1, 0, 5, be32(pull)) + device(51, 0) + order(51, 0, many) +
                    request(31, 0, 3, many) + ask());
    CHECK(message_of(liar).type == ack);
    CHECK(message_of(liar).type == ack);
    CHECK(message_of(liar).type == nack);
    CHECK(message_of(liar).type == ack);
    good.speed();
    served.end();
}

TEST_CASE("hostile: ROS messages that are too long, nested too deeply or not JSON are refused") {
    const Served served;
    Good good(served);
    WebClient endless(served.rosbridge), odd(served.rosbridge);
    endless.send(std::string(std::size_t{2} << 20U, ' '));
    CHECK(endless.reason() == 1009);
    const std::string deep = nested(50'000);
    for (const std::string& words : {deep, R"({"op":)" + deep, std::string("{"), std::string()}) {
        CHECK(Json::parse(odd.ask(words)).at("op") == "status");
    }
    CHECK(Json::parse(odd.ask(call_time)).at("result") == true);
    good.speed();
    served.end();
}

TEST_CASE("hostile: a controller's line is refused if it is nested too deeply or is not text") {
    const Live live({"--listen-json", "127.0.0.1:0"});
    LineClient odd(live.port());
    CHECK(Json::parse(odd.ask("{}")).at("code") == "missing_key");
    CHECK(Json::parse(odd.ask(nested(50'000))).at("code") == "too_deep");
    CHECK(Json::parse(odd.ask("{\"type\":\"\xff\"}")).at("code") == "bad_utf8");
    CHECK(Json::parse(odd.ask(std::string(3, '\0'))).at("code") == "bad_json");
    CHECK(Json::parse(odd.ask(hello("\"A\""))).at("type") == "welcome");
    CHECK(Json::parse(odd.ask(R"({"type":"bye"})")).at("type") == "end");
    CHECK(live.wait().exit == 0);
}

TEST_CASE("hostile: a client that sends a request byte by byte is disconnected after some time") {
    Listeners listeners;
    WebSockets web(listeners, {.request = 1s, .silence = 60s});
    const Address address = web.listen({"127.0.0.1", 0}, {});
    std::atomic<bool> is_over = false;
    std::thread server([&] {
        while (!is_over) listeners.wait(10ms);
        web.close(1s, 1s);
    });
    LineClient slow(address.port);
    int sent = 0;
    while (sent < 1000 && slow.send_bytes(sent == 0 ? "GET /" : "x")) {
        ++sent;
        std::this_thread::sleep_for(20ms);
    }
    is_over = true;
    server.join();
    CHECK(sent < 1000);
}

TEST_CASE(
    "hostile: a client that closes only its sending direction counts as gone, and its robot "
    "stops") {
    const Served served;
    LineClient half(served.player);
    open_position(half);
    half.send_bytes(rovernet::test::drive(1, 0));
    {
        Good other(served);
        CHECK(comes_true([&] { return other.speed() == 1; }));
    }
    half.end_sending();
    CHECK(half.bytes(1).empty());
    WebClient page(served.rosbridge);
    page.socket().end_sending();
    CHECK(page.frame().kind < 0);
    CHECK(Good(served).speed() == 0);
    served.end();
}

TEST_CASE("hostile: clients that disconnect while they receive much data do not affect others") {
    const Served served(in_office());
    Good good(served);
    for (int i = 0; i < 20; ++i) {
        WebClient page(served.rosbridge);
        for (int id = 0; id < 10; ++id) page.send(subscribe("/map", id));
        if (i % 2 == 0) page.frame();  // the rest is under way, or not yet begun
        page.socket().reset();
        LineClient player(served.player);
        player.send_bytes(mode(push) + device(4, 0) + device(51, 0));
        for (int k = 0; k < 10; ++k) {
            player.send_bytes(order(51, 0, counted(std::string(100'000, 'x'))));
        }
        player.reset();
        good.speed();
    }
    served.end();
}

namespace {

/// Has a process of its own do something and be killed.
void do_and_be_killed(const std::function<void()>& act) {
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        act();
        kill(getpid(), SIGKILL);
    }
    int status = 0;
    CHECK(waitpid(child, &status, 0) == child);
    CHECK(WIFSIGNALED(status));
}

std::size_t descriptors(pid_t pid) {
    const std::filesystem::directory_iterator all("/proc/" + std::to_string(pid) + "/fd");
    return static_cast<std::size_t>(std::distance(begin(all), end(all)));
}

constexpr int kills = 100;

}  // namespace

TEST_CASE("hostile: killed clients leave nothing behind, and their robots stop") {
    const Served served;
    WebClient page(served.rosbridge);
    page.ask(call_time);
    const pid_t pid = served.process().pid();
    const std::size_t before = descriptors(pid);
    for (int i = 0; i < kills; ++i) {
        const bool leaves_unread = i % 2 == 0;
        page.ask(call_time);  // a page that answers no ping for long is closed
        do_and_be_killed([&] {
            LineClient client(served.player);
            client.bytes(32);
            client.send_bytes(mode(push) + device(4, 0) + rovernet::test::drive(1, 0));
            if (!leaves_unread) client.bytes(40);
        });
        do_and_be_killed([&] {
            WebClient client(served.rosbridge);
            client.send(subscribe("/clock"));
            client.send(R"({"op":"publish","topic":"/B/cmd_vel","msg":{"linear":{"x":1}}})");
            client.ask(call_time);
            if (!leaves_unread) client.message();
        });
    }
    CHECK(comes_true([&] { return descriptors(pid) == before; }));
    Good good(served);
    CHECK(good.speed() == 0);
    const Json odometry = Json::parse(page.ask(subscribe("/B/odom")));
    CHECK(odometry["msg"]["twist"]["twist"]["linear"]["x"] == 0);
    CHECK(odometry["msg"]["pose"]["pose"]["position"]["x"] > 0);
    served.end();
}

TEST_CASE("hostile: robots of killed controllers stop, and can be driven by other controllers") {
    const Live live({"--listen-json", "127.0.0.1:0", "--on-loss", "stop", "--wait-for", "2"},
                    long_live_row());
    const int port = live.port();
    LineClient good(port);
    CHECK(Json::parse(good.ask("{}")).at("type") == "error");  // it is there, and nobody else
    const std::size_t before = descriptors(live.process().pid());
    good.send_bytes(hello("\"A\"") + "\n");
    const auto is_taken = [&] {
        LineClient other(port);
        return Json::parse(other.ask(hello("\"B\""))).value("code", "") == "taken";
    };
    for (int n = 1; n <= kills; ++n) {
        const bool leaves_unread = n % 2 == 0;
        do_and_be_killed([&] {
            LineClient client(port);
            client.ask(hello("\"B\""));
            client.send_bytes(R"({"type":"step","n":1,"do":{"B":{"v":1}}})"
                              "\n");
            if (!leaves_unread) client.send_bytes("{");
        });
        if (n == 1) CHECK(Json::parse(good.line()).at("type") == "welcome");
        const std::string step = R"({"type":"step","n":)" + std::to_string(n) + "}";
        CHECK(Json::parse(good.ask(step)).at("n") == n);
    }
    CHECK(comes_true([&] { return descriptors(live.process().pid()) == before; }));
    CHECK_FALSE(is_taken());
    CHECK(Json::parse(good.ask(R"({"type":"bye"})")).at("type") == "end");
    CHECK(live.wait().exit == 0);
    CHECK(live.replay().exit == 0);
}

TEST_CASE("hostile: Ctrl-C ends a run with many clients, some of which never read") {
    const Served served(in_office());
    std::list<LineClient> players;
    std::list<WebClient> pages;
    for (int i = 0; i < 200; ++i) {
        players.emplace_back(served.player).send_bytes(mode(push) + device(4, 0));
        pages.emplace_back(served.rosbridge).send(subscribe("/clock"));
    }
    for (int id = 0; id < 10; ++id) pages.back().send(subscribe("/map", id));
    served.end();
    for (WebClient& each : pages) {
        while (each.frame().kind >= 0) {
        }
    }
    for (LineClient& each : players) {
        while (!each.bytes(65'536).empty()) {
        }
    }
}

TEST_CASE(
    "hostile: web pages of other servers, and requests with foreign host names, are refused") {
    const Served served;
    const Live controlled({"--listen-web", "127.0.0.1:0"});
    const auto token_of = [](const Live& live) {
        const std::string told = live.said("for a page: ");
        return told.substr(told.find("/?token="));
    };
    const std::string token = token_of(served), other_token = token_of(controlled);
    const auto check = [](int port, const std::string& own, const std::string& other) {
        const std::string at = ":" + std::to_string(port), here = "127.0.0.1" + at;
        struct Row {
            std::string origin, target, host;
            int status;
        };
        const Row rows[] = {
            {"", "/", here, 101},
            {"", "/any/path", "localhost" + at, 101},
            {"", own, "page.example" + at, 403},
            {"", "/", "127.0.0.1", 403},
            {"http://" + here, "/", here, 101},
            {"http://localhost" + at, "/", here, 403},
            {"https://" + here, "/", here, 403},
            {"http://page.example" + at, own, "page.example" + at, 403},
            {"http://page.example", "/", here, 403},
            {"http://page.example", own, here, 101},
            {"null", own, here, 101},
            {"null", own + "0", here, 403},
            {"null", other, here, 403},
        };
        for (const Row& row : rows) {
            CAPTURE(row.origin);
            CAPTURE(row.target);
            CAPTURE(row.host);
            const std::string line = row.origin.empty() ? "" : "Origin: " + row.origin + "\r\n";
            const std::string answer = WebClient(port, line, row.target, row.host).answer();
            CHECK(answer.substr(0, 13) == "HTTP/1.1 " + std::to_string(row.status) + " ");
        }
    };
    check(served.rosbridge, token, other_token);
    check(read_port(controlled.said("listening on ws://")), other_token, token);
    served.end();
    controlled.process().interrupt();
    CHECK(controlled.wait().exit == 0);
}

namespace {

/// Addresses of a process' sockets that others may speak to, as /proc/net has them.
std::set<std::string> open_addresses(pid_t pid) {
    const std::string process = "/proc/" + std::to_string(pid);
    std::set<std::string> own, found;
    for (const auto& each : std::filesystem::directory_iterator(process + "/fd")) {
        std::error_code ignored;
        own.insert(std::filesystem::read_symlink(each, ignored).string());
    }
    for (const std::string table : {"tcp", "tcp6", "udp", "udp6"}) {
        std::ifstream file(process + "/net/" + table);
        std::string line;
        std::getline(file, line);
        while (std::getline(file, line)) {
            std::istringstream words(line);
            std::vector<std::string> word(10);
            for (std::string& each : word) words >> each;
            const bool is_open = word[3] == (table.starts_with("tcp") ? "0A" : "07");
            const bool is_own = own.contains("socket:[" + word[9] + "]");
            if (is_open && is_own) found.insert(word[1].substr(0, word[1].find(':')));
        }
    }
    return found;
}

const std::set<std::string> loopback_only = {"0100007F"};  // 127.0.0.1

}  // namespace

TEST_CASE("hostile: all listeners accept connections from this machine only") {
    const Served served;
    CHECK(open_addresses(served.process().pid()) == loopback_only);
    const Live controlled({"--listen-json", "localhost:0", "--listen-web", "127.0.0.1:0"});
    controlled.port();
    controlled.said("listening on ws://");
    CHECK(open_addresses(controlled.process().pid()) == loopback_only);
    Emulation emulation(long_live_row(), {"--udp", "127.0.0.1:0"});
    emulation.ports(3);
    CHECK(open_addresses(emulation.pid()) == loopback_only);
    CHECK(emulation.stop().exit == 0);
    served.end();
    controlled.process().interrupt();
    CHECK(controlled.wait().exit == 0);
}

}  // namespace hostile_test
