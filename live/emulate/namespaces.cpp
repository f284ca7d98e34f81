// SPDX-License-Identifier: MIT
#include "live/emulate/namespaces.hpp"

#include "live/emulate/descriptor_socket.hpp"
#include "sim/error.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <linux/nsfs.h>
#include <poll.h>
#include <sched.h>
#include <set>
#include <stdexcept>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

namespace rovernet {
namespace {

constexpr std::string_view door_name = "rovernet/";
constexpr int door_type = SOCK_SEQPACKET | SOCK_CLOEXEC;  // whole messages

[[noreturn]] void fail(const std::string& what) {
    throw RunError(fmt::format("{}: {}", what, std::strerror(errno)));
}

/// Abstract Unix address of a robot's door: it has no file, and goes with its process.
class DoorAddress {
  public:
    /// @throws RunError for a name that is too long
    DoorAddress(pid_t run, const std::string& robot) {
        const std::string name = fmt::format("{}{}/{}", door_name, run, robot);
        if (name.size() >= sizeof address_.sun_path) {
            throw RunError(fmt::format("robot {}: the name is too long for its namespace", robot));
        }
        address_.sun_family = AF_UNIX;
        std::memcpy(address_.sun_path + 1, name.data(), name.size());
        size_ = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
    }
    const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&address_); }
    socklen_t size() const { return size_; }

  private:
    sockaddr_un address_{};
    socklen_t size_;
};

int listen_at(const DoorAddress& address) {
    const int door = socket(AF_UNIX, door_type, 0);
    constexpr int waiting = 16;
    if (door < 0 || bind(door, address.get(), address.size()) != 0 || listen(door, waiting) != 0) {
        fail("door of a namespace");
    }
    return door;
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
        fail("a user namespace is not allowed here, and without one there is --udp");
    }
    write_file("/proc/self/setgroups", "deny");
    write_file("/proc/self/uid_map", fmt::format("0 {} 1", user));
    write_file("/proc/self/gid_map", fmt::format("0 {} 1", group));
}

/// Moves this process into a new network namespace. @return a descriptor of that
int enter_new_namespace() {
    if (unshare(CLONE_NEWNET) != 0) {
        if (errno != EPERM) fail("network namespace");
        enter_user_namespace();
        if (unshare(CLONE_NEWNET) != 0) fail("network namespace");
    }
    const int descriptor = open("/proc/self/ns/net", O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) fail("/proc/self/ns/net");
    return descriptor;
}

/// Process that keeps the namespaces and hands them out.
class Keeper {
  public:
    /// @param parent  socket to the process for which it works
    explicit Keeper(int parent) { polled_.push_back({parent, POLLIN, 0}); }

    /// Makes all namespaces, and sends the descriptors of their devices.
    void make(const std::vector<RobotDevice>& robots) {
        for (const RobotDevice& each : robots) {
            // Its door belongs to the namespace that everybody is in.
            polled_.push_back({listen_at({getppid(), each.robot}), POLLIN, 0});
        }
        for (const RobotDevice& each : robots) {
            namespaces_.push_back(enter_new_namespace());
            const int device = make_tap(each);
            send_descriptor(parent(), {.descriptor = device});
            close(device);
        }
    }

    /// Serves until the parent has gone.
    void serve() {
        while (poll(polled_.data(), polled_.size(), -1) >= 0 || errno == EINTR) {
            if (polled_.front().revents != 0) return;
            for (std::size_t i = 1; i < polled_.size(); ++i) {
                if (polled_[i].revents == 0) continue;
                const int client = accept4(polled_[i].fd, nullptr, nullptr, SOCK_CLOEXEC);
                if (client < 0) continue;
                send_descriptor(client, {.descriptor = namespaces_[i - 1]});
                close(client);
            }
        }
    }

    int parent() const { return polled_.front().fd; }

  private:
    std::vector<pollfd> polled_;  // the parent, then the doors
    std::vector<int> namespaces_;
};

