// SPDX-License-Identifier: MIT
#include "live/emulate/robot_network.hpp"

#include "live/emulate/descriptor_socket.hpp"
#include "live/emulate/robot_listener.hpp"
#include "network/network.hpp"
#include "sim/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <linux/nsfs.h>
#include <poll.h>
#include <sched.h>
#include <set>
#include <stdexcept>
#include <sys/ioctl.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace rovernet {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

/// Robot listener to which this process is connected.
struct Visit {
    RobotListener listener;
    uid_t owner = 0;
    OwnDescriptor connection;
    std::string folder = {};
    OwnDescriptor space = OwnDescriptor(-1);
};

/// Connects to listeners of any user, and retries those with a full queue for 3 s at most.
std::vector<Visit> visit(std::vector<RobotListener> listeners) {
    constexpr Clock::duration timeout = 3s, look_every = 5ms;
    std::vector<Visit> visits;
    const auto begun = Clock::now();
    for (;;) {
        std::vector<RobotListener> full;
        for (RobotListener& listener : listeners) {
            const auto socket = listener.connect_to();
            if (!socket) continue;
            if (*socket < 0) {
                full.push_back(std::move(listener));
                continue;
            }
            OwnDescriptor connection(*socket);
            const auto owner = user_behind(*socket);
            if (owner) visits.push_back({std::move(listener), *owner, std::move(connection)});
        }
        if (full.empty() || Clock::now() - begun > timeout) return visits;
        listeners = std::move(full);
        std::this_thread::sleep_for(look_every);
    }
}

/// Requests the namespace and the folder of the run. @return whether both were received
bool ask(Visit& visit) {
    const int socket = visit.connection.get();
    fcntl(socket, F_SETFL, fcntl(socket, F_GETFL) & ~O_NONBLOCK);
    const auto message = receive_descriptor(socket);  // waits while the run is made
    if (!message || message->descriptor < 0) return false;
    visit.space = OwnDescriptor(message->descriptor);
    visit.folder = message->text;
    return true;
}

/// Finds the wanted run among the runs of one user.
class Search {
  public:
    Search(const std::string& robot, const WantedRun& wanted)
        : robot_(robot), wanted_(wanted), user_(wanted.user.value_or(geteuid())) {}

    Visit find() {
        std::vector<RobotListener> listeners = all_listeners();
        std::erase_if(listeners, [this](const RobotListener& each) { return !may_be_meant(each); });
        std::vector<Visit> found = visit(listeners);
        for (const Visit& each : found) {
            if (each.owner != user_) others_.insert({each.owner, each.listener.run});
        }
        std::erase_if(found, [this](const Visit& each) { return each.owner != user_; });
        const bool was_there = !found.empty();
        std::erase_if(found, [](Visit& each) { return !ask(each); });
        if (wanted_.folder) {
            std::erase_if(found, [this](const Visit& each) { return !is_wanted(each.folder); });
        }
        if (found.empty()) fail(was_there);
        if (found.size() > 1) fail_of_several(found);
        return std::move(found.front());
    }

  private:
    bool may_be_meant(const RobotListener& listener) const {
        return listener.robot == robot_ && listener.run == wanted_.process.value_or(listener.run);
    }
    bool is_wanted(const std::string& folder) const {
        std::error_code ignored;
        return fs::equivalent(folder, *wanted_.folder, ignored);
    }

    static std::string run_text(const Visit& visit) {
        return fmt::format("--run {} ({})", visit.listener.run, folder_text(visit.folder));
    }
    [[noreturn]] void fail_of_several(const std::vector<Visit>& found) const {
        std::string runs;
        for (const Visit& each : found) runs += (runs.empty() ? "" : " or ") + run_text(each);
        throw std::invalid_argument(fmt::format(
            "several runs have a robot {}; expected one of the options {}", robot_, runs));
    }

    /// Runs of the user, one visit each, and the names of the robots.
    struct Known {
        std::vector<Visit> runs;
        std::set<std::string> names;
    };
    Known known() const {
        std::vector<RobotListener> listeners = all_listeners();
        std::erase_if(listeners, [this](const RobotListener& each) {
            return each.run != wanted_.process.value_or(each.run);
        });
        Known known;
        std::set<pid_t> seen;
        for (Visit& each : visit(listeners)) {
            if (each.owner != user_) continue;
            known.names.insert(each.listener.robot);
            if (seen.insert(each.listener.run).second && ask(each)) {
                known.runs.push_back(std::move(each));
            }
        }
        return known;
    }

