// SPDX-License-Identifier: MIT
#include "study/store.hpp"
#include "test/cli/process.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <sstream>

namespace sweep_test {
using namespace rovernet;
using namespace rovernet::test;
namespace fs = std::filesystem;

namespace {

/// Robots in random places that talk: a run takes a few milliseconds.
const std::string chatter = R"([scenario]
name = "chatter"
duration = "10 s"
[propagation]
model = "disc"
range = "30 m"
[[robot]]
name = "r"
count = 30
place = { model = "uniform", area = [["0 m", "0 m"], ["100 m", "100 m"]] }
[[traffic]]
from = "r0"
size = "20 B"
every = "200 ms"
[study]
replications = 40
vary."propagation.range" = ["10 m", "15 m", "20 m", "25 m", "30 m"]
)";

struct Place {
    explicit Place(const std::string& text = chatter) : file(folder.write("s.toml", text)) {}
    std::string store() const { return folder.path("s.db"); }
    std::string csv() const {
        const Ended ended = command(folder, {"results", store(), "--csv"});
        REQUIRE(ended.exit == 0);
        return ended.out;
    }
    TemporaryFolder folder;
    std::string file;
};

/// Finished runs by id, with what only one making of them has.
std::map<std::string, std::string> finished(const std::string& store) {
    std::map<std::string, std::string> runs;
    if (!fs::exists(store) || fs::file_size(store) == 0) return runs;
    try {
        for (const StoredRun& run : Store::open(store).runs()) {
            if (!run.error.empty()) continue;
            const Measurement& m = run.measurement;
            runs[run.id] = fmt::format("{} {} {}", m.started, m.wall_s, m.cpu_s);
        }
    } catch (const std::exception&) {
        // It is only just being made.
    }
    return runs;
}

/// Processes whose parent this is.
std::vector<pid_t> children_of(pid_t parent) {
    std::vector<pid_t> children;
    for (const auto& entry : fs::directory_iterator("/proc")) {
        std::ifstream stat(entry.path() / "stat");
        pid_t pid = 0, above = 0;
        std::string name, state;
        if (stat >> pid >> name >> state >> above && above == parent && state != "Z") {
            children.push_back(pid);
        }
    }
    return children;
}

/// It has, whether or not anybody has waited for it.
bool has_ended(pid_t pid) {
    siginfo_t info{};
    waitid(P_PID, static_cast<id_t>(pid), &info, WEXITED | WNOHANG | WNOWAIT);
    return info.si_pid != 0;
}

void wait_a_moment() { std::this_thread::sleep_for(std::chrono::milliseconds{1}); }

}  // namespace

TEST_CASE(
    "sweep, compare: --set of a key that the study varies has no effect, and a notice says so") {
    const Place place;
    const std::string set = "propagation.range=7 m", seed = "scenario.seed=2";
    const Ended ended = command(
        place.folder, {"sweep", place.file, "--dry-run", "--set", set, "--set", "scenario.seed=2"});
    CHECK(ended.err ==
          "--set propagation.range=7 m has no effect, because [study] varies "
          "propagation.range; to run this value alone, give --set "
          "'study.vary.propagation.range=[\"7 m\"]'\n");
    const Ended alone = command(place.folder, {"sweep", place.file, "--dry-run", "--set",
                                               "study.vary.propagation.range=[\"7 m\"]"});
    CHECK(alone.err.empty());
    CHECK(alone.out.find("0  propagation.range=7 m\n1 points") != std::string::npos);
    const Ended compared =
        command(place.folder, {"compare", place.file, "--vary", "propagation.range=5 m,10 m",
                               "--set", set, "--replications", "5", "--quiet"});
    CHECK(compared.err.empty());
    CHECK(command(place.folder, {"compare", place.file, "--vary", "propagation.range=5 m,10 m",
                                 "--set", set, "--replications", "5"})
              .err.find("--set propagation.range=7 m has no effect") != std::string::npos);
}