[[noreturn]] void run_keeper(int parent, const std::vector<RobotDevice>& robots) {
    std::signal(SIGINT, SIG_IGN);  // Ctrl-C is for the parent
    std::signal(SIGHUP, SIG_IGN);
    std::signal(SIGTERM, SIG_DFL);
    Keeper keeper(parent);
    try {
        keeper.make(robots);
        keeper.serve();
    } catch (const std::exception& fault) {
        send_descriptor(parent, {.text = fault.what()});
    }
    _exit(0);
}

}  // namespace

Namespaces::Namespaces(std::vector<RobotDevice> robots) : robots_(std::move(robots)) {
    int ends[2];
    if (socketpair(AF_UNIX, door_type, 0, ends) != 0) fail("namespaces");
    keeper_ = fork();
    if (keeper_ == 0) {
        close(ends[0]);
        run_keeper(ends[1], robots_);
    }
    close(ends[1]);
    keeper_socket_ = ends[0];
    if (keeper_ < 0) fail("namespaces");
    try {
        receive_devices();
    } catch (...) {
        end();
        throw;
    }
}

void Namespaces::receive_devices() {
    while (devices_.size() < robots_.size()) {
        const auto message = receive_descriptor(keeper_socket_);
        if (!message) throw RunError("the keeper of the namespaces has ended");
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

namespace {

/// Robot that has a namespace.
struct EmulatedRobot {
    std::string name;
    pid_t run;
    friend auto operator<=>(const EmulatedRobot&, const EmulatedRobot&) = default;
};

/// Robots of all runs on this machine, by the doors that its keepers have.
std::set<EmulatedRobot> emulated_robots() {
    std::set<EmulatedRobot> robots;
    std::ifstream sockets("/proc/net/unix");
    const std::string mark = fmt::format(" @{}", door_name);
    for (std::string line; std::getline(sockets, line);) {
        const std::size_t place = line.find(mark);
        if (place == std::string::npos) continue;
        const char* const begin = line.data() + place + mark.size();
        const char* const end = line.data() + line.size();
        EmulatedRobot robot{};
        const auto [rest, error] = std::from_chars(begin, end, robot.run);
        if (error != std::errc{} || rest == end || *rest != '/') continue;
        robot.name.assign(rest + 1, end);
        robots.insert(std::move(robot));
    }
    return robots;
}

/// The one robot that is meant. @throws std::invalid_argument, telling which there are
EmulatedRobot chosen(const std::string& name, std::optional<pid_t> run) {
    const std::set<EmulatedRobot> all = emulated_robots();
    std::vector<EmulatedRobot> found;
    std::string names, runs;
    for (const EmulatedRobot& each : all) {
        names += (names.empty() ? "" : ", ") + each.name;
        if (each.name != name || each.run != run.value_or(each.run)) continue;
        found.push_back(each);
        runs += fmt::format("{}--run {}", runs.empty() ? "" : " or ", each.run);
    }
    if (found.size() == 1) return found.front();
    if (all.empty()) {
        throw std::invalid_argument("no run is going on here: start one by rovernet emulate FILE");
    }
    throw std::invalid_argument(found.empty()
                                    ? fmt::format("no robot {}; there are {}", name, names)
                                    : fmt::format("several runs have a robot {}: {}", name, runs));
}

/// Asks a keeper for the namespace of a robot. @return its descriptor
int ask_for_namespace(const EmulatedRobot& robot) {
    const DoorAddress address(robot.run, robot.name);
    const int socket = ::socket(AF_UNIX, door_type, 0);
    if (socket < 0 || connect(socket, address.get(), address.size()) != 0) {
        fail("namespace of robot " + robot.name);
    }
    const auto message = receive_descriptor(socket);
    close(socket);
    if (!message || message->descriptor < 0) throw RunError("the run has ended");
    return message->descriptor;
}

}  // namespace

void enter_namespace(const std::string& robot, std::optional<pid_t> run) {
    const int space = ask_for_namespace(chosen(robot, run));  // closed when a program is run
    if (setns(space, CLONE_NEWNET) == 0) return;
    const int owner = ioctl(space, NS_GET_USERNS);  // the user namespace in which it was made
    if (owner < 0 || setns(owner, CLONE_NEWUSER) != 0 || setns(space, CLONE_NEWNET) != 0) {
        fail("namespace of robot " + robot);
    }
}

}  // namespace rovernet
