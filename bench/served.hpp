// SPDX-License-Identifier: MIT
#pragma once

#include <arpa/inet.h>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <stdexcept>
#include <string>
#include <string_view>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>
#include <vector>

namespace rovernet::bench {

[[noreturn]] inline void fail_by_system(std::string_view what) {
    throw std::runtime_error(std::string(what) + ": " + std::strerror(errno));
}

/// Command in the background that prints the addresses at which it listens. The destructor ends the
/// command.
class Served {
  public:
    explicit Served(std::vector<std::string> words) {
        int ends[2];
        if (pipe2(ends, O_CLOEXEC) != 0) fail_by_system("pipe");
        std::vector<char*> argv;
        for (std::string& word : words) argv.push_back(word.data());
        argv.push_back(nullptr);
        pid_ = fork();
        if (pid_ < 0) fail_by_system("fork");
        if (pid_ == 0) {
            prctl(PR_SET_PDEATHSIG, SIGKILL);  // ends the command if the bench is killed
            dup2(ends[1], STDOUT_FILENO);
            dup2(open("/dev/null", O_WRONLY), STDERR_FILENO);
            execv(argv[0], argv.data());
            _exit(127);
        }
        close(ends[1]);
        said_ = fdopen(ends[0], "r");
    }
    Served(Served&& other) noexcept
        : pid_(std::exchange(other.pid_, 0)), said_(std::exchange(other.said_, nullptr)) {}
    ~Served() {
        if (pid_ > 0) {
            interrupt();
            wait();
        }
        if (said_) std::fclose(said_);
    }

    /// Port in the next line in which the command prints an address.
    int port() {
        constexpr std::string_view words = "listening on 127.0.0.1:";
        std::array<char, 256> line{};
        while (std::fgets(line.data(), line.size(), said_)) {
            const std::string_view said = line.data();
            if (said.starts_with(words)) return std::atoi(line.data() + words.size());
        }
        throw std::runtime_error(
            "the measured command printed no line \"listening on 127.0.0.1:PORT\"");
    }
    void interrupt() const { kill(pid_, SIGINT); }
    /// Waits for the end of the command. @return CPU time of the command [s]
    double end() {
        const auto [status, usage] = wait();
        if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
            throw std::runtime_error("the measured command failed");
        }
        const auto seconds = [](const timeval& time) {
            return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
        };
        return seconds(usage.ru_utime) + seconds(usage.ru_stime);
    }
    /// Current resident memory of the command [bytes].
    double memory() const {
        std::ifstream file("/proc/" + std::to_string(pid_) + "/statm");
        double all = 0, resident = 0;  // numbers of memory pages
        file >> all >> resident;
        return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
    }

  private:
    std::pair<int, rusage> wait() {
        std::pair<int, rusage> ended;
        wait4(std::exchange(pid_, 0), &ended.first, 0, &ended.second);
        return ended;
    }

    pid_t pid_ = 0;
    std::FILE* said_ = nullptr;
};

/// TCP socket that listens on any free port of this machine.
class Listener {
  public:
    Listener() : socket_(socket(AF_INET, SOCK_STREAM, 0)) {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof address;
        auto* general = reinterpret_cast<sockaddr*>(&address);
        if (bind(socket_, general, size) != 0 || listen(socket_, 1) != 0) fail_by_system("listen");
        getsockname(socket_, general, &size);
        port_ = ntohs(address.sin_port);
    }
    ~Listener() { close(socket_); }
    Listener(const Listener&) = delete;
    Listener& operator=(const Listener&) = delete;

    int port() const { return port_; }
    /// Accepts one client and sends back all its bytes, until the client disconnects.
    void echo() const {
        const int client = accept(socket_, nullptr, nullptr);
        const int on = 1;
        setsockopt(client, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
        std::array<char, 4096> bytes{};
        for (;;) {
            const ssize_t got = recv(client, bytes.data(), bytes.size(), 0);
            if (got <= 0 || send(client, bytes.data(), static_cast<std::size_t>(got), 0) != got) {
                break;
            }
        }
        close(client);
    }

  private:
    int socket_;
    int port_ = 0;
};

}  // namespace rovernet::bench