    [[noreturn]] void fail(bool was_there) const;
    void fail_of_folder(const Known& all, const std::string& going_on) const;
    std::string other_users() const;

    const std::string& robot_;
    const WantedRun& wanted_;
    uid_t user_;
    std::set<std::pair<uid_t, pid_t>> others_;  // who has such a robot, too
};

/// Hint about runs of other users that have such a robot.
std::string Search::other_users() const {
    if (others_.empty()) return {};
    const auto& [owner, run] = *others_.begin();
    const std::string words =
        fmt::format("; run {} of user {} has a robot {}", run, user_name(owner), robot_);
    if (geteuid() != 0) return words + ": only this user and root may enter the run";
    return fmt::format(
        "{}: with --user {} you enter this run, but then this user can read and change all packets "
        "of the program that you start there",
        words, owner);
}

void Search::fail_of_folder(const Known& all, const std::string& going_on) const {
    const std::string& folder = *wanted_.folder;
    std::error_code ignored;
    const bool is_meant = std::any_of(all.runs.begin(), all.runs.end(),
                                      [this](const Visit& each) { return is_wanted(each.folder); });
    if (is_meant) return;  // it has no such robot
    if (!fs::is_directory(folder, ignored)) {
        throw std::invalid_argument(fmt::format(
            "--run {}: there is no such folder; expected the process id or the folder of a run{}",
            folder, going_on));
    }
    const bool has_ended = fs::exists(fs::path(folder) / "summary.json", ignored);
    throw std::invalid_argument(fmt::format(
        "--run {}: {}{}", folder,
        has_ended ? "this run has ended" : "you have no running emulation with this folder",
        going_on));
}

void Search::fail(bool was_there) const {
    if (was_there && !wanted_.folder) throw RunError("the run of this robot has ended");
    const Known all = known();
    std::string names, runs;
    constexpr std::size_t most_told = 20;
    std::size_t told = 0;
    for (const std::string& each : all.names) {
        if (++told <= most_told) names += (names.empty() ? "" : ", ") + each;
    }
    if (told > most_told) names += fmt::format(" and {} more", told - most_told);
    for (const Visit& each : all.runs) runs += (runs.empty() ? "" : " or ") + run_text(each);
    const std::string going_on = runs.empty() ? "" : "; running now: " + runs;
    if (wanted_.folder) fail_of_folder(all, going_on);
    if (all.names.empty()) {
        const std::string which =
            wanted_.process
                ? fmt::format(
                      "you have no running emulation with the process id {} on this machine",
                      *wanted_.process)
                : "you have no running emulation on this machine; start one with rovernet emulate "
                  "FILE";
        throw std::invalid_argument(which + other_users());
    }
    throw std::invalid_argument(
        fmt::format("there is no robot \"{}\"; the robots are {}{}", robot_, names, other_users()));
}

}  // namespace

OwnDescriptor::~OwnDescriptor() {
    if (value_ >= 0) close(value_);
}

RobotNetwork find_network(const std::string& robot, const WantedRun& wanted) {
    if (wanted.user && *wanted.user != geteuid() && geteuid() != 0) {
        throw std::invalid_argument("--user: only root may enter the runs of a different user");
    }
    Visit found = Search(robot, wanted).find();
    return {robot, found.listener.run, std::move(found.folder), std::move(found.space),
            std::move(found.connection)};
}

void enter_network(const RobotNetwork& network) {
    const int space = network.space.get();
    if (setns(space, CLONE_NEWNET) == 0) return;
    const OwnDescriptor owner(ioctl(space, NS_GET_USERNS));  // in which it was made
    if (owner.get() >= 0 && setns(owner.get(), CLONE_NEWUSER) == 0 &&
        setns(space, CLONE_NEWNET) == 0) {
        return;
    }
    throw RunError(fmt::format("cannot enter the namespace of robot {}: {}", network.robot,
                               std::strerror(errno)));
}

std::string folder_text(const std::string& folder) {
    std::error_code ignored;
    const std::string near =
        fs::path(folder).lexically_proximate(fs::current_path(ignored)).string();
    return near.starts_with("..") ? folder : near;
}

}  // namespace rovernet
