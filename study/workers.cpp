// SPDX-License-Identifier: MIT
#include "study/workers.hpp"

#include "sim/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <new>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace rovernet {
namespace {

constexpr std::size_t longest_words = 2000;  // bytes of last words that are kept

/// Head of an answer on the pipe.
struct AnswerHead {
    std::uint64_t size;
    std::uint64_t failed;  // 0 or 1
};

double now_s() {
    const auto t = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<double>(t).count();
}

bool send_all(int socket, const void* bytes, std::size_t size) {
    const char* at = static_cast<const char*>(bytes);
    while (size > 0) {
        const ssize_t n = send(socket, at, size, MSG_NOSIGNAL);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) return false;
        at += n;
        size -= static_cast<std::size_t>(n);
    }
    return true;
}

bool read_all(int file, void* bytes, std::size_t size) {
    char* at = static_cast<char*>(bytes);
    while (size > 0) {
        const ssize_t n = read(file, at, size);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) return false;
        at += n;
        size -= static_cast<std::size_t>(n);
    }
    return true;
}

/// Last output of a worker on standard error.
std::string last_words(int file) {
    const off_t size = lseek(file, 0, SEEK_END);
    const off_t begin = std::max<off_t>(0, size - static_cast<off_t>(longest_words));
    std::string words(static_cast<std::size_t>(size - begin), '\0');
    const ssize_t n = pread(file, words.data(), words.size(), begin);
    words.resize(static_cast<std::size_t>(std::max<ssize_t>(n, 0)));
    while (!words.empty() && words.back() == '\n') words.pop_back();
    return words;
}

std::string how_it_ended(int status) {
    if (WIFEXITED(status))
        return fmt::format("the process of the run exited with code {}", WEXITSTATUS(status));
    const int signal = WTERMSIG(status);
    return fmt::format("the process of the run was ended by signal {} ({}){}", signal,
                       strsignal(signal),
                       signal == SIGKILL ? ": by a user, or because memory was exhausted" : "");
}

void close_file(int& file) {
    if (file >= 0) close(file);
    file = -1;
}

}  // namespace

Workers::Workers(std::size_t count, Work work, WorkerLimits limits)
    : work_(std::move(work)), limits_(limits), workers_(count) {}

Workers::~Workers() {
    for (Worker& worker : workers_) {
        if (worker.pid != 0) reap(worker, "");
    }
}

std::vector<std::size_t> Workers::idle() const {
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < workers_.size(); ++i)
        if (!workers_[i].task) numbers.push_back(i);
    return numbers;
}

std::size_t Workers::busy() const {
    return static_cast<std::size_t>(std::count_if(
        workers_.begin(), workers_.end(), [](const Worker& w) { return w.task.has_value(); }));
}

void Workers::start(Worker& worker) {
    std::array<int, 2> ends{-1, -1};
    const int words = memfd_create("words", MFD_CLOEXEC);
    const pid_t parent = getpid();
    const bool made = words >= 0 && socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()) == 0;
    const pid_t pid = made ? fork() : -1;
    if (pid == 0) {
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (getppid() != parent) _exit(1);  // it died before we could ask to be told
        std::signal(SIGINT, SIG_IGN);       // Ctrl-C is for the supervisor
        std::signal(SIGHUP, SIG_IGN);       // so is the end of a terminal
        std::signal(SIGTERM, SIG_DFL);
        dup2(words, STDERR_FILENO);
        close(ends[0]);
        for (const Worker& other : workers_) {
            if (other.pid != 0) close(other.socket);
        }
        serve(ends[1]);
    }
    const int error = errno;
    close_file(ends[1]);
    if (pid < 0) {
        for (int file : {ends[0], words}) close_file(file);
        throw RunError(fmt::format("cannot start a worker process: {}", std::strerror(error)));
    }
    worker.pid = pid;
    worker.socket = ends[0];
    worker.words = words;
}

