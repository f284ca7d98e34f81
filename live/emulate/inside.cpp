// SPDX-License-Identifier: MIT
#include "live/emulate/inside.hpp"

#include "live/emulate/descriptor_socket.hpp"
#include "live/emulate/members.hpp"
#include "network/network.hpp"
#include "sim/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <optional>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace rovernet {
namespace {

/// Signals that this process waits for: signals to forward to the program, and SIGCHLD.
class Signals {
  public:
    Signals() {
        sigset_t ours;
        sigemptyset(&ours);
        for (const int each :
             {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGUSR1, SIGUSR2, SIGALRM, SIGCHLD}) {
            sigaddset(&ours, each);
        }
        sigprocmask(SIG_BLOCK, &ours, &usual_);
        descriptor_ = OwnDescriptor(signalfd(-1, &ours, SFD_CLOEXEC | SFD_NONBLOCK));
    }
    ~Signals() { let_through(); }
    Signals(const Signals&) = delete;
    Signals& operator=(const Signals&) = delete;

    /// Restores the signal mask.
    void let_through() const { sigprocmask(SIG_SETMASK, &usual_, nullptr); }
    int descriptor() const { return descriptor_.get(); }
    /// The next one; nothing if none waits.
    std::optional<signalfd_siginfo> next() const {
        signalfd_siginfo info{};
        const bool is_whole = read(descriptor_.get(), &info, sizeof info) == sizeof info;
        return is_whole ? std::optional(info) : std::nullopt;
    }

  private:
    sigset_t usual_{};
    OwnDescriptor descriptor_;
};

/// Two ends of a pipe: what is written to the second is read from the first.
struct Pipe {
    Pipe() {
        std::array<int, 2> ends{-1, -1};
        if (pipe2(ends.data(), O_CLOEXEC) != 0) throw RunError(std::strerror(errno));
        out = OwnDescriptor(ends[0]);
        in = OwnDescriptor(ends[1]);
    }
    OwnDescriptor out, in;
};

/// Executes the program in the new process; writes the error to `fault` on failure.
[[noreturn]] void become(const RobotNetwork& network, const std::vector<std::string>& words,
                         const Signals& signals, int fault) {
    std::vector<std::string> own = words;
    std::vector<char*> arguments;
    for (std::string& each : own) arguments.push_back(each.data());
    arguments.push_back(nullptr);
    std::string why;
    try {
        enter_network(network);
        prctl(PR_SET_PDEATHSIG, SIGKILL);  // nobody would be left who ends it with the run
        std::signal(SIGPIPE, SIG_DFL);
        for (const int each : {SIGINT, SIGTERM}) std::signal(each, SIG_DFL);
        signals.let_through();
        execvp(arguments.front(), arguments.data());
        why = fmt::format("{}: {}", words.front(), std::strerror(errno));
    } catch (const std::exception& error) {
        why = error.what();
    }
    (void)!write(fault, why.data(), why.size());
    _exit(1);
}

/// A program that goes on.
class Program {
  public:
    Program(const RobotNetwork& network, const std::vector<std::string>& words)
        : network_(network) {
        inside_.add(network.space.get());
        prctl(PR_SET_CHILD_SUBREAPER, 1);  // what it leaves behind is still found
        Pipe fault;
        process_ = fork();
        if (process_ < 0) throw RunError(std::strerror(errno));
        if (process_ == 0) become(network, words, signals_, fault.in.get());
        fault.in = OwnDescriptor();
        std::string why(4096, '\0');
        const ssize_t got = read(fault.out.get(), why.data(), why.size());
        if (got <= 0) return;
        waitpid(process_, nullptr, 0);
        why.resize(static_cast<std::size_t>(got));
        throw RunError(why);
    }

    ProgramEnd wait() {
        std::array<pollfd, 2> polled{
            {{network_.connection.get(), POLLIN, 0}, {signals_.descriptor(), POLLIN, 0}}};
        while (!status_) {
            if (poll(polled.data(), polled.size(), -1) < 0 && errno != EINTR) break;
            if (polled[0].revents != 0) return end_with_run();
            while (const auto signal = signals_.next()) take(*signal);
        }
        return {status_.value_or(0), false};
    }

  private:
    void take(const signalfd_siginfo& signal) {
        if (signal.ssi_signo == SIGCHLD) return reap();
        const bool is_sent = signal.ssi_code <= 0;  // else the terminal has sent it to both
        if (is_sent) kill(process_, static_cast<int>(signal.ssi_signo));
    }

    /// Reaps the program and its orphaned descendants.
    void reap() {
        int status = 0;
        for (pid_t ended = 0; (ended = waitpid(-1, &status, WNOHANG)) > 0;) {
            if (ended == process_) status_ = status;
        }
    }

    ProgramEnd end_with_run() {
        const auto message = receive_descriptor(network_.connection.get());
        const bool keeper_ends_them = message.has_value();
        end_processes([&] {
            reap();
            std::vector<pid_t> left = descendants();
            const std::vector<pid_t> inside = inside_.members();
            for (const pid_t each : inside) {
                const auto found = std::find(left.begin(), left.end(), each);
                if (keeper_ends_them && found != left.end()) left.erase(found);
                if (!keeper_ends_them && found == left.end()) left.push_back(each);
            }
            return left;
        });
        if (keeper_ends_them) await_keeper();
        reap();
        return {status_.value_or(0), true};
    }

    /// Waits until the keeper has ended the running processes, and ends the remaining ones.
    void await_keeper() {
        while (receive_descriptor(network_.connection.get())) {
        }
        end_processes([this] {
            reap();
            return descendants();
        });
    }

    const RobotNetwork& network_;
    NamespaceSet inside_;
    Signals signals_;
    pid_t process_ = -1;
    std::optional<int> status_;
};

}  // namespace

ProgramEnd run_inside(const RobotNetwork& network, const std::vector<std::string>& words) {
    return Program(network, words).wait();
}

void end_like(int status) {
    std::fflush(nullptr);
    if (!WIFSIGNALED(status)) std::exit(WEXITSTATUS(status));
    const int signal = WTERMSIG(status);
    prctl(PR_SET_DUMPABLE, 0);  // the program has left its core, if it is wanted
    std::signal(signal, SIG_DFL);
    sigset_t only;
    sigemptyset(&only);
    sigaddset(&only, signal);
    sigprocmask(SIG_UNBLOCK, &only, nullptr);
    raise(signal);
    constexpr int by_signal = 128;  // as shells say it
    std::exit(by_signal + signal);
}

}  // namespace rovernet
