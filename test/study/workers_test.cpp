// SPDX-License-Identifier: MIT
#include "study/workers.hpp"

#include "test/sanitizer.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace workers_test {
using namespace rovernet;

namespace {

constexpr double long_enough_s = 60;  // for whatever a loaded machine does meanwhile

/// Has all tasks done, and tells how each ended.
std::map<std::uint64_t, TaskEnd> all(Workers& workers, std::uint64_t tasks) {
    std::map<std::uint64_t, TaskEnd> ends;
    std::uint64_t next = 0;
    while (ends.size() < tasks) {
        for (const std::size_t idle : workers.idle())
            if (next < tasks) workers.begin(idle, next++);
        const auto end = workers.wait(long_enough_s);
        REQUIRE(end);
        ends.insert({end->task, *end});
    }
    return ends;
}

}  // namespace

TEST_CASE("workers: every task gets one result, from at most the given number of processes") {
    Workers workers(3, [](std::uint64_t task) { return fmt::format("{} {}", task, getpid()); }, {});
    const auto ends = all(workers, 100);
    std::map<std::string, int> by_process;
    for (const auto& [task, end] : ends) {
        CHECK(end.kind == TaskEnd::done);
        const auto blank = end.text.find(' ');
        CHECK(end.text.substr(0, blank) == std::to_string(task));
        ++by_process[end.text.substr(blank)];
    }
    CHECK(by_process.size() <= 3);
    CHECK(workers.busy() == 0);
}

TEST_CASE("workers: a result of many megabytes arrives complete") {
    Workers workers(
        2, [](std::uint64_t task) { return std::string(20'000'000, task == 0 ? 'a' : 'b'); }, {});
    const auto ends = all(workers, 2);
    CHECK(ends.at(0).text == std::string(20'000'000, 'a'));
    CHECK(ends.at(1).text == std::string(20'000'000, 'b'));
}

TEST_CASE("workers: a task that throws an exception fails, but the worker process continues") {
    Workers workers(1,
                    [](std::uint64_t task) -> std::string {
                        if (task == 1) throw std::runtime_error("no such luck");
                        return std::to_string(getpid());
                    },
                    {});
    const auto ends = all(workers, 3);
    CHECK(ends.at(1).kind == TaskEnd::failed);
    CHECK(ends.at(1).text == "no such luck");
    CHECK(ends.at(0).text == ends.at(2).text);
}

TEST_CASE(
    "workers: a crash of a task does not affect other tasks, and the error contains the task's "
    "last output") {
    Workers workers(1,
                    [](std::uint64_t task) -> std::string {
                        if (task == 1) {
                            const std::string words(5000, '.');
                            (void)!write(STDERR_FILENO, words.data(), words.size());
                            constexpr char last[] = "the end is near\n";
                            (void)!write(STDERR_FILENO, last, sizeof last - 1);
                            raise(SIGKILL);
                        }
                        if (task == 2) _exit(7);
                        return "well";
                    },
                    {});
    const auto ends = all(workers, 4);
    CHECK(ends.at(0).text == "well");
    CHECK(ends.at(1).kind == TaskEnd::died);
    CHECK(ends.at(1).text.find("signal 9") != std::string::npos);
    CHECK(ends.at(1).text.ends_with(".the end is near"));
    CHECK(ends.at(1).text.size() < 2200);
    CHECK(ends.at(2).kind == TaskEnd::died);
    CHECK(ends.at(2).text == "the process of the run exited with code 7");
    CHECK(ends.at(3).text == "well");
}

TEST_CASE("workers: a task that takes too long is killed, while others continue") {
    Workers workers(2,
                    [](std::uint64_t task) -> std::string {
                        if (task == 0) {
                            for (;;) pause();
                        }
                        return "well";
                    },
                    {.timeout_s = 0.3, .memory = {}});
    const auto ends = all(workers, 20);
    CHECK(ends.at(0).kind == TaskEnd::died);
    CHECK(ends.at(0).text == "the run took longer than 0.3 s, the limit of --timeout");
    for (std::uint64_t task = 1; task < 20; ++task) CHECK(ends.at(task).text == "well");
}

TEST_CASE("workers: a task that needs too much memory fails, and other tasks continue") {
    if (test::has_address_sanitizer) return;  // whose shadow memory is more than any limit
    Workers workers(
        1,
        [](std::uint64_t task) {
            return std::to_string(std::string(task == 1 ? 4'000'000'000 : 1, 'x').size());
        },
        {.timeout_s = {}, .memory = 2'000'000'000});
    const auto ends = all(workers, 3);
    CHECK(ends.at(1).kind == TaskEnd::died);
    CHECK(ends.at(1).text.find("out of memory") != std::string::npos);
    CHECK(ends.at(2).text == "1");
}

TEST_CASE("workers: a worker that died between tasks is detected and replaced") {
    Workers workers(1, [](std::uint64_t) { return std::to_string(getpid()); }, {});
    workers.begin(0, 0);
    const pid_t pid = std::stoi(workers.wait(long_enough_s)->text);
    kill(pid, SIGKILL);
    workers.begin(0, 1);
    CHECK(workers.wait(long_enough_s)->kind == TaskEnd::died);
    workers.begin(0, 1);
    CHECK(workers.wait(long_enough_s)->kind == TaskEnd::done);
}

TEST_CASE("workers: waiting for a result ends after the given time") {
    Workers workers(1,
                    [](std::uint64_t) -> std::string {
                        for (;;) pause();
                    },
                    {});
    CHECK_FALSE(workers.wait(0.01));
    workers.begin(0, 0);
    CHECK_FALSE(workers.wait(0.05));
    CHECK(workers.busy() == 1);
    CHECK(workers.idle().empty());
}

TEST_CASE("workers: worker processes do not outlive their parent process") {
    int pids[2];
    REQUIRE(pipe(pids) == 0);
    const pid_t supervisor = fork();
    if (supervisor == 0) {
        Workers workers(1,
                        [&](std::uint64_t) -> std::string {
                            const pid_t own = getpid();
                            (void)!write(pids[1], &own, sizeof own);
                            for (;;) pause();
                        },
                        {});
        workers.begin(0, 0);
        for (;;) pause();
    }
    pid_t worker = 0;
    REQUIRE(read(pids[0], &worker, sizeof worker) == sizeof worker);
    kill(supervisor, SIGKILL);
    using namespace std::chrono_literals;
    waitpid(supervisor, nullptr, 0);
    bool gone = false;
    for (int i = 0; i < 6000 && !gone; ++i) {
        std::ifstream state(fmt::format("/proc/{}/stat", worker));
        std::string number, name, letter;
        gone = !(state >> number >> name >> letter) || letter == "Z";
        std::this_thread::sleep_for(10ms);
    }
    CHECK(gone);
}

TEST_CASE("workers: each task is executed by the worker process that the caller names") {
    Workers workers(3, [](std::uint64_t) { return std::to_string(getpid()); }, {});
    std::map<std::size_t, std::set<std::string>> processes;
    for (int i = 0; i < 9; ++i) {
        const std::size_t worker = static_cast<std::size_t>(i) % 3;
        CHECK(workers.idle() == std::vector<std::size_t>{0, 1, 2});
        workers.begin(worker, 0);
        CHECK(workers.idle().size() == 2);
        std::optional<TaskEnd> end;
        while (!end) end = workers.wait(1);
        processes[worker].insert(end->text);
    }
    CHECK(processes.size() == 3);
    for (const auto& [worker, pids] : processes) CHECK(pids.size() == 1);
}

}  // namespace workers_test
