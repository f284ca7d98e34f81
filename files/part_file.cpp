// SPDX-License-Identifier: MIT
#include "files/part_file.hpp"

#include "files/kept_inputs.hpp"
#include "sim/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace rovernet {
namespace {

namespace fs = std::filesystem;

/// Lock on a part: it shows that the writer is alive.
constexpr int mine = LOCK_EX;

/// Creates a new locked file; -1 and errno on failure.
int create_locked(const std::string& part) {
    for (;;) {
        const int file = open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (file < 0) return file;
        struct stat status {};
        // Another process may have removed the file as an orphan between open and flock.
        if (flock(file, mine) != 0 || fstat(file, &status) != 0 || status.st_nlink > 0) return file;
        ::close(file);
    }
}

}  // namespace

bool is_part_of(std::string_view whole, std::string_view name) {
    constexpr std::string_view ending = ".part";
    if (name.size() <= whole.size() + 1 + ending.size()) return false;
    if (!name.starts_with(whole) || !name.ends_with(ending)) return false;
    name.remove_prefix(whole.size());
    name.remove_suffix(ending.size());
    return name[0] == '.' &&
           std::all_of(name.begin() + 1, name.end(), [](char c) { return c >= '0' && c <= '9'; });
}

void remove_orphans(const std::string& whole) {
    const fs::path path(whole);
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    std::error_code ignored;
    for (fs::directory_iterator entry(folder, ignored), end; entry != end;
         entry.increment(ignored)) {
        const fs::path& other = entry->path();
        if (!is_part_of(path.filename().native(), other.filename().native())) continue;
        const int file = open(other.c_str(), O_WRONLY | O_NOFOLLOW | O_CLOEXEC);
        if (file < 0) continue;
        if (flock(file, mine | LOCK_NB) == 0) unlink(other.c_str());
        ::close(file);
    }
}

PartFile::PartFile(std::string path, Failed failed, Orphans orphans)
    : path_(std::move(path)), failed_(failed) {
    std::error_code ignored;
    const auto status = fs::status(path_, ignored);
    // A rename would replace a device by a file.
    if (exists(status) && !is_regular_file(status))
        fail("a file of this name exists, and it is not a regular file");
    if (orphans == Orphans::are_removed) remove_orphans(path_);
    for (auto n = static_cast<std::uint64_t>(getpid());; ++n) {
        const std::string part = fmt::format("{}.{}.part", path_, n);
        file_ = create_locked(part);
        if (file_ >= 0) part_ = part;
        if (file_ >= 0 || errno != EEXIST) break;
    }
    if (file_ < 0) fail(std::strerror(errno));
}

PartFile::PartFile(PartFile&& other) noexcept
    : path_(std::move(other.path_)),
      failed_(other.failed_),
      part_(std::exchange(other.part_, {})),
      file_(std::exchange(other.file_, -1)) {}

void PartFile::write(std::string_view bytes) {
    if (file_ < 0) fail("an earlier write has failed");
    while (!bytes.empty()) {
        const ssize_t n = ::write(file_, bytes.data(), bytes.size());
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) fail(std::strerror(errno));
        bytes.remove_prefix(static_cast<std::size_t>(n));
    }
}

void PartFile::close() {
    if (file_ < 0) fail("an earlier write has failed");
    // Some file systems report a full disk only at close(); the copy keeps the lock.
    const int copy = fcntl(file_, F_DUPFD_CLOEXEC, 0);
    if (copy < 0 || ::close(std::exchange(file_, copy)) != 0) fail(std::strerror(errno));
}

void PartFile::give_name() {
    close();
    std::ifstream contents(part_, std::ios::binary);
    if (replaces_input(path_, contents))
        fail("this file is an input of the command; expected a different file to write");
    if (std::rename(part_.c_str(), path_.c_str()) != 0) fail(std::strerror(errno));
    part_.clear();
    discard();
}

void PartFile::keep() {
    close();
    part_.clear();
    discard();
}

void PartFile::discard() {
    if (!part_.empty()) unlink(part_.c_str());
    part_.clear();
    if (file_ >= 0) ::close(std::exchange(file_, -1));
}

void PartFile::fail(std::string_view why) {
    std::string message = fmt::format("{}: cannot be written: {}", path_, why);
    if (failed_ == Failed::is_kept && !part_.empty()) {
        message +=
            fmt::format("; the file {} keeps the part that was written", std::exchange(part_, {}));
    }
    discard();
    throw RunError(message);
}

FolderLock::FolderLock(const std::string& folder)
    : folder_(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    while (folder_ >= 0 && flock(folder_, LOCK_EX) != 0 && errno == EINTR) {
    }
}

FolderLock::~FolderLock() {
    if (folder_ >= 0) close(folder_);
}

}  // namespace rovernet
