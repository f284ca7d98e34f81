// SPDX-License-Identifier: MIT
#include "files/left_behind.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

namespace rovernet {
namespace {

// Registrations, readable by a signal handler at any time.
constexpr std::size_t most_groups = 1024, most_files = 16;
std::array<std::atomic<pid_t>, most_groups> noted_groups;
std::array<std::atomic<const char*>, most_files> noted_files, noted_folders;
std::atomic<pid_t> note_taker;  // process whose notes they are
static_assert(std::atomic<pid_t>::is_always_lock_free);
static_assert(std::atomic<const char*>::is_always_lock_free);

template <class Notes, class Note>
std::size_t put_down(Notes& notes, Note note) {
    note_taker = getpid();
    for (std::size_t i = 0; i < notes.size(); ++i) {
        Note none{};
        if (notes[i].compare_exchange_strong(none, note)) return i;
    }
    return notes.size();
}

template <class Notes>
void strike_out(Notes& notes, std::size_t place) {
    if (place < notes.size()) notes[place] = {};
}

/// Waits for the leader if it has ended. @return whether a process of the group is left
bool is_alive(pid_t leader) {
    while (waitpid(leader, nullptr, WNOHANG) < 0 && errno == EINTR) {
    }
    return kill(-leader, 0) == 0 || errno == EPERM;
}

bool is_any_alive(std::span<const pid_t> leaders) {
    bool is_any = false;  // all are looked at: no zombie is left
    for (const pid_t each : leaders) is_any = is_alive(each) || is_any;
    return is_any;
}

/// Removes a folder with its contents by the program rm, since functions that read a folder are not
/// safe in a signal handler; nor is fork(), which waits for locks.
void remove_whole(const char* path) {
    const pid_t remover = _Fork();
    if (remover == 0) {
        execl("/bin/rm", "rm", "-rf", "--", path, nullptr);
        _exit(1);
    }
    while (remover > 0 && waitpid(remover, nullptr, 0) < 0 && errno == EINTR) {
    }
}

}  // namespace

void end_groups(std::span<const pid_t> leaders) {
    constexpr int pause = 5;  // [ms]
    const int before = errno;
    // A leader that has ended stays a zombie until it is reaped, so that its process id is not
    // reused.
    for (const pid_t each : leaders) kill(-each, SIGTERM);
    for (int waited = 0; waited < before_kill.count() && is_any_alive(leaders); waited += pause) {
        poll(nullptr, 0, pause);
    }
    for (const pid_t each : leaders) {
        if (is_alive(each)) kill(-each, SIGKILL);
        while (waitpid(each, nullptr, 0) < 0 && errno == EINTR) {
        }
    }
    errno = before;
}

NotedGroup::NotedGroup(pid_t leader) : place_(put_down(noted_groups, leader)) {}
NotedGroup::NotedGroup(NotedGroup&& other) noexcept
    : place_(std::exchange(other.place_, most_groups)) {}
NotedGroup::~NotedGroup() { strike_out(noted_groups, place_); }

NotedFile::NotedFile(std::string path)
    : path_(std::move(path)), place_(put_down(noted_files, path_.c_str())) {}
NotedFile::~NotedFile() {
    strike_out(noted_files, place_);
    unlink(path_.c_str());
}

NotedFolder::NotedFolder(std::string path)
    : path_(std::move(path)), place_(put_down(noted_folders, path_.c_str())) {}
NotedFolder::~NotedFolder() { strike_out(noted_folders, place_); }

void clear_away() {
    if (note_taker != getpid()) return;
    for (auto& each : noted_files) {
        if (const char* path = each.exchange(nullptr)) unlink(path);
    }
    for (auto& each : noted_folders) {
        if (const char* path = each.exchange(nullptr)) remove_whole(path);
    }
    std::array<pid_t, most_groups> leaders;
    std::size_t count = 0;
    for (auto& each : noted_groups) {
        if (const pid_t leader = each.exchange(0); leader > 0) leaders[count++] = leader;
    }
    end_groups(std::span(leaders).first(count));
}

}  // namespace rovernet
