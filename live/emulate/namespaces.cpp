// SPDX-License-Identifier: MIT
#include "live/emulate/namespaces.hpp"

#include "experiment/run.hpp"
#include "live/emulate/descriptor_socket.hpp"
#include "live/emulate/keeper.hpp"
#include "sim/error.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

namespace rovernet {
namespace {

[[noreturn]] void fail() {
    throw RunError(fmt::format("cannot create the network namespaces of the robots: {}",
                               std::strerror(errno)));
}

}  // namespace

Namespaces::Namespaces(std::vector<RobotDevice> robots, const std::string& folder,
                       const std::function<bool()>& go_on)
    : robots_(std::move(robots)) {
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) fail();
    keeper_ = fork();
    if (keeper_ == 0) run_keeper(ends[1], robots_, std::filesystem::absolute(folder).string());
    close(ends[1]);
    keeper_socket_ = ends[0];
    if (keeper_ < 0) fail();
    try {
        receive_devices(go_on);
    } catch (...) {
        end();
        throw;
    }
}

void Namespaces::receive_devices(const std::function<bool()>& go_on) {
    constexpr int look_every_ms = 50;
    while (devices_.size() < robots_.size()) {
        pollfd keeper{keeper_socket_, POLLIN, 0};
        const int is_there = poll(&keeper, 1, look_every_ms);
        if (!go_on()) throw Interrupted();
        if (is_there <= 0) continue;
        const auto message = receive_descriptor(keeper_socket_);
        if (!message) {
            throw RunError(
                "the process that holds the robots' network namespaces has died; start rovernet "
                "emulate again");
        }
        if (message->descriptor < 0) throw RunError(message->text);
        devices_.push_back(message->descriptor);
    }
}

Namespaces::~Namespaces() { end(); }

void Namespaces::end() {
    for (const int each : devices_) {
        if (each >= 0) close(each);
    }
    close(keeper_socket_);  // so the keeper ends
    waitpid(keeper_, nullptr, 0);
}

int Namespaces::take_device(std::size_t robot) { return std::exchange(devices_.at(robot), -1); }

}  // namespace rovernet
