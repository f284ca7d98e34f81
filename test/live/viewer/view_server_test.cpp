// SPDX-License-Identifier: MIT
#include "live/viewer/view_server.hpp"

#include "test/live/web_client.hpp"

#include <doctest/doctest.h>

#include <atomic>
#include <string>
#include <string_view>
#include <thread>

namespace view_server_test {
using namespace rovernet;

TEST_CASE("view server: the server gives the page, the view file and answers, and nothing else") {
    const std::string file("RVW1\0\xff data", 12);
    ViewServer server(
        {"127.0.0.1", 0}, file,
        [](std::string_view question) { return "to " + std::string(question); }, "RVW1 other");
    const std::string url = server.url();
    const int port = std::stoi(url.substr(url.rfind(':') + 1));
    std::atomic<bool> goes_on = true;
    std::thread serving([&] { server.serve([&] { return goes_on.load(); }); });
    const auto get = [&](const std::string& path, const std::string& host) {
        test::LineClient client(port);
        client.send_bytes("GET " + path + " HTTP/1.1\r\nHost: " + host +
                          "\r\nConnection: close\r\n\r\n");
        return client.bytes(1 << 20);
    };
    const std::string own = "127.0.0.1:" + std::to_string(port);
    const std::string page = get("/", own);
    CHECK(page.find("HTTP/1.1 200") == 0);
    CHECK(page.find("connect-src 'self'") != page.npos);
    CHECK(get("/run.rvw", own).find(file) != std::string::npos);
    CHECK(page.find("id=\"other\"") != page.npos);
    CHECK(get("/other.rvw", own).find("RVW1 other") != std::string::npos);
    for (const char* path : {"/", "/run.rvw", "/other.rvw"}) {
        CAPTURE(path);
        const std::string answer = get(path, own);
        for (const char* field :
             {"Cache-Control: no-store\r\n", "X-Content-Type-Options: nosniff\r\n",
              "Referrer-Policy: no-referrer\r\n", "Cross-Origin-Resource-Policy: same-origin\r\n",
              "X-Frame-Options: DENY\r\n"}) {
            CHECK(answer.find(field) < answer.find("\r\n\r\n"));
        }
    }
    const auto policy = [&](const std::string& before, const std::string& after) {
        const std::size_t from = page.find(before) + before.size();
        return page.substr(from, page.find(after, from) - from);
    };
    const std::string in_header = policy("Content-Security-Policy: ", "\r\n");
    CHECK(in_header.find("default-src 'none'") == 0);
    CHECK(in_header == policy("<meta http-equiv=\"Content-Security-Policy\" content=\"", "\">"));
    CHECK(get("/etc/passwd", own).find("HTTP/1.1 404") == 0);
    CHECK(get("/", "example.org").find("HTTP/1.1 403") == 0);
    test::WebClient client(port);
    REQUIRE(client.is_in());
    client.send("{}");
    CHECK(client.message() == "to {}");
    goes_on = false;
    serving.join();
}

TEST_CASE("view server: other machines need the token, which is in the address") {
    ViewServer server({"0.0.0.0", 0}, "RVW1", [](std::string_view) { return "{}"; });
    const std::string url = server.url();
    const std::size_t token = url.find("/?token=");
    REQUIRE(token != url.npos);
    const int port = std::stoi(url.substr(url.rfind(':', token) + 1));
    std::atomic<bool> goes_on = true;
    std::thread serving([&] { server.serve([&] { return goes_on.load(); }); });
    const auto get = [&](const std::string& path) {
        test::LineClient client(port);
        client.send_bytes("GET " + path + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) +
                          "\r\nConnection: close\r\n\r\n");
        return client.bytes(1 << 20).substr(9, 3);
    };
    CHECK(get("/") == "200");  // the page alone: loaded again, it has the token from its tab
    CHECK(get("/run.rvw") == "403");
    CHECK(get("/run.rvw?token=0") == "403");
    CHECK(get(url.substr(token)) == "200");
    CHECK(get("/run.rvw" + url.substr(token + 1)) == "200");
    goes_on = false;
    serving.join();
}

}  // namespace view_server_test
