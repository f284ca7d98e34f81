// SPDX-License-Identifier: MIT
// Who reaches the servers of the command `live` from another machine. They listen beyond loopback
// here, so everything happens in a network namespace of its own, which nobody else reaches. Where
// that is forbidden, the test says so and passes.
#include "test/live/live_command.hpp"

#include <doctest/doctest.h>

#include <string>

namespace reach_test {
using namespace rovernet::test;

namespace {

/// Starts the command with servers at 10.9.9.9, an address of the namespace's own, and says who
/// gets in: a line for each attempt.
constexpr const char* attempts = R"(
import socket, subprocess, sys

command, scenario, out = sys.argv[1:4]
for words in ("link set lo up", "addr add 10.9.9.9/32 dev lo"):
    subprocess.run(["ip", *words.split()], check=True)

def serve(options):
    run = subprocess.Popen([command, "live", scenario, "--quiet", "--out", out, "--listen", "10.9.9.9",
                            "--player", "127.0.0.1:0", "--player-one-port", "--rosbridge",
                            "127.0.0.1:0", *options], stdout=subprocess.PIPE, text=True)
    return run, [run.stdout.readline().strip() for _ in range(3)]

def address(line):
    host, port = line.split()[2].split(":")
    return host, int(port)

def upgraded(at, target, host, origin=""):
    with socket.create_connection(at) as client:
        client.sendall((f"GET {target} HTTP/1.1\r\nHost: {host}\r\nUpgrade: websocket\r\n"
                        "Connection: Upgrade\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
                        f"Sec-WebSocket-Version: 13\r\n{origin}\r\n").encode())
        return client.recv(1000).split()[1].decode()

def banner(at):
    try:
        with socket.create_connection(at) as client:
            return client.recv(6).decode()
    except ConnectionRefusedError:
        return "refused"

def end(run):
    run.terminate()
    run.communicate()
    print("exit", run.returncode)

run, (player, rosbridge, invitation) = serve([])
web, own = address(rosbridge), address(player)
print(web[0], own[0])
token = invitation[invitation.index("/?token="):]
name = f"{web[0]}:{web[1]}"
print(upgraded(web, "/", name), upgraded(web, token, name), upgraded(web, "/?token=" + 32 * "0", name),
      upgraded(web, "/", name, f"Origin: http://{name}\r\n"),
      upgraded(web, token, "any.name:1", "Origin: null\r\n"))
print(banner(own), banner(("10.9.9.9", own[1])))
end(run)
run, (player, _, _) = serve(["--insecure"])
print(banner(address(player)), address(player)[0])
end(run)
)";

constexpr const char* expected = R"(10.9.9.9 127.0.0.1
403 101 403 403 101
Player refused
exit 0
Player 10.9.9.9
exit 0
)";

}  // namespace

TEST_CASE(
    "listeners: other machines need the token; protocols without token accept only this machine") {
    const TemporaryFolder folder;
    const std::string program = folder.write("attempts.py", attempts);
    const std::string row = folder.write("row.toml", long_live_row());
    if (Process(folder, {"-rn", "true"}, "/usr/bin/unshare").wait().exit != 0) {
        MESSAGE("skipped: no network namespaces here");
        return;
    }
    const Ended ended =
        Process(folder,
                {"-rn", "/usr/bin/python3", program, ROVERNET_COMMAND, row, folder.path("out")},
                "/usr/bin/unshare")
            .wait();
    CAPTURE(ended.err);
    CHECK(ended.out == expected);
}

}  // namespace reach_test
