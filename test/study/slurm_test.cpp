// SPDX-License-Identifier: MIT
#include "study/slurm.hpp"

#include "test/cli/process.hpp"

#include <filesystem>
#include <set>

namespace slurm_test {
using namespace rovernet;
using namespace rovernet::test;
namespace fs = std::filesystem;

namespace {

SlurmSweep plain_sweep() {
    return {.command = "/opt/rovernet",
            .directory = "/home/me",
            .file = "/home/me/s.toml",
            .store = "/home/me/s.db",
            .options = {"--set", "radio.power=15 dBm"},
            .chunk = 50,
            .chunks = {0, 1, 2, 5}};
}

/// What a script gives its command as words, by a command that prints them.
std::vector<std::string> words_given(const TemporaryFolder& folder, const std::string& script) {
    const std::string file = folder.write("script.sh", script);
    CHECK(Process(folder, {"-n", file}, "/bin/bash").wait().exit == 0);
    const Ended ended =
        Process(folder, {"-c", "SLURM_ARRAY_TASK_ID=7 exec bash \"$0\"", file}, "/bin/bash").wait();
    CAPTURE(ended.err);
    CHECK(ended.exit == 0);
    std::vector<std::string> words;
    std::string rest = ended.out;
    for (std::size_t end; (end = rest.find('\0')) != std::string::npos; rest.erase(0, end + 1)) {
        words.push_back(rest.substr(0, end));
    }
    return words;
}

}  // namespace

TEST_CASE(
    "slurm: a task has the requested number of runs, or more if there would be more than 1000 "
    "tasks") {
    const auto tasks = [](std::uint64_t runs, std::uint64_t chunk) {
        return runs / chunk + (runs % chunk > 0 ? 1 : 0);
    };
    for (const std::uint64_t wanted : {1U, 2U, 50U}) {
        for (std::uint64_t runs = 0; runs < 60'000; runs += 7) {
            const std::uint64_t chunk = chunk_for_array(runs, wanted);
            CHECK(tasks(runs, chunk) <= 1000);
            CHECK((chunk == wanted || (chunk > wanted && tasks(runs, chunk - 1) > 1000)));
        }
    }
    CHECK(chunk_for_array(50'000, 50) == 50);
    CHECK(chunk_for_array(50'001, 50) == 51);
}

TEST_CASE("slurm: only those chunks of runs that have an unfinished run are submitted") {
    for (unsigned open = 0; open < 1U << 10; ++open) {
        std::vector<RunState> runs;
        for (unsigned i = 0; i < 10; ++i) {
            const RunState state = i % 2 == 0 ? RunState::missing : RunState::failed;
            runs.push_back((open >> i & 1) != 0 ? state : RunState::finished);
        }
        for (std::uint64_t size = 1; size < 12; ++size) {
            std::set<std::uint64_t> expected;
            for (std::uint64_t i = 0; i < runs.size(); ++i) {
                if (runs[i] != RunState::finished) expected.insert(i / size);
            }
            REQUIRE(open_chunks(runs, size) ==
                    std::vector<std::uint64_t>(expected.begin(), expected.end()));
        }
    }
}

TEST_CASE("slurm: the ranges printed for a job array contain exactly the numbers of its tasks") {
    CHECK(array_ranges(std::vector<std::uint64_t>{0, 1, 2, 3, 7, 9, 10}) == "0-3,7,9-10");
    CHECK(array_ranges(std::vector<std::uint64_t>{12}) == "12");
    for (unsigned set = 1; set < 1U << 9; ++set) {
        std::vector<std::uint64_t> numbers;
        for (unsigned i = 0; i < 9; ++i) {
            if ((set >> i & 1) != 0) numbers.push_back(i);
        }
        // Numbers have one digit: what stands between two commas is "a" or "a-b".
        std::vector<std::uint64_t> named;
        std::istringstream text(array_ranges(numbers));
        for (std::string range; std::getline(text, range, ',');) {
            REQUIRE((range.size() == 1 || (range.size() == 3 && range[1] == '-')));
            for (char c = range.front(); c <= range.back(); ++c) {
                named.push_back(static_cast<std::uint64_t>(c - '0'));
            }
        }
        REQUIRE(named == numbers);
    }
}

TEST_CASE("slurm: the scripts of a plain sweep have exactly the expected text") {
    CHECK(plain_sweep().job_script() ==
          "#!/bin/bash\n"
          "cd /home/me || exit\n"
          "exec /opt/rovernet sweep /home/me/s.toml --set 'radio.power=15 dBm' --workers 1 "
          "--shard \"$SLURM_ARRAY_TASK_ID\" --chunk 50 --except /home/me/s.db "
          "--store /home/me/s.db.slurm/shards/\"$SLURM_ARRAY_TASK_ID\".db\n");
    CHECK(plain_sweep().merge_script() ==
          "#!/bin/bash\n"
          "cd /home/me || exit\n"
          "shards=()\n"
          "for chunk in 0 1 2 5; do shards+=(/home/me/s.db.slurm/shards/\"$chunk\".db); done\n"
          "exec /opt/rovernet sweep /home/me/s.toml --set 'radio.power=15 dBm' "
          "--store /home/me/s.db --merge \"${shards[@]}\"\n");
}

TEST_CASE(
    "slurm: the merging job starts after all tasks; the user's options follow those of rovernet") {
    SlurmSweep sweep = plain_sweep();
    using Words = std::vector<std::string>;
    CHECK(sweep.submit_job() == Words{"sbatch", "--parsable", "--job-name=s", "--array=0-2,5",
                                      "--output=/home/me/s.db.slurm/logs/%a.log",
                                      "/home/me/s.db.slurm/job.sh"});
    sweep.workers = 3;
    sweep.sbatch = {"--partition=x", "--job-name=mine"};
    sweep.store = "/100%a/s.db";
    CHECK(sweep.submit_job() == Words{"sbatch", "--parsable", "--job-name=s", "--array=0-2,5%3",
                                      "--output=/100%%a/s.db.slurm/logs/%a.log", "--partition=x",
                                      "--job-name=mine", "/100%a/s.db.slurm/job.sh"});
    CHECK(sweep.submit_merge("12") ==
          Words{"sbatch", "--parsable", "--job-name=s", "--dependency=afterany:12",
                "--output=/100%%a/s.db.slurm/logs/merge.log", "--partition=x", "--job-name=mine",
                "/100%a/s.db.slurm/merge.sh"});
}

TEST_CASE("slurm: the scripts pass all arguments to rovernet unchanged, whatever they contain") {
    for (const std::string name : {"plain", "two words", "it's", "\"a\" $HOME `id`", "\\ %a;#&*"}) {
        CAPTURE(name);
        const TemporaryFolder folder;
        const std::string place = folder.path(name);
        fs::create_directory(place);
        const std::string command =
            folder.write(name + "/command", "#!/bin/bash\nprintf '%s\\0' \"$PWD\" \"$@\"\n");
        fs::permissions(command, fs::perms::owner_all);
        const SlurmSweep sweep{.command = command,
                               .directory = place,
                               .file = place + "/s.toml",
                               .store = place + "/s.db",
                               .options = {"--set", name},
                               .chunk = 5,
                               .chunks = {2, 11}};
        const std::string shards = sweep.folder() + "/shards/";
        using Words = std::vector<std::string>;
        CHECK(words_given(folder, sweep.job_script()) ==
              Words{place, "sweep", sweep.file, "--set", name, "--workers", "1", "--shard", "7",
                    "--chunk", "5", "--except", sweep.store, "--store", shards + "7.db"});
        CHECK(words_given(folder, sweep.merge_script()) ==
              Words{place, "sweep", sweep.file, "--set", name, "--store", sweep.store, "--merge",
                    shards + "2.db", shards + "11.db"});
    }
}

TEST_CASE("slurm: if the folder of a script is missing, the script fails and runs nothing") {
    SlurmSweep sweep = plain_sweep();
    sweep.directory = "/nowhere/at all";
    sweep.command = "/bin/echo";
    const TemporaryFolder folder;
    for (const std::string& script : {sweep.job_script(), sweep.merge_script()}) {
        const Ended ended =
            Process(folder, {folder.write("script.sh", script)}, "/bin/bash").wait();
        CHECK(ended.exit != 0);
        CHECK(ended.out.empty());
    }
}

}  // namespace slurm_test
