// SPDX-License-Identifier: MIT
#include "study/write_lock.hpp"

#include "experiment/version.hpp"
#include "sim/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <optional>
#include <sys/file.h>
#include <sys/vfs.h>
#include <thread>
#include <unistd.h>

namespace rovernet {
namespace {

using namespace std::chrono_literals;

// The workers of a sweep that was killed may hold a lock for a moment longer.
constexpr int most_tries = 100;
constexpr auto between_tries = 10ms;

enum class LockAnswer { yes, held, no_locks };

LockAnswer lock_whole(const FileNumber& file, int kind) {
    int result = 0;
    do result = flock(file.number(), kind | LOCK_NB);
    while (result != 0 && errno == EINTR);
    if (result == 0) return LockAnswer::yes;
    return errno == EWOULDBLOCK ? LockAnswer::held : LockAnswer::no_locks;
}

/// Tries to lock the file's first byte, which SQLite never locks, for reading.
LockAnswer lock_range(const FileNumber& file) {
    struct flock range = {};
    range.l_type = F_RDLCK;
    range.l_whence = SEEK_SET;
    range.l_len = 1;
    if (fcntl(file.number(), F_SETLK, &range) == 0) {
        range.l_type = F_UNLCK;
        fcntl(file.number(), F_SETLK, &range);
        return LockAnswer::yes;
    }
    return errno == EAGAIN || errno == EACCES ? LockAnswer::held : LockAnswer::no_locks;
}

std::string host_name() {
    std::array<char, 256> name{};
    return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "?";
}

/// Start time of a process on this host [clock ticks], which distinguishes it from a later process
/// with the same id; "" if there is no such process.
std::string begin_of(int process) {
    std::ifstream file(fmt::format("/proc/{}/stat", process));
    std::string word;
    std::getline(file, word, ')');  // its number and name
    constexpr int begin_time = 20;  // proc(5): field 22, the third is the first behind the name
    for (int i = 0; i < begin_time; ++i) word.clear(), file >> word;
    return word;
}

/// Process that has made a file PATH.lock.
struct Writer {
    int process = 0;
    std::string begin, host;

