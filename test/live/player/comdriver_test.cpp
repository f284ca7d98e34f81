// SPDX-License-Identifier: MIT
// The comdriver of the 2007 thesis, served from a world and its configuration: the first byte of a
// message is its time-to-live.
#include "test/live/live_command.hpp"

#include <doctest/doctest.h>

#include <deque>
#include <map>
#include <string>
#include <vector>

namespace comdriver_test {
using namespace rovernet::test;

namespace {

constexpr std::uint32_t opaque = 51;

/// Four robots in a row, of which neighbours hear one another.
const std::string row = R"(define bot position ( wifi ( model "simple" range 6 ) )
bot ( name "r1" pose [0 0 0] )
bot ( name "r2" pose [5 0 0] )
bot ( name "r3" pose [10 0 0] )
bot ( name "r4" pose [15 0 0] )
)";

std::string configuration() {
    std::string text =
        R"(driver ( name "stage" plugin "stageplugin" provides [ "simulation:0" ] worldfile "row.world" )
)";
    for (int i = 1; i <= 4; ++i) {
        const std::string port = "\"" + std::to_string(6664 + i) + ":";
        text += "driver ( name \"stage\" model \"r" + std::to_string(i) + "\" provides [ " + port +
                "position2d:0\" " + port + "wifi:0\" ] )\ndriver ( name \"relay\" provides [ " +
                port + "opaque:0\" ] )\ndriver ( name \"comdriver\" provides [ " + port +
                "opaque:1\" ]\n requires [ " + port + "wifi:0\" " + port + "opaque:0\" ] )\n";
    }
    return text;
}

/// What each robot's client heard on its comdriver after r1 had said this, in hexadecimal digits.
std::vector<std::string> heard_of(const std::string& message) {
    const TemporaryFolder folder;
    folder.write("row.world", row);
    const Process live(folder,
                       {"live", folder.write("row.cfg", configuration()), "--player", "127.0.0.1:0",
                        "--player-lockstep", "--wait-for", "4", "--out", folder.path("out")});
    std::deque<LineClient> clients;
    for (int i = 1; i <= 4; ++i) {
        clients.emplace_back(
            read_port(said(folder, "listening on 127.0.0.1:", "r" + std::to_string(i) + ")")));
        CHECK(clients.back().bytes(32).starts_with("Player v."));
        clients.back().send_bytes(mode(pull) + device(opaque, 1) + device(4, 0));
    }
    clients[0].send_bytes(order(opaque, 1, counted(message)));
    std::vector<std::string> heard(4);
    for (int round = 0; round < 3; ++round) {
        for (LineClient& client : clients) client.send_bytes(ask());
        for (std::size_t i = 0; i < clients.size(); ++i) {
            for (Wire told = message_of(clients[i]); told.type != sync_message;
                 told = message_of(clients[i])) {
                if (told.type != data || told.interface != opaque) continue;
                heard[i] += to_hex(told.payload.substr(8, message.size()));
            }
        }
    }
    for (LineClient& client : clients) client.close();
    CHECK(live.wait().exit == 0);
    return heard;
}

}  // namespace

TEST_CASE("comdriver: robots decrement a message's first byte, and stop forwarding at 0") {
    using Heard = std::vector<std::string>;
    CHECK(heard_of("\x01"
                   "F") == Heard{"", "0046", "", ""});
    CHECK(heard_of("\x02"
                   "F") == Heard{"", "0146", "0046", ""});
    CHECK(heard_of("\x03"
                   "F") == Heard{"", "0246", "0146", "0046"});
    CHECK(heard_of("\xFF"
                   "F") == Heard{"", "fe46", "fd46", "fc46"});
    CHECK(heard_of(std::string("\0"
                               "F",
                               2)) == Heard{"", "0046", "", ""});
}

}  // namespace comdriver_test
