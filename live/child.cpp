// SPDX-License-Identifier: MIT
#include "live/child.hpp"

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
}

Child::Child(Child&& other) noexcept
    : command_(std::move(other.command_)),
      pid_(std::exchange(other.pid_, -1)),
      socket_(std::exchange(other.socket_, -1)),
      status_(other.status_) {}

Child::~Child() {
    if (socket_ >= 0) ::close(socket_);
    end();
}

int Child::take_socket() { return std::exchange(socket_, -1); }

bool Child::has_ended() {
    if (pid_ >= 0 && waitpid(pid_, &status_, WNOHANG) == pid_) pid_ = -1;
    return pid_ < 0;
}

/// Asks it to end, and ends it if it does not.
void Child::end() {
    for (const int signal : {SIGTERM, SIGKILL}) {
        if (has_ended()) return;
        kill(-pid_, signal);
        constexpr int looks = 20;
        for (int i = 0; i < looks && !has_ended(); ++i) std::this_thread::sleep_for(look_every);
    }
    if (pid_ >= 0 && waitpid(pid_, &status_, 0) == pid_) pid_ = -1;
}

std::string Child::wait(std::chrono::milliseconds most) {
    const auto until = std::chrono::steady_clock::now() + most;
    while (!has_ended() && std::chrono::steady_clock::now() < until) {
        std::this_thread::sleep_for(look_every);
    }
    if (!has_ended()) {
        end();
        return {};
    }
    if (WIFSIGNALED(status_)) {
        return fmt::format("{} ended by signal {}", command_, WTERMSIG(status_));
    }
    const int code = WEXITSTATUS(status_);
    return code == 0 ? std::string() : fmt::format("{} ended with {}", command_, code);
}

}  // namespace rovernet