    static Writer self() {
        const int process = getpid();
        return {process, begin_of(process), host_name()};
    }
    std::string text() const { return fmt::format("{} {} {}\n", process, begin, host); }
    bool has_ended() const {
        if (host != host_name()) return false;
        const bool there = kill(process, 0) == 0 || errno == EPERM;
        return !there || begin_of(process) != begin;
    }
};

/// Content of a file PATH.lock; none if it does not exist. An incomplete file has no host.
std::optional<Writer> writer_in(const std::string& lock) {
    std::ifstream file(lock);
    if (!file) return std::nullopt;
    Writer writer;
    file >> writer.process >> writer.begin >> writer.host;
    return writer;
}

std::string lock_file(const std::string& path) { return path + ".lock"; }

[[noreturn]] void refuse(const std::string& path, const Writer& writer) {
    throw RunError(
        fmt::format("{}: process {} on {} writes to this store, as the file {} says; wait until "
                    "this process ends; if the process has already ended, remove the file {} (this "
                    "file system has no locks, so a killed process leaves this file behind)",
                    path, writer.process, writer.host.empty() ? "a host" : writer.host,
                    lock_file(path), lock_file(path)));
}

/// Removes a stale lock file. Another process may do the same and create its own lock file
/// meanwhile; a file removed by mistake is restored.
void take_away(const std::string& lock, const Writer& ended) {
    const std::string aside = fmt::format("{}.{}", lock, getpid());
    if (std::rename(lock.c_str(), aside.c_str()) != 0) return;
    const auto taken = writer_in(aside);
    if (taken && taken->text() != ended.text()) (void)link(aside.c_str(), lock.c_str());
    unlink(aside.c_str());
}

/// Makes PATH.lock. False if there is one.
bool make_lock(const std::string& path) {
    const std::string lock = lock_file(path);
    const FileNumber file(lock, O_WRONLY | O_CREAT | O_EXCL);
    if (file.number() < 0 && errno == EEXIST) return false;
    const std::string text = Writer::self().text();
    const auto size = static_cast<ssize_t>(text.size());
    if (file.number() >= 0 && write(file.number(), text.data(), text.size()) == size) return true;
    const int error = errno;
    if (file.number() >= 0) unlink(lock.c_str());
    throw RunError(
        fmt::format("{}: cannot be created ({}); check the folder of this file, or give a "
                    "different store with --store",
                    lock, std::strerror(error)));
}

/// Takes the lock on the whole file. False if the file system has no such locks.
bool take_whole(const FileNumber& file, const std::string& path) {
    for (int i = 0;; ++i) {
        const LockAnswer answer = lock_whole(file, LOCK_EX);
        if (answer != LockAnswer::held) return answer == LockAnswer::yes;
        if (i == most_tries)
            throw RunError(path +
                           ": a different sweep is writing to this store; wait until that sweep "
                           "ends, or give a different store with --store");
        std::this_thread::sleep_for(between_tries);
    }
}

/// Whether the flock of this process conflicts with range locks, as over NFS.
bool is_made_of_ranges(const std::string& path) {
    const FileNumber file(path, O_RDONLY);
    return file.number() >= 0 && lock_range(file) == LockAnswer::held;
}

}  // namespace

FileNumber::FileNumber(const std::string& path, int flags)
    : number_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
FileNumber::~FileNumber() {
    if (number_ >= 0) close(number_);
}

WriteLock::WriteLock(const std::string& path) : path_(path), file_(path, O_RDWR | O_CREAT) {
    if (file_.number() < 0) {
        throw RunError(
            fmt::format("{}: cannot be written ({}); check the folder and its permissions, or give "
                        "a different store with --store",
                        path, std::strerror(errno)));
    }
    const bool has_whole = take_whole(file_, path);
    const bool needs_file = !has_whole || is_made_of_ranges(path);
    if (has_whole && needs_file) flock(file_.number(), LOCK_UN);
    for (int i = 0;; ++i) {
        const auto writer = writer_in(lock_file(path));
        if (writer && writer->has_ended()) take_away(lock_file(path), *writer);
        if (needs_file && make_lock(path)) break;
        const auto other = writer_in(lock_file(path));
        if (!other && !needs_file) return;
        if (i == most_tries && other) refuse(path, *other);
        std::this_thread::sleep_for(between_tries);
    }
    owner_ = getpid();
}

WriteLock::~WriteLock() {
    if (owner_ == getpid()) unlink(lock_file(path_).c_str());  // not in a worker
}

bool has_range_locks(const std::string& path) {
    const FileNumber file(path, O_RDONLY);
    return file.number() < 0 || lock_range(file) != LockAnswer::no_locks;
}

bool is_shared_by_hosts(const std::string& path) {
    // statfs(2), linux/magic.h, and the sources of Lustre, BeeGFS and PanFS.
    constexpr std::array<std::uint32_t, 17> kinds{
        0x6969,      // NFS
        0x517b,      // SMB
        0xff534d42,  // CIFS
        0xfe534d42,  // SMB 2
        0x0bd00bd0,  // Lustre
        0x47504653,  // GPFS
        0x00c36400,  // Ceph
        0x19830326,  // BeeGFS
        0xaad7aaea,  // PanFS
        0x01021997,  // 9P
        0x5346414f,  // AFS of OpenAFS
        0x6b414653,  // AFS
        0x73757245,  // Coda
        0x564c,      // NCP
        0x01161970,  // GFS2
        0x7461636f,  // OCFS2
        0x65735546,  // FUSE: sshfs, GlusterFS and others
    };
    struct statfs found = {};
    if (statfs(path.c_str(), &found) != 0) return false;
    const auto kind = static_cast<std::uint32_t>(found.f_type);
    return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

void need_no_writer(const std::string& path) {
    const FileNumber file(path, O_RDONLY);
    if (file.number() >= 0 && lock_whole(file, LOCK_SH) == LockAnswer::held)
        throw RunError(path +
                       ": a sweep is writing to this store; this file system has no locks, so the "
                       "store cannot be read until the sweep ends");
    const auto writer = writer_in(lock_file(path));
    if (writer && !writer->has_ended()) refuse(path, *writer);
}

}  // namespace rovernet