TEST_CASE("sweep: a dry run lists every point and runs nothing") {
    const Place place;
    const Ended ended = command(place.folder, {"sweep", place.file, "--dry-run"});
    CHECK(ended.exit == 0);
    CHECK(ended.out.find("2  propagation.range=20 m\n") != std::string::npos);
    CHECK(ended.out.ends_with("5 points x 40 replications = 200 runs\n"));
    CHECK_FALSE(fs::exists(place.store()));
    const Json json = json_of(place.folder, {"sweep", place.file, "--dry-run"});
    CHECK(json["points"].size() == 5);
    CHECK(json["points"][4]["settings"]["propagation.range"] == "30 m");
    CHECK(json["runs"] == 200);
}

TEST_CASE("sweep: if points miss the required precision, they are listed, and the exit code is 4") {
    const Place place;
    const std::vector<std::string> wanted = {"sweep",       place.file, "--replications",     "2",
                                             "--precision", "0.01",     "--max-replications", "4"};
    const Ended ended = command(place.folder, wanted);
    CHECK(ended.exit == 4);
    CHECK(ended.err.find("5 of 5 points did not reach the precision 0.01 for delivery_ratio within "
                         "4 replications:\n  propagation.range=10 m: +- 0.") != std::string::npos);
    CHECK(ended.err.find(" from 4 values\n") != std::string::npos);
    auto as_json = wanted;
    as_json.push_back("--json");
    const Ended again = command(place.folder, as_json);
    CHECK(again.exit == 4);
    const Json json = Json::parse(again.out);
    REQUIRE(json["imprecise"].size() == 5);
    CHECK(json["imprecise"][0]["n"] == 4);
    CHECK(json["imprecise"][0]["half_width"] > 0.01);
    const Ended coarse =
        command(place.folder, {"sweep", place.file, "--replications", "2", "--precision", "0.9"});
    CHECK(coarse.exit == 0);
}

TEST_CASE(
    "results: --interval selects the kind of interval: STaR-Bets, a betting confidence sequence or "
    "Student's t") {
    const Place place;
    json_of(place.folder, {"sweep", place.file, "--replications", "6"});
    const auto first = [&](std::vector<std::string> more) {
        std::vector<std::string> words = {"results", place.store(), "--metric", "delivery_ratio"};
        words.insert(words.end(), more.begin(), more.end());
        return Json(json_of(place.folder, words)["rows"][2]);
    };
    CHECK(first({})["interval"] == "star");
    CHECK(first({"--interval", "betting"})["interval"] == "betting");
    CHECK(first({"--interval", "t"})["interval"] == "t");
    CHECK(first({"--interval", "t"})["high"] < first({})["high"]);
    CHECK(command(place.folder, {"results", place.store(), "--interval", "z"}).exit == 2);
}

TEST_CASE("sweep: `results` and `explain` print a study's runs, and a command that repeats a run") {
    const Place place;
    const Json made = json_of(place.folder, {"sweep", place.file, "--replications", "6"});
    CHECK(made["finished"] == 30);
    const Ended table = command(place.folder, {"results", place.store()});
    CHECK(table.out.starts_with("propagation.range  delivery_ratio"));
    CHECK(table.err.empty());
    const Json json =
        json_of(place.folder, {"results", place.store(), "--metric", "delivery_ratio,events"});
    REQUIRE(json["rows"].size() == 10);
    CHECK(json["rows"][0]["n"] == 6);
    CHECK(json["rows"][0]["low"] <= json["rows"][0]["value"]);

    // What explain prints, run gives again.
    const Json run = json_of(place.folder, {"explain", place.store(), "3/2"});
    std::istringstream words(run["command"].get<std::string>());
    std::vector<std::string> arguments;
    words.ignore(64, ' ');
    for (std::string word; words >> word;) arguments.push_back(word);
    for (auto& word : arguments) std::erase(word, '\'');
    std::string& value = *std::find_if(arguments.begin(), arguments.end(), [](const auto& word) {
        return word.starts_with("propagation.range=");
    });
    value += " m\"";  // the blank in it has divided the word
    arguments.erase(std::find(arguments.begin(), arguments.end(), "m\""));
    arguments.insert(arguments.end(), {"--out", place.folder.path("run")});
    const Json again = json_of(place.folder, arguments);
    CHECK(again["fingerprint"] == run["fingerprint"]);
    CHECK(again["delivery_ratio"] == run["metrics"]["delivery_ratio"]);
}

