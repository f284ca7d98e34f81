// SPDX-License-Identifier: MIT
#include "study/write_lock.hpp"

#include "sim/error.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>
#include <thread>
#include <unistd.h>

namespace rovernet {

WriteLock::WriteLock(const std::string& path)
    : file_(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
    if (file_ < 0) {
        throw RunError(
            fmt::format("{}: cannot be written ({}); check the folder and its permissions, or "
                        "give another with --store",
                        path, std::strerror(errno)));
    }
    using namespace std::chrono_literals;
    // The workers of a sweep that was killed may hold it for a moment longer.
    for (int i = 0; flock(file_, LOCK_EX | LOCK_NB) != 0; ++i) {
        if (i == 100) {
            close(file_);
            throw RunError(path +
                           ": another sweep is writing to this store; wait for its end, or give "
                           "another with --store");
        }
        std::this_thread::sleep_for(10ms);
    }
}

WriteLock::~WriteLock() { close(file_); }

}  // namespace rovernet
