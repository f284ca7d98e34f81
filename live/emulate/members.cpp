// SPDX-License-Identifier: MIT
#include "live/emulate/members.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <dirent.h>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

namespace rovernet {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

/// Visits all processes of this machine.
void for_each_process(const std::function<void(pid_t, const std::string& folder)>& visit) {
    const std::unique_ptr<DIR, int (*)(DIR*)> proc(opendir("/proc"), closedir);
    if (!proc) return;
    while (const dirent* const entry = readdir(proc.get())) {
        const std::string_view name = entry->d_name;
        pid_t process = 0;
        const char* const end = name.data() + name.size();
        const auto [rest, error] = std::from_chars(name.data(), end, process);
        if (error == std::errc{} && rest == end) visit(process, "/proc/" + std::string(name));
    }
}

/// Process that has started the one of a folder of /proc; 0 if that has ended.
pid_t parent_of(const std::string& folder) {
    std::ifstream file(folder + "/stat");
    std::string text;
    std::getline(file, text, '\0');
    const std::size_t name_end = text.rfind(')');  // a name may have anything in it
    if (name_end == text.npos || name_end + 4 >= text.size()) return 0;
    const bool has_ended = text[name_end + 2] == 'Z';
    pid_t parent = 0;
    std::from_chars(text.data() + name_end + 4, text.data() + text.size(), parent);
    return has_ended ? 0 : parent;
}

}  // namespace

void NamespaceSet::add(int descriptor) {
    struct stat found {};
    if (fstat(descriptor, &found) == 0) numbers_.emplace(found.st_dev, found.st_ino);
}

std::vector<pid_t> NamespaceSet::members() const {
    std::vector<pid_t> members;
    for_each_process([&](pid_t process, const std::string& folder) {
        struct stat found {};
        const bool is_known = stat((folder + "/ns/net").c_str(), &found) == 0;
        if (is_known && process != getpid() && numbers_.contains({found.st_dev, found.st_ino})) {
            members.push_back(process);
        }
    });
    return members;
}

std::vector<pid_t> descendants() {
    std::vector<std::pair<pid_t, pid_t>> all;  // process, parent
    for_each_process([&](pid_t process, const std::string& folder) {
        all.emplace_back(process, parent_of(folder));
    });
    std::vector<pid_t> found{getpid()};
    for (std::size_t i = 0; i < found.size(); ++i) {
        for (const auto& [process, parent] : all) {
            if (parent == found[i]) found.push_back(process);
        }
    }
    found.erase(found.begin());
    return found;
}

void end_processes(const std::function<std::vector<pid_t>()>& find) {
    constexpr Clock::duration second_word = 1s, last_word = 2s, patience = 3s, look_every = 20ms;
    const auto begun = Clock::now();
    std::set<pid_t> asked, asked_again, foreign;
    const auto tell = [&](pid_t process, int signal) {
        if (kill(process, signal) != 0 && errno == EPERM) foreign.insert(process);
    };
    for (;;) {
        std::vector<pid_t> left = find();
        std::erase_if(left, [&](pid_t each) { return foreign.contains(each); });
        const auto waited = Clock::now() - begun;
        if (left.empty() || waited > patience) return;
        for (const pid_t each : left) {
            if (waited >= last_word) {
                tell(each, SIGKILL);
            } else if (asked.insert(each).second) {
                tell(each, SIGTERM);
                tell(each, SIGCONT);  // one that is stopped ends only then
            } else if (waited >= second_word && asked_again.insert(each).second) {
                tell(each, SIGHUP);
            }
        }
        std::this_thread::sleep_for(look_every);
    }
}

}  // namespace rovernet
