// SPDX-License-Identifier: MIT
#pragma once

#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <iterator>
#include <spawn.h>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace rovernet::test {

using Json = nlohmann::json;

inline std::string content(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

struct Ended {
    int exit;  // exit code; -1: killed by a signal, or not ended
    std::string out, err;
};

/// Process of the command rovernet or of another program, with its output in files of a folder.
class Process {
  public:
    Process(const TemporaryFolder& folder, std::vector<std::string> arguments,
            const char* program = ROVERNET_COMMAND)
        : out_(folder.path("stdout")), err_(folder.path("stderr")) {
        arguments.insert(arguments.begin(), program);
        std::vector<char*> argv;
        for (auto& argument : arguments) argv.push_back(argument.data());
        argv.push_back(nullptr);
        posix_spawn_file_actions_t files;
        posix_spawn_file_actions_init(&files);
        constexpr int create = O_WRONLY | O_CREAT | O_TRUNC;
        posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, out_.c_str(), create, 0600);
        posix_spawn_file_actions_addopen(&files, STDERR_FILENO, err_.c_str(), create, 0600);
        REQUIRE(posix_spawn(&pid_, argv[0], &files, nullptr, argv.data(), environ) == 0);
        posix_spawn_file_actions_destroy(&files);
    }

    /// Kills the process if a test failed before it waited for the process.
    ~Process() {
        if (has_ended_) return;
        kill(pid_, SIGKILL);
        waitpid(pid_, nullptr, 0);
    }
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    void interrupt() const { kill(pid_, SIGINT); }
    pid_t pid() const { return pid_; }

    /// Interrupts the process (SIGINT) every five seconds until it ends. Not more often: the fifth
    /// signal ends a command that still writes its results.
    Ended stop() const {
        using namespace std::chrono_literals;
        int status = 0;
        for (int i = 0; i < 3000; ++i) {
            if (i % 250 == 0) interrupt();
            std::this_thread::sleep_for(20ms);
            if (waitpid(pid_, &status, WNOHANG) == pid_) return ended(status);
        }
        kill(pid_, SIGKILL);
        waitpid(pid_, &status, 0);
        return ended(status);
    }

    /// Waits for the end of the process, and kills the process if that takes too long.
    Ended wait() const {
        using namespace std::chrono_literals;
        int status = 0;
        for (int i = 0; i < 6000; ++i) {
            if (waitpid(pid_, &status, WNOHANG) == pid_) return ended(status);
            std::this_thread::sleep_for(10ms);
        }
        kill(pid_, SIGKILL);
        waitpid(pid_, &status, 0);
        return ended(status);
    }

  private:
    Ended ended(int status) const {
        has_ended_ = true;
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(out_), content(err_)};
    }

    std::string out_, err_;
    pid_t pid_ = 0;
    mutable bool has_ended_ = false;
};

inline Ended command(const TemporaryFolder& folder, const std::vector<std::string>& arguments) {
    return Process(folder, arguments).wait();
}

/// JSON document that a command prints; the command must succeed.
inline Json json_of(const TemporaryFolder& folder, std::vector<std::string> arguments) {
    arguments.push_back("--json");
    const Ended ended = command(folder, arguments);
    CAPTURE(ended.err);
    REQUIRE(ended.exit == 0);
    return Json::parse(ended.out);
}

}  // namespace rovernet::test