TEST_CASE(
    "sweep: after a sweep with fewer than 5 replications, the command `results` prints a warning") {
    const Place place;
    command(place.folder, {"sweep", place.file, "--replications", "2"});
    CHECK(command(place.folder, {"results", place.store()}).err.find("fewer than 5 replications") !=
          std::string::npos);
}

TEST_CASE("sweep: Ctrl-C keeps finished runs and prints the command that continues the sweep") {
    const Place place;
    const Process sweep(place.folder, {"sweep", place.file, "--workers", "2"});
    while (finished(place.store()).size() < 3) wait_a_moment();
    sweep.interrupt();
    const Ended ended = sweep.wait();
    CHECK(ended.exit == 130);
    CHECK(ended.err.find("continue with\n  rovernet sweep " + place.file) != std::string::npos);
    const auto kept = finished(place.store());
    CHECK(kept.size() >= 3);
    CHECK(kept.size() < 200);
    CHECK(command(place.folder, {"sweep", place.file}).exit == 0);
    const auto all = finished(place.store());
    CHECK(all.size() == 200);
    for (const auto& [id, making] : kept) CHECK(all.at(id) == making);
}

TEST_CASE("sweep: a second Ctrl-C ends the sweep without waiting for its runs") {
    const Place place(chatter + "[links]\n");
    const Process sweep(place.folder,
                        {"sweep", place.file, "--set", "scenario.duration=1e8", "--set",
                         "scenario.event_limit=1000000000000", "--workers", "1"});
    while (children_of(sweep.pid()).empty()) wait_a_moment();
    sweep.interrupt();
    std::this_thread::sleep_for(std::chrono::milliseconds{500});
    CHECK(children_of(sweep.pid()).size() == 1);  // it is finishing
    CHECK(sweep.stop().exit == 130);
}

TEST_CASE(
    "sweep: if a sweep is killed 50 times, no finished run is lost or repeated, and the results do "
    "not change") {
    const std::vector<std::string> slow = {"--set", "scenario.duration=30"};
    const auto sweep_of = [&](const Place& p) {
        return std::vector<std::string>{"sweep", p.file, slow[0], slow[1]};
    };
    const Place undisturbed;
    REQUIRE(command(undisturbed.folder, sweep_of(undisturbed)).exit == 0);

    const Place place;
    std::mt19937 random(1);
    std::optional<Process> sweep;
    std::map<std::string, std::string> kept;
    int kills = 0, landed = 0;
    while (kills < 50) {
        if (!sweep || has_ended(sweep->pid())) sweep.emplace(place.folder, sweep_of(place));
        const auto enough = std::clamp<std::size_t>(kept.size() + random() % 3, 1, 200);
        while (finished(place.store()).size() < enough && !has_ended(sweep->pid())) wait_a_moment();
        std::vector<pid_t> workers;
        if (random() % 3 == 0) workers = children_of(sweep->pid());
        kill(workers.empty() ? sweep->pid() : workers[random() % workers.size()], SIGKILL);
        if (workers.empty()) sweep.reset();
        ++kills;
        const auto now = finished(place.store());
        if (!now.empty() && now.size() < 200) ++landed;
        for (const auto& [id, making] : kept) REQUIRE(now.at(id) == making);
        kept = now;
    }
    CHECK(landed >= 45);
    if (sweep) sweep->wait();
    const Ended last = command(place.folder, sweep_of(place));
    CAPTURE(last.err);
    CHECK(last.exit == 0);
    const auto all = finished(place.store());
    CHECK(all.size() == 200);
    for (const auto& [id, making] : kept) CHECK(all.at(id) == making);
    CHECK(place.csv() == undisturbed.csv());
}

TEST_CASE("sweep: a run whose worker process is killed is repeated once") {
    const Place place;
    const Process sweep(place.folder, {"sweep", place.file, "--workers", "1", "--set",
                                       "scenario.duration=300", "--replications", "3"});
    while (children_of(sweep.pid()).empty()) wait_a_moment();
    kill(children_of(sweep.pid()).front(), SIGKILL);
    const Ended ended = sweep.wait();
    CAPTURE(ended.err);
    CHECK(ended.exit == 0);
    CHECK(finished(place.store()).size() == 15);
}

