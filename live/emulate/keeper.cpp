// SPDX-License-Identifier: MIT
#include "live/emulate/keeper.hpp"

#include "live/emulate/descriptor_socket.hpp"
#include "live/emulate/members.hpp"
#include "live/emulate/robot_listener.hpp"
#include "sim/error.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace rovernet {
namespace {

using namespace std::chrono_literals;

[[noreturn]] void fail(const std::string& what) {
    throw RunError(fmt::format("{}: {}", what, std::strerror(errno)));
}

void write_file(const char* path, const std::string& text) {
    const int file = open(path, O_WRONLY | O_CLOEXEC);
    const bool is_written = file >= 0 && write(file, text.data(), text.size()) >= 0;
    if (file >= 0) close(file);
    if (!is_written) fail(path);
}

/// Moves this process into a user namespace, where it may make network namespaces.
void enter_user_namespace() {
    const uid_t user = geteuid();
    const gid_t group = getegid();
    if (unshare(CLONE_NEWUSER) != 0) {
        fail("this machine does not allow user namespaces; the option --udp does not need them");
    }
    write_file("/proc/self/setgroups", "deny");
    write_file("/proc/self/uid_map", fmt::format("0 {} 1", user));
    write_file("/proc/self/gid_map", fmt::format("0 {} 1", group));
}

/// Moves this process into a new network namespace. @return a descriptor of that
int enter_new_namespace() {
    if (unshare(CLONE_NEWNET) != 0) {
        if (errno != EPERM) fail("cannot create a network namespace for a robot");
        enter_user_namespace();
        if (unshare(CLONE_NEWNET) != 0) fail("cannot create a network namespace for a robot");
    }
    const int descriptor = open("/proc/self/ns/net", O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) fail("/proc/self/ns/net");
    return descriptor;
}

/// Makes the namespaces, and sends the descriptors of each namespace and its device. This runs in a
/// separate process, since a keeper inside a user namespace could not identify the users of its
/// clients.
[[noreturn]] void run_maker(int keeper, const std::vector<RobotDevice>& robots) {
    try {
        for (const RobotDevice& each : robots) {
            const int space = enter_new_namespace();
            const int device = make_tap(each);
            const bool is_taken = send_descriptor(keeper, {.descriptor = space}) &&
                                  send_descriptor(keeper, {.descriptor = device});
            if (!is_taken) break;  // nobody waits for them any more
            close(space);
            close(device);
        }
    } catch (const std::exception& fault) {
        send_descriptor(keeper, {.text = fault.what()});
    }
    _exit(0);
}

class Keeper {
  public:
    Keeper(int parent, std::string folder) : folder_(std::move(folder)) {
        polled_.push_back({parent, POLLIN, 0});
    }

    /// Opens the listeners in the network namespace of this process, where every process can
    /// connect.
    void open_listeners(const std::vector<RobotDevice>& robots) {
        for (const RobotDevice& each : robots) {
            polled_.push_back({open_listener(getppid(), each.robot), POLLIN, 0});
        }
    }

    /// Starts the process that makes all namespaces, and forwards the descriptors of their devices.
    void make(const std::vector<RobotDevice>& robots) {
        int ends[2];
        if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) fail("namespaces");
        const pid_t maker = fork();
        if (maker < 0) fail("namespaces");
        if (maker == 0) run_maker(ends[1], robots);
        close(ends[1]);
        for (std::size_t i = 0; i < robots.size(); ++i) {
            namespaces_.push_back(take(ends[0]));
            members_.add(namespaces_.back());
            const int device = take(ends[0]);
            if (!send_descriptor(parent(), {.descriptor = device})) break;
            close(device);
        }
        close(ends[0]);
        waitpid(maker, nullptr, 0);
    }

    /// Serves until the parent has gone.
    void serve() {
        while (poll(polled_.data(), polled_.size(), -1) >= 0 || errno == EINTR) {
            if (polled_.front().revents != 0) return;
            const std::size_t clients = polled_.size();
            for (std::size_t i = clients; i-- > first_client();) {
                if (polled_[i].revents != 0) leave(i);
            }
            for (std::size_t i = 1; i < first_client(); ++i) {
                if (polled_[i].revents != 0) welcome(i);
            }
        }
    }

    /// Reports the end of the run to all clients, and ends all processes in the namespaces.
    void end() {
        for (std::size_t i = first_client(); i < polled_.size(); ++i) {
            send_descriptor(polled_[i].fd, {.text = run_has_ended});
        }
        for (std::size_t i = 0; i < first_client(); ++i) close(polled_[i].fd);
        end_processes([this] { return members_.members(); });
    }

  private:
    int parent() const { return polled_.front().fd; }
    std::size_t first_client() const { return 1 + namespaces_.size(); }

    static int take(int maker) {
        const auto message = receive_descriptor(maker);
        if (!message)
            throw RunError(
                "the process that creates the network namespaces has ended; start rovernet emulate "
                "again");
        if (message->descriptor < 0) throw RunError(message->text);
        return message->descriptor;
    }

    void welcome(std::size_t listener) {
        const int client = accept4(polled_[listener].fd, nullptr, nullptr, SOCK_CLOEXEC);
        if (client < 0) {
            std::this_thread::sleep_for(10ms);  // there are too many descriptors
            return;
        }
        const auto user = user_behind(client);
        const bool may_enter = user && (*user == geteuid() || *user == 0);
        const DescriptorMessage answer =
            may_enter ? DescriptorMessage{.descriptor = namespaces_[listener - 1], .text = folder_}
                      : DescriptorMessage{.text = "the run belongs to a different user"};
        if (send_descriptor(client, answer) && may_enter) {
            polled_.push_back({client, POLLIN, 0});
        } else {
            close(client);
        }
    }

    void leave(std::size_t client) {
        close(polled_[client].fd);
        polled_.erase(polled_.begin() + static_cast<std::ptrdiff_t>(client));
    }

    std::string folder_;
    std::vector<pollfd> polled_;  // parent, listeners, then admitted clients
    std::vector<int> namespaces_;
    NamespaceSet members_;
};

/// Detaches this process from its parent: closes inherited sockets and files, which would otherwise
/// stay open, and starts a new session, since Ctrl-C at the terminal is for the parent.
/// @param  parent  socket that it keeps
/// @return it
int part_from(int parent) {
    const int socket = fcntl(parent, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    if (socket < 0) _exit(1);
    setsid();
    std::signal(SIGINT, SIG_IGN);
    std::signal(SIGTERM, SIG_DFL);
    std::signal(SIGHUP, SIG_IGN);
    const int nothing = open("/dev/null", O_RDWR | O_CLOEXEC);
    for (const int each : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nothing, each);
    const auto kept = static_cast<unsigned>(socket);
    if (kept > STDERR_FILENO + 1) close_range(STDERR_FILENO + 1, kept - 1, 0);
    close_range(kept + 1, ~0U, 0);
    return socket;
}

}  // namespace

void run_keeper(int socket, const std::vector<RobotDevice>& robots, const std::string& folder) {
    const int parent = part_from(socket);
    Keeper keeper(parent, folder);
    try {
        keeper.open_listeners(robots);
        keeper.make(robots);
        keeper.serve();
        keeper.end();
    } catch (const std::exception& fault) {
        send_descriptor(parent, {.text = fault.what()});
    }
    _exit(0);
}

}  // namespace rovernet
