// SPDX-License-Identifier: MIT
#include "live/carriers/child.hpp"

#include "sim/error.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <utility>

namespace rovernet {
namespace {

constexpr auto look_every = std::chrono::milliseconds(5);

/// Attributes of a program's start: its own group, and signals as a shell has them.
class Attributes {
  public:
    Attributes() {
        posix_spawnattr_init(&value_);
        sigset_t usual;
        sigemptyset(&usual);
        for (const int each : {SIGPIPE, SIGINT, SIGTERM}) sigaddset(&usual, each);
        posix_spawnattr_setsigdefault(&value_, &usual);
        posix_spawnattr_setpgroup(&value_, 0);
        posix_spawnattr_setflags(&value_, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
    }
    ~Attributes() { posix_spawnattr_destroy(&value_); }
    Attributes(const Attributes&) = delete;
    const posix_spawnattr_t* get() const { return &value_; }

  private:
    posix_spawnattr_t value_;
};

}  // namespace

Child::Child(std::string command) : command_(std::move(command)) {
    std::array<int, 2> ends{};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
        throw RunError(fmt::format("{}: {}", command_, std::strerror(errno)));
    }
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, ends[1], STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&files, ends[1], STDOUT_FILENO);
    std::string shell = "sh", option = "-c";
    char* const words[] = {shell.data(), option.data(), command_.data(), nullptr};
    const Attributes attributes;
    const int error = posix_spawn(&pid_, "/bin/sh", &files, attributes.get(), words, environ);
    posix_spawn_file_actions_destroy(&files);
    ::close(ends[1]);
    socket_ = ends[0];
    if (error != 0) {
        pid_ = -1;
        ::close(socket_);
        throw RunError(fmt::format("{}: {}", command_, std::strerror(error)));
    }
    noted_.emplace(pid_);
}

Child::Child(Child&& other) noexcept
    : command_(std::move(other.command_)),
      pid_(std::exchange(other.pid_, -1)),
      socket_(std::exchange(other.socket_, -1)),
      fault_(std::move(other.fault_)),
      has_ended_(other.has_ended_),
      noted_(std::move(other.noted_)) {}

Child::~Child() {
    if (socket_ >= 0) ::close(socket_);
    if (pid_ >= 0) end_groups(std::span(&pid_, 1));
}

int Child::take_socket() { return std::exchange(socket_, -1); }

bool Child::has_ended() {
    siginfo_t found{};
    constexpr int look = WEXITED | WNOHANG | WNOWAIT;
    if (has_ended_ || waitid(P_PID, static_cast<id_t>(pid_), &found, look) != 0) return true;
    has_ended_ = found.si_pid == pid_;
    if (!has_ended_) return false;
    if (found.si_code != CLD_EXITED) {
        fault_ = fmt::format("{} was ended by signal {}", command_, found.si_status);
    } else if (found.si_status != 0) {
        fault_ = fmt::format("{} ended with exit code {}", command_, found.si_status);
    }
    return true;
}

std::string Child::wait_until(std::chrono::steady_clock::time_point most) {
    while (!has_ended() && std::chrono::steady_clock::now() < most) {
        std::this_thread::sleep_for(look_every);
    }
    return fault_;
}

void Child::end(std::vector<Child>& children) {
    std::vector<pid_t> leaders;
    for (Child& each : children) {
        if (each.pid_ >= 0) leaders.push_back(std::exchange(each.pid_, -1));
    }
    end_groups(leaders);
    for (Child& each : children) each.noted_.reset();
}

}  // namespace rovernet