TEST_CASE("compare: paths around walls are searched only once, with any number of workers") {
    const TemporaryFolder folder;
    std::string wall = "P1 20 20\n";
    for (int row = 0; row < 20; ++row)
        for (int column = 0; column < 20; ++column) wall += column == 10 && row > 1 ? "1 " : "0 ";
    folder.write("wall.pbm", wall);
    const std::string file = folder.write("s.toml", R"([scenario]
duration = "60 s"
[scene]
map = "wall.pbm"
size = ["20 m", "20 m"]
[[robot]]
name = "r"
count = 4
radius = "0.2 m"
place = { model = "uniform", area = [["1 m", "1 m"], ["19 m", "19 m"]] }
move = { model = "random_waypoint" }
[[traffic]]
from = "r0"
size = "20 B"
[study]
replications = 5
)");
    std::string once;
    for (const char* workers : {"1", "2", "4"}) {
        const Ended ended =
            command(folder, {"compare", file, "--models", "friis,log_distance,two_ray", "--workers",
                             workers, "--verbose"});
        REQUIRE(ended.exit == 0);
        const auto end = ended.err.find(" searches for paths around walls");
        REQUIRE(end != std::string::npos);
        const auto begin = ended.err.find_last_of("\n ", end - 1) + 1;
        const std::string searches = ended.err.substr(begin, end - begin);
        if (once.empty()) once = searches;
        CHECK(searches == once);
        CHECK(std::stoi(searches) > 10);
    }
}

TEST_CASE("sweep: while a sweep writes to a store, a second sweep on this store is refused") {
    const Place place;
    const Process first(place.folder, {"sweep", place.file, "--set", "scenario.duration=1e8",
                                       "--set", "scenario.event_limit=1000000000000"});
    while (children_of(first.pid()).empty()) wait_a_moment();
    const TemporaryFolder other;
    const Ended second = command(other, {"sweep", place.file});
    CHECK(second.exit == 1);
    CHECK(second.err.find("a different sweep is writing") != std::string::npos);
    CHECK(first.stop().exit == 130);
}

TEST_CASE(
    "sweep: a full disk ends the sweep and keeps finished runs; once there is space, the sweep "
    "continues") {
    const Place place;
    const std::string limited =
        fmt::format("trap '' XFSZ; ulimit -f 200; exec {} sweep {}", ROVERNET_COMMAND, place.file);
    const Ended full = Process(place.folder, {"-c", limited}, "/bin/bash").wait();
    CHECK(full.exit == 1);
    CHECK(full.err.find("finished runs are kept") != std::string::npos);
    const auto kept = finished(place.store());
    CHECK(kept.size() > 0);
    CHECK(kept.size() < 200);
    CHECK(command(place.folder, {"sweep", place.file}).exit == 0);
    const auto all = finished(place.store());
    CHECK(all.size() == 200);
    for (const auto& [id, making] : kept) CHECK(all.at(id) == making);
}

TEST_CASE("sweep: if the store cannot be written, the sweep fails before its first run") {
    const Place place;
    const Ended ended = command(place.folder, {"sweep", place.file, "--store", "/proc/s.db"});
    CHECK(ended.exit == 1);
    CHECK(ended.err.find("/proc/s.db: cannot be written") != std::string::npos);
    CHECK(command(place.folder, {"results", place.folder.path("none.db")}).exit == 3);
}

TEST_CASE("sweep: --fresh asks for confirmation, and needs --yes without a terminal") {
    const Place place;
    command(place.folder, {"sweep", place.file, "--replications", "1"});
    const Ended asked = command(place.folder, {"sweep", place.file, "--fresh"});
    CHECK(asked.exit == 2);
    CHECK(asked.err.find("5 runs") != std::string::npos);
    CHECK(finished(place.store()).size() == 5);
    const Json made = json_of(place.folder, {"sweep", place.file, "--fresh", "--yes", "--seed", "9",
                                             "--replications", "2"});
    CHECK(made["finished"] == 10);
    CHECK(made["before"] == 0);
}

