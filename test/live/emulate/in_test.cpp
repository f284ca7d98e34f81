// SPDX-License-Identifier: MIT
// The command `in`: whose runs it enters, and that its programs end with the run.
#include "live/emulate/descriptor_socket.hpp"
#include "live/emulate/robot_listener.hpp"
#include "test/live/emulate/tap_run.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <functional>
#include <set>
#include <string>
#include <sys/socket.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace in_test {
using namespace rovernet;
using namespace rovernet::test;
using namespace std::chrono_literals;

namespace {

constexpr uid_t stranger = 65'534;  // nobody

/// Process of another user, for tests that root runs.
class Stranger {
  public:
    explicit Stranger(const std::function<int()>& does) : process_(fork()) {
        if (process_ != 0) return;
        const bool is_other = setgid(stranger) == 0 && setuid(stranger) == 0;
        _exit(is_other ? does() : 99);
    }
    ~Stranger() { end(); }
    Stranger(const Stranger&) = delete;
    Stranger& operator=(const Stranger&) = delete;

    pid_t pid() const { return process_; }
    int exit_code() {
        int status = 0;
        waitpid(process_, &status, 0);
        process_ = 0;
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

  private:
    void end() {
        if (process_ <= 0) return;
        kill(process_, SIGKILL);
        waitpid(process_, nullptr, 0);
    }

    pid_t process_;
};

bool is_root() {
    if (geteuid() == 0) return true;
    MESSAGE("skipped: only root can be two users");
    return false;
}

/// Opens a listener like a run, and passes the network of this process to every client.
int hand_out_own_network(const std::string& robot) {
    const int listener = open_listener(getpid(), robot);
    const int space = open("/proc/self/ns/net", O_RDONLY | O_CLOEXEC);
    for (int client = 0; (client = accept(listener, nullptr, nullptr)) >= 0;) {
        send_descriptor(client, {.descriptor = space, .text = "/"});
    }
    return 0;
}

/// Whether a process is there that has not ended.
bool goes_on(pid_t process) {
    const std::string stat = content("/proc/" + std::to_string(process) + "/stat");
    const std::size_t name_end = stat.rfind(')');
    return name_end != stat.npos && stat[name_end + 2] != 'Z';
}

/// Numbers that a program has written, once there are so many.
std::vector<pid_t> numbers(const TemporaryFolder& folder, std::size_t many) {
    std::vector<pid_t> found;
    for (int i = 0; i < 4000 && found.size() < many; ++i, std::this_thread::sleep_for(5ms)) {
        found.clear();
        std::ifstream out(folder.path("stdout"));
        for (pid_t number = 0; out >> number;) found.push_back(number);
    }
    REQUIRE(found.size() == many);
    return found;
}

/// Keeper of a run: its only child.
pid_t keeper_of(pid_t run) {
    const std::string of_run = std::to_string(run);
    return std::stoi(content("/proc/" + of_run + "/task/" + of_run + "/children"));
}

bool all_end(const std::vector<pid_t>& processes) {
    for (int i = 0; i < 2000; ++i, std::this_thread::sleep_for(5ms)) {
        bool any = false;
        for (const pid_t each : processes) any = any || goes_on(each);
        if (!any) return true;
    }
    return false;
}

/// A shell that does not end by itself nor by SIGTERM; children of it in its session and in one of
/// their own, and one in another network.
const std::vector<std::string> stubborn = {"sh", "-c",
                                           "trap '' TERM; echo $$; sleep 999 & echo $!; "
                                           "setsid sleep 999 & echo $!; "
                                           "unshare -rn sleep 999 & echo $!; "
                                           "while true; do sleep 1; done"};

}  // namespace

TEST_CASE("`rovernet in`: root enters the network of another user's run only with --user") {
    if (!is_root()) return;
    const std::string robot = "Q" + std::to_string(getpid());
    const Stranger squatter([&] { return hand_out_own_network(robot); });
    const TemporaryFolder folder;
    const auto try_in = [&](std::vector<std::string> words) {
        words.insert(words.begin(), "in");
        words.insert(words.end(), {robot, "--", "true"});
        return command(folder, words);
    };
    Ended ended{};
    for (int i = 0; i < 1000; ++i, std::this_thread::sleep_for(5ms)) {
        ended = try_in({});
        if (ended.err.find("65534") != std::string::npos) break;
    }
    CHECK(ended.exit == 2);
    CHECK(ended.err.find("has a robot " + robot + ": with --user 65534 you enter") !=
          std::string::npos);
    const std::string run = std::to_string(squatter.pid());
    CHECK(try_in({"--run", run}).exit == 2);
    CHECK(try_in({"--run", "/"}).exit == 2);
    CHECK(try_in({"--user", "65534"}).exit == 0);  // so nothing else has kept it out
    CHECK(try_in({"--user", "65534", "--run", run}).exit == 0);
    CHECK(try_in({"--user", "no such user"}).exit == 2);
}

TEST_CASE("`rovernet in`: a user cannot enter another user's run, with or without --user") {
    if (!is_root()) return;
    const std::string robot = "Q" + std::to_string(getpid());
    const int listener = open_listener(getpid(), robot);
    Stranger caller([&] {
        const TemporaryFolder folder;
        const auto exit_of = [&](std::vector<std::string> words) {
            words.insert(words.begin(), "in");
            words.insert(words.end(), {robot, "--", "true"});
            return command(folder, words).exit;
        };
        return exit_of({}) == 2 && exit_of({"--user", "0"}) == 2 ? 0 : 1;
    });
    CHECK(caller.exit_code() == 0);
    close(listener);
}

TEST_CASE("emulate: only the user who started a run gets the network namespaces of its robots") {
    const auto run = is_root() ? emulated_by_tap() : nullptr;
    if (!run) return;
    const auto gets_it = [&] {
        for (const RobotListener& each : all_listeners()) {
            if (each.run != run->pid() || each.robot != "A") continue;
            const auto socket = each.connect_to();
            if (!socket) return 2;
            fcntl(*socket, F_SETFL, 0);
            const auto message = receive_descriptor(*socket);
            return message && message->descriptor >= 0 ? 1 : 0;
        }
        return 3;
    };
    Stranger caller(gets_it);
    CHECK(caller.exit_code() == 0);
    CHECK(gets_it() == 1);
}

TEST_CASE(
    "robot listener: a second listener for the same robot gets another name, and both listeners "
    "are found") {
    const std::string robot = "R/.." + std::to_string(getpid());
    const int first = open_listener(getpid(), robot), second = open_listener(getpid(), robot);
    std::set<std::string> marks;
    for (const RobotListener& each : all_listeners()) {
        if (each.robot != robot) continue;
        CHECK(each.run == getpid());
        CHECK(marks.insert(each.mark).second);
        const auto in = each.connect_to();
        REQUIRE(in);
        CHECK(user_behind(*in) == geteuid());
        close(*in);
    }
    CHECK(marks.size() == 2);
    CHECK(marks.contains(""));
    close(first);
    close(second);
    CHECK_FALSE(RobotListener{getpid(), "", robot}.connect_to());
}

TEST_CASE(
    "`rovernet in`: if several runs have the robot, --run with a folder or a process is needed") {
    const auto one = emulated_by_tap();
    const auto other = one ? emulated_by_tap() : nullptr;
    if (!other) return;
    const TemporaryFolder folder;
    const auto try_in = [&](const std::vector<std::string>& run, const std::string& robot) {
        std::vector<std::string> words{"in"};
        words.insert(words.end(), run.begin(), run.end());
        words.insert(words.end(), {robot, "--", "readlink", "/proc/self/ns/net"});
        return command(folder, words);
    };
    const Ended unclear = try_in({}, "A");
    CHECK(unclear.exit == 2);
    CHECK(unclear.err.find("several runs have a robot A; expected one of the options --run ") !=
          std::string::npos);
    std::set<std::string> networks;
    for (const auto* each : {one.get(), other.get()}) {
        const std::string out = each->folder.path("out"), pid = std::to_string(each->pid());
        CHECK(unclear.err.find(pid + " (" + out + ")") != std::string::npos);
        const Ended by_folder = try_in({"--run", out}, "A");
        CHECK(by_folder.exit == 0);
        CHECK(by_folder.out == try_in({"--run", out + "/../out/"}, "A").out);
        CHECK(by_folder.out == try_in({"--run", pid}, "A").out);
        networks.insert(by_folder.out);
        CHECK(try_in({"--run", out}, "X").err.find("there is no robot \"X\"; the robots are ") !=
              std::string::npos);
    }
    CHECK(networks.size() == 2);
    const std::string out = one->folder.path("out");
    CHECK(try_in({"--run", one->folder.path("")}, "A").err.find("you have no running emulation") !=
          std::string::npos);
    one->stop();
    const Ended stale = try_in({"--run", out}, "A");
    CHECK(stale.exit == 2);
    CHECK(stale.err.find("--run " + out + ": this run has ended") != std::string::npos);
    CHECK(stale.err.find(other->folder.path("out")) != std::string::npos);
    const Ended nowhere = try_in({"--run", "no/such/folder"}, "A");
    CHECK(nowhere.exit == 2);
    CHECK(nowhere.err.find("there is no such folder") != std::string::npos);
    for (const char* bad : {"0", "-1", "99999999", "99999999999999999999", ""}) {
        CAPTURE(bad);
        CHECK(try_in({"--run", bad}, "A").exit == 2);
    }
}

TEST_CASE(
    "`rovernet in`: when the run ends, programs started in its robots end too, with a message") {
    for (const std::string how : {"interrupted", "killed", "killed with its keeper"}) {
        CAPTURE(how);
        const auto run = emulated_by_tap();
        if (!run) return;
        const TemporaryFolder folder, left_behind;
        const Process program = in(folder, *run, "A", stubborn);
        std::vector<pid_t> all = numbers(folder, 4);
        CHECK(in(left_behind, *run, "B", {"sh", "-c", "setsid sleep 999 & echo $!"}).wait().exit ==
              0);
        if (how != "killed with its keeper") all.push_back(numbers(left_behind, 1)[0]);
        for (const pid_t each : all) CHECK(goes_on(each));
        if (how == "killed with its keeper") kill(keeper_of(run->pid()), SIGSTOP);
        if (how == "killed with its keeper") kill(keeper_of(run->pid()), SIGKILL);
        how == "interrupted" ? static_cast<void>(run->stop()) : run->end_by_force();
        const Ended ended = program.wait();
        CHECK(ended.exit == 1);
        CHECK(ended.err.find("the run in " + run->folder.path("out") +
                             " has ended, so sh was stopped") != std::string::npos);
        CHECK(all_end(all));
        if (how == "killed with its keeper") kill(numbers(left_behind, 1)[0], SIGKILL);
    }
}

TEST_CASE("`rovernet in`: when the run ends, a program started in a robot has time to clean up") {
    const auto run = emulated_by_tap();
    if (!run) return;
    const TemporaryFolder folder;
    const Process program = in(folder, *run, "A",
                               {"sh", "-c",
                                "trap 'sleep 0.3; echo 2; exit 0' TERM; echo 1; "
                                "while true; do sleep 0.1; done"});
    numbers(folder, 1);
    run->stop();
    const Ended ended = program.wait();
    CHECK(ended.out == "1\n2\n");
    CHECK(ended.exit == 1);
}

TEST_CASE(
    "`rovernet in`: the exit code is that of the program, and signals are passed to the program") {
    const auto run = emulated_by_tap();
    if (!run) return;
    const TemporaryFolder folder;
    CHECK(in(folder, *run, "A", {"sh", "-c", "exit 7"}).wait().exit == 7);
    CHECK(in(folder, *run, "A", {"sh", "-c", "kill -TERM $$"}).wait().exit == -1);
    CHECK(in(folder, *run, "A", {"sh", "-c", "kill -KILL $$"}).wait().exit == -1);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1}) {
        CAPTURE(signal);
        const Process program = in(folder, *run, "A",
                                   {"sh", "-c",
                                    "trap 'exit 9' INT TERM HUP USR1; echo $$; "
                                    "while true; do sleep 0.01; done"});
        numbers(folder, 1);
        kill(program.pid(), signal);
        CHECK(program.wait().exit == 9);
    }
    const Process program = in(folder, *run, "A", {"sh", "-c", "echo $$; exec sleep 999"});
    const std::vector<pid_t> sleeping = numbers(folder, 1);
    kill(program.pid(), SIGKILL);  // nobody is left who would end it with the run
    CHECK(all_end(sleeping));
}

}  // namespace in_test