/// Main loop of a worker: reads tasks and writes results until the socket is closed.
void Workers::serve(int socket) const {
    if (limits_.memory) {
        const rlimit limit{*limits_.memory, *limits_.memory};
        setrlimit(RLIMIT_AS, &limit);
    }
    for (std::uint64_t task = 0; read_all(socket, &task, sizeof task);) {
        std::string text;
        AnswerHead head{0, 0};
        try {
            text = work_(task);
        } catch (const std::bad_alloc&) {
            constexpr std::string_view words = "out of memory; --memory sets the limit of a run\n";
            (void)!write(STDERR_FILENO, words.data(), words.size());
            _exit(1);
        } catch (const std::exception& error) {
            text = error.what();
            head.failed = 1;
        }
        head.size = text.size();
        const bool told =
            send_all(socket, &head, sizeof head) && send_all(socket, text.data(), text.size());
        if (!told) break;
    }
    _exit(0);
}

void Workers::begin(std::size_t number, std::uint64_t task) {
    Worker& worker = workers_.at(number);
    if (worker.pid == 0) start(worker);
    worker.task = task;
    worker.got.clear();
    worker.deadline = limits_.timeout_s ? now_s() + *limits_.timeout_s : INFINITY;
    if (ftruncate(worker.words, 0) == 0) lseek(worker.words, 0, SEEK_SET);
    send_all(worker.socket, &task, sizeof task);  // one that has died is found by wait()
}

/// Kills and reaps a worker. @return the end of its task
TaskEnd Workers::reap(Worker& worker, const std::string& reason) {
    kill(worker.pid, SIGKILL);
    int status = 0;
    while (waitpid(worker.pid, &status, 0) < 0 && errno == EINTR) {
    }
    TaskEnd end{worker.task.value_or(0), TaskEnd::died,
                reason.empty() ? how_it_ended(status) : reason};
    const std::string words = last_words(worker.words);
    if (!words.empty()) end.text += "; last output of the process: " + words;
    for (int* file : {&worker.socket, &worker.words}) close_file(*file);
    worker.pid = 0;
    worker.task.reset();
    return end;
}

/// Reads available bytes of a result. @return the task's end once the result is complete or the
/// worker has died
std::optional<TaskEnd> Workers::read_answer(Worker& worker) {
    std::array<char, 65536> piece;
    const ssize_t n = read(worker.socket, piece.data(), piece.size());
    if (n < 0 && errno == EINTR) return std::nullopt;
    if (n <= 0) return reap(worker, "");
    worker.got.append(piece.data(), static_cast<std::size_t>(n));
    AnswerHead head{};
    if (worker.got.size() < sizeof head) return std::nullopt;
    std::memcpy(&head, worker.got.data(), sizeof head);
    if (worker.got.size() < sizeof head + head.size) return std::nullopt;
    TaskEnd end{*worker.task, head.failed != 0 ? TaskEnd::failed : TaskEnd::done,
                worker.got.substr(sizeof head)};
    worker.task.reset();
    return end;
}

/// Milliseconds until `until` or the first deadline.
int Workers::wait_time(double until) const {
    for (const Worker& worker : workers_) {
        if (worker.task) until = std::min(until, worker.deadline);
    }
    const double ms = std::ceil(1e3 * (until - now_s()));
    return static_cast<int>(std::clamp(ms, 0.0, 1e6));
}

std::optional<TaskEnd> Workers::wait(double seconds) {
    const double until = now_s() + seconds;
    do {
        std::vector<pollfd> files;
        std::vector<Worker*> owners;
        for (Worker& worker : workers_) {
            if (!worker.task) continue;
            files.push_back({worker.socket, POLLIN, 0});
            owners.push_back(&worker);
        }
        if (poll(files.data(), files.size(), wait_time(until)) < 0) return std::nullopt;
        for (std::size_t i = 0; i < files.size(); ++i) {
            if (files[i].revents == 0) continue;
            if (auto end = read_answer(*owners[i])) return end;
        }
        for (Worker* worker : owners) {
            if (worker->task && now_s() >= worker->deadline) {
                return reap(*worker,
                            fmt::format("the run took longer than {} s, the limit of --timeout",
                                        *limits_.timeout_s));
            }
        }
    } while (now_s() < until);
    return std::nullopt;
}

}  // namespace rovernet