TEST_CASE("sweep: failed runs give exit code 4, and are listed with their command") {
    const Place place;
    const Ended ended = command(place.folder, {"sweep", place.file, "--replications", "2", "--set",
                                               "scenario.event_limit=500"});
    CHECK(ended.exit == 4);
    CHECK(ended.err.find("rovernet run ") != std::string::npos);
    const Ended failures = command(place.folder, {"results", place.store(), "--failures"});
    CHECK(failures.out.find("propagation.range=30 m\n") != std::string::npos);
    CHECK(failures.out.find("--replication 1\n") != std::string::npos);
}

TEST_CASE("plot: --y-title sets the title of the y axis for each metric") {
    const Place place;
    command(place.folder, {"sweep", place.file});
    const std::string picture = place.folder.path("p.svg");
    const std::vector<std::string> asked = {
        "plot", place.store(), "-x", "range", "-y", "delivery_ratio,deliveries", "-o", picture};
    const auto drawn = [&](std::vector<std::string> more) {
        more.insert(more.begin(), asked.begin(), asked.end());
        const Ended ended = command(place.folder, more);
        if (ended.exit != 0) return ended.err;
        std::ifstream file(picture);
        return std::string(std::istreambuf_iterator<char>(file), {});
    };
    const std::string own = drawn({"--x-title", "range of a radio [m]", "--y-title",
                                   "delivered, in all", "--y-title", "messages"});
    CHECK(own.find(">range of a radio [m]<") != std::string::npos);
    CHECK(own.find(">delivered, in all<") != std::string::npos);
    CHECK(own.find(">messages<") != std::string::npos);
    CHECK(own.find(">delivery_ratio") == std::string::npos);
    CHECK(drawn({}).find(">delivery_ratio") != std::string::npos);
    CHECK(drawn({"--y-title", "a"})
              .find("given 1 title for 2 metrics; expected one title for each") !=
          std::string::npos);
}

TEST_CASE("results: an unfinished study is marked, and each row has its number of missing runs") {
    const Place place;
    const std::string plan = "study.replications=3";
    command(place.folder, {"sweep", place.file, "--set", plan, "--shard", "0", "--chunk", "12"});
    const Ended table = command(place.folder, {"results", place.store()});
    CHECK(table.out.find("missing") != std::string::npos);
    CHECK(table.out.find("unfinished: 3 runs are missing\n") != std::string::npos);
    const std::string said = "unfinished: 3 of 15 runs are missing";
    CHECK(table.err.find(said) != std::string::npos);
    CHECK(command(place.folder, {"results", place.store(), "--csv"}).err.find(said) !=
          std::string::npos);
    CHECK(command(place.folder, {"explain", place.store(), "0/0"}).err.find(said) !=
          std::string::npos);
    const std::string picture = place.folder.path("p.gp");
    command(place.folder,
            {"plot", place.store(), "-x", "range", "-y", "delivery_ratio", "-o", picture});
    std::ifstream file(picture);
    CHECK(std::string(std::istreambuf_iterator<char>(file), {}).find("unfinished: ") !=
          std::string::npos);
    const Json json = json_of(place.folder, {"results", place.store()});
    CHECK(json["missing"] == 3);
    CHECK(json["rows"][0]["missing"] == 0);
    CHECK(json["rows"].back()["missing"] == 1);
}

TEST_CASE("results: options that exclude each other are refused") {
    const Place place;
    command(place.folder, {"sweep", place.file, "--replications", "1"});
    for (const char* other : {"--quantile=0.5", "--confidence=0.9", "--json", "--failures"}) {
        CAPTURE(other);
        CHECK(command(place.folder, {"results", place.store(), "--csv", other}).exit == 2);
    }
    CHECK(command(place.folder, {"results", place.store(), "--provenance"}).exit == 2);
    const Ended csv = command(place.folder, {"results", place.store(), "--csv", "--metric", "reach",
                                             "--where", "range=20 m"});
    CHECK(std::count(csv.out.begin(), csv.out.end(), '\n') == 2);
}

