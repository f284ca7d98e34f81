// SPDX-License-Identifier: MIT
#include "files/input_file.hpp"

#include "files/kept_inputs.hpp"
#include "sim/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <poll.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>
#include <utility>

namespace rovernet {
namespace {

using namespace std::chrono_literals;
using WaitClock = std::chrono::steady_clock;

constexpr auto writer_timeout = 5s;  // for a FIFO that no program has opened for writing

bool is_terminal(const std::string& path) {
    const int file = open(path.c_str(), O_RDONLY | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    const bool is_one = file >= 0 && isatty(file) != 0;
    if (file >= 0) close(file);
    return is_one;
}

InputKind device_kind(const std::string& path, const struct stat& status) {
    const bool is_null = S_ISCHR(status.st_mode) && status.st_rdev == makedev(1, 3);
    if (is_null || (S_ISCHR(status.st_mode) && is_terminal(path))) return InputKind::stream;
    return InputKind::device;
}

/// Whether any process has the FIFO open for writing. Bytes are copied, not consumed.
bool has_writer(int fifo) {
    std::array<int, 2> copy{};
    if (pipe2(copy.data(), O_CLOEXEC) != 0) return true;
    const ssize_t n = tee(fifo, copy[1], 1, SPLICE_F_NONBLOCK);
    const bool is_open = n > 0 || (n < 0 && errno == EAGAIN);
    for (const int end : copy) close(end);
    return is_open;
}

}  // namespace

InputKind input_kind(const std::string& path) {
    struct stat status {};
    if (stat(path.c_str(), &status) != 0) {
        if (errno == ELOOP) return InputKind::loop;
        return errno == EACCES || errno == ENAMETOOLONG ? InputKind::closed : InputKind::nothing;
    }
    switch (status.st_mode & S_IFMT) {
        case S_IFREG: return InputKind::file;
        case S_IFDIR: return InputKind::folder;
        case S_IFIFO: return InputKind::stream;
        case S_IFSOCK: return InputKind::socket;
        default: return device_kind(path, status);
    }
}

std::string_view fault_of(InputKind kind) {
    switch (kind) {
        case InputKind::nothing: return "no such file";
        case InputKind::loop: return "its path is a loop of symbolic links";
        case InputKind::closed: return "its folder cannot be entered, or its name is too long";
        case InputKind::folder: return "it is a folder";
        case InputKind::device: return "it is a device, not a regular file";
        case InputKind::socket: return "it is a socket, not a regular file";
        case InputKind::stream: return "it is a pipe, not a regular file";
        case InputKind::file: break;
    }
    return "it cannot be read";
}

InputFile::InputFile(const std::string& path) : path_(path) {
    const InputKind kind = input_kind(path);
    if (kind != InputKind::file && kind != InputKind::stream) fail(fault_of(kind));
    // Opening a FIFO without O_NONBLOCK would wait for its writer.
    file_ = open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    if (file_ < 0) fail(errno == EACCES ? "no permission to read it" : std::strerror(errno));
    try {
        if (kind == InputKind::stream) wait_for_writer();
    } catch (...) {
        close(file_);
        throw;
    }
    fcntl(file_, F_SETFL, fcntl(file_, F_GETFL) & ~O_NONBLOCK);
    note_input(path);
}

InputFile::~InputFile() {
    if (file_ >= 0) close(file_);
}

int InputFile::release() { return std::exchange(file_, -1); }

void InputFile::wait_for_writer() const {
    struct stat status {};
    if (fstat(file_, &status) != 0 || !S_ISFIFO(status.st_mode)) return;
    for (const auto end = WaitClock::now() + writer_timeout; WaitClock::now() < end;) {
        pollfd events{.fd = file_, .events = POLLIN, .revents = 0};
        constexpr int a_while = 20;  // [ms]
        // A hang-up means that a writer was there and has closed the FIFO: the end of its data.
        if (poll(&events, 1, a_while) > 0 || has_writer(file_)) return;
    }
    fail(fmt::format("it is a FIFO into which no program has written for {} s",
                     writer_timeout.count()));
}

std::string InputFile::read(std::size_t most) {
    constexpr std::size_t at_once = 64 * 1024;
    std::string text;
    while (text.size() < most) {
        const std::size_t before = text.size();
        text.resize(std::min(most, before + at_once));
        const ssize_t n = ::read(file_, text.data() + before, text.size() - before);
        text.resize(before + static_cast<std::size_t>(std::max<ssize_t>(n, 0)));
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) fail(std::strerror(errno));
        if (n == 0) break;
    }
    return text;
}

void InputFile::fail(std::string_view what) const {
    throw InputError({.source = path_}, fmt::format("cannot read the file: {}", what));
}

std::string named_beside(const std::string& folder, const std::string& name) {
    const std::filesystem::path here(folder);
    if (!is_no_path(input_kind((here / name).string()))) return "";
    const std::string last = name.substr(name.find_last_of("/\\") + 1);
    const bool beside =
        last != name && !last.empty() && input_kind((here / last).string()) == InputKind::file;
    return beside ? last : "";
}

void need_file(const std::string& path) {
    const InputKind kind = input_kind(path);
    if (kind == InputKind::file) return;
    throw InputError({.source = path}, fmt::format("cannot read the file: {}", fault_of(kind)));
}

}  // namespace rovernet