TEST_CASE(
    "compare: keys that are not compared keep the scenario's value; invalid names are refused") {
    const Place place(chatter + "vary.routing.ttl = [1, 2]\n");
    const std::vector<std::string> models = {"compare", place.file, "--replications", "5"};
    const auto with = [&](std::vector<std::string> more) {
        std::vector<std::string> words = models;
        words.insert(words.end(), more.begin(), more.end());
        return command(place.folder, words);
    };
    const Ended made = with({"--models", "disc,friis"});
    CHECK(made.exit == 0);
    CHECK(made.out.find("kept at the values of the scenario file: propagation.range = 30 m, "
                        "routing.ttl = ") != std::string::npos);
    const Ended twice = with({"--models", "disc,disc"});
    CHECK(twice.exit == 2);
    CHECK(twice.err.find("propagation.model=disc is listed twice") != std::string::npos);
    CHECK(
        with({"--models", "disc,friis", "--metric", "reech"}).err.find("did you mean \"reach\"?") !=
        std::string::npos);
    CHECK(with({"--models", "disc,friis", "--baseline", "two_ray"})
              .err.find("expected one of disc, friis") != std::string::npos);
}

TEST_CASE("compare: the values of any key are compared in pairs, with the first as the baseline") {
    const Place place;
    const auto with = [&](const std::string& vary, std::vector<std::string> more) {
        std::vector<std::string> words = {"compare", place.file, "--replications",
                                          "6",       "--vary",   vary};
        words.insert(words.end(), more.begin(), more.end());
        return command(place.folder, words);
    };
    const Ended made = with("routing.ttl=1,3", {});
    CHECK(made.exit == 0);
    CHECK(made.out.find("minus ttl=1") != std::string::npos);
    CHECK(made.out.find("ttl=3") != std::string::npos);
    CHECK(made.out.find("by STaR-Bets") != std::string::npos);
    CHECK(with("propagation.range=[\"10 m\", \"30 m\"]", {"--baseline", "30 m"})
              .out.find("minus range=30 m") != std::string::npos);
    CHECK(with("routing.ttl=1,3", {"--interval", "t"}).out.find("by Student's t") !=
          std::string::npos);
    CHECK(with("routing.ttl=4", {}).err.find("at least two values") != std::string::npos);
    CHECK(with("routing.tttl=1,2", {}).err.find("did you mean") != std::string::npos);
    CHECK(with("routing.ttl=1,2", {"--models", "disc,friis"}).exit == 2);
}

TEST_CASE("compare: runs in the store of a sweep are used, and new runs are added to the store") {
    const Place place;
    CHECK(command(place.folder, {"sweep", place.file, "--replications", "3"}).exit == 0);
    const auto before = finished(place.store());
    CHECK(before.size() == 15);
    const auto compare = [&](const std::string& replications) {
        return command(place.folder,
                       {"compare", place.file, "--vary", "propagation.range=10 m,30 m",
                        "--replications", replications, "--store", place.store()});
    };
    CHECK(compare("3").exit == 0);
    CHECK(finished(place.store()) == before);  // nothing is made anew
    CHECK(compare("5").exit == 0);
    CHECK(finished(place.store()).size() == before.size() + 4);
    CHECK(command(place.folder, {"sweep", place.file, "--replications", "5"}).exit == 0);
    CHECK(finished(place.store()).size() == 25);
}

TEST_CASE("compare: if a store lacks runs of some compared values, only these runs are added") {
    const Place place;
    CHECK(command(place.folder, {"sweep", place.file, "--replications", "3"}).exit == 0);
    const std::size_t before = finished(place.store()).size();
    const auto compare = [&](const std::string& ranges) {
        return command(place.folder,
                       {"compare", place.file, "--vary", "propagation.range=" + ranges,
                        "--replications", "3", "--store", place.store()});
    };
    const Ended mixed = compare("10 m,60 m");
    CAPTURE(mixed.err);
    CHECK(mixed.exit == 0);
    CHECK(finished(place.store()).size() == before + 3);
    CHECK(compare("60 m,30 m").exit == 0);
    CHECK(finished(place.store()).size() == before + 3);
    const Json all = json_of(place.folder, {"results", place.store()});
    CHECK(all["missing"] == 0);
    CHECK(all["runs"] == before + 3);
    // A key that the store does not vary, and whose value in it is the file's.
    const Ended other = command(
        place.folder, {"compare", place.file, "--vary", "routing.ttl=3,1", "--set",
                       "propagation.range=10 m", "--replications", "3", "--store", place.store()});
    CAPTURE(other.err);
    CHECK(other.exit == 0);
    const Json joined = json_of(place.folder, {"results", place.store(), "--group-by", "ttl,range",
                                               "--metric", "delivery_ratio"});
    CHECK(joined["rows"].size() == 7);
}

TEST_CASE(
    "compare: if a store has more replications than requested, only the requested ones are used") {
    const Place place;
    CHECK(command(place.folder, {"sweep", place.file, "--replications", "6"}).exit == 0);
    const auto with = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words = {"compare", place.file,
                                          "--vary",  "propagation.range=10 m,15 m,20 m,25 m,30 m",
                                          "--store", place.store()};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    };
    const Json four = json_of(place.folder, with({"--replications", "4"}));
    for (const Json& row : four["rows"]) CHECK(row["n"] == 4);
    CHECK(command(place.folder, with({"--replications", "4"}))
              .err.find("has up to 6 replications; the first 4 are compared, as requested "
                        "(--replications 6 compares all)") != std::string::npos);
    const Ended all = command(place.folder, with({"--replications", "6"}));
    CHECK(all.err.find("are compared, as requested") == std::string::npos);
    CHECK(finished(place.store()).size() == 30);
}

TEST_CASE(
    "compare: the first value is the baseline; options set the confidence and the method of the "
    "intervals") {
    const Place place;
    const auto with = [&](const std::string& vary, std::vector<std::string> more) {
        std::vector<std::string> words = {"compare", place.file, "--replications",
                                          "8",       "--vary",   vary};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    };
    const std::string ttl = "routing.ttl=1,3";
    const auto notices = [&](const std::vector<std::string>& more) {
        return command(place.folder, with(ttl, more)).err;
    };
    const char* other = "are computed by Student's t, not by STaR-Bets as requested";
    CHECK(notices({"--interval", "star", "--metric", "transmissions"}).find(other) !=
          std::string::npos);
    CHECK(notices({"--interval", "star"}).find(other) == std::string::npos);
    CHECK(notices({"--metric", "transmissions"}).find(other) == std::string::npos);
    // The first value is the baseline, of models, too.
    CHECK(json_of(place.folder, with("propagation.model=friis,disc", {}))["baseline"] == "friis");
    CHECK(json_of(place.folder, with("propagation.model=disc,friis", {}))["baseline"] == "disc");
    const Json sure = json_of(place.folder, with(ttl, {"--confidence", "0.99"}));
    const Json usual = json_of(place.folder, with(ttl, {}));
    CHECK(sure["confidence"] == 0.99);
    CHECK(sure["rows"][0]["low"] < usual["rows"][0]["low"]);
}

TEST_CASE(
    "compare: the ending of the file name selects the kind of picture; unknown endings are "
    "refused") {
    const Place place;
    const auto with = [&](const std::string& out) {
        return command(place.folder, {"compare", place.file, "--models", "disc,friis",
                                      "--replications", "2", "-o", place.folder.path(out)});
    };
    CHECK(with("c.svg").exit == 0);
    CHECK(content(place.folder.path("c.svg")).starts_with("<?xml"));
    const Ended refused = with("c.gif");
    CHECK(refused.exit == 2);
    CHECK(refused.out.empty());
    CHECK(refused.err.find("ends in .svg, .png or .pdf") != std::string::npos);
    CHECK_FALSE(fs::exists(place.folder.path("c.gif")));
    if (std::system("rsvg-convert --version > /dev/null 2>&1") != 0) return;
    CHECK(with("c.png").exit == 0);
    CHECK(content(place.folder.path("c.png")).starts_with("\x89PNG"));
    CHECK(with("c.pdf").exit == 0);
    CHECK(content(place.folder.path("c.pdf")).starts_with("%PDF"));
}

TEST_CASE("compare: if runs fail, the finished runs are compared, and the exit code is 4") {
    const Place place;
    const Ended ended =
        command(place.folder, {"compare", place.file, "--models", "disc,friis", "--replications",
                               "6", "--set", "scenario.event_limit=3000"});
    CAPTURE(ended.out);
    CAPTURE(ended.err);
    CHECK(ended.exit == 4);
    CHECK(ended.out.find("cannot be compared in some replications, because one of the two has no "
                         "value: 6 failed") != std::string::npos);
    CHECK(ended.err.find("compare.db") == std::string::npos);  // it is gone
}

}  // namespace sweep_test
