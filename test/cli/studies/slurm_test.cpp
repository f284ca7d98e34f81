// SPDX-License-Identifier: MIT
#include "study/store.hpp"
#include "test/cli/process.hpp"

#include <filesystem>

namespace slurm_test {
using namespace rovernet;
using namespace rovernet::test;
namespace fs = std::filesystem;

namespace {

/// Twelve short runs.
const std::string small = R"([scenario]
name = "small"
duration = "1 s"
[propagation]
model = "disc"
range = "30 m"
[[robot]]
name = "r"
count = 10
place = { model = "uniform", area = [["0 m", "0 m"], ["50 m", "50 m"]] }
[[traffic]]
from = "r0"
size = "20 B"
[study]
replications = 4
vary."propagation.range" = ["10 m", "20 m", "30 m"]
)";

/// Stands for Slurm: runs the tasks of a job at once, but for the one whose number is in the file
/// `lost`; keeps its words, and takes no job whose words have what is in the file `refused`.
const std::string fake_sbatch = R"bash(#!/bin/bash
here=$(dirname "$0")
printf '%s\n' "$@" -- >> "$here/words"
if [[ -e $here/refused && "$*" == *"$(cat "$here/refused")"* ]]; then
    echo "sbatch: error: invalid partition" >&2
    echo 79
    exit 1
fi
tasks=
for word; do
    case $word in --array=*) tasks=${word#--array=} ;; esac
done
script=${*: -1}
if [[ $tasks ]]; then
    for range in $(tr , ' ' <<< "${tasks%\%*}"); do
        for task in $(seq "${range%-*}" "${range#*-}"); do
            if [[ -e $here/lost && $task == "$(cat "$here/lost")" ]]; then continue; fi
            SLURM_ARRAY_TASK_ID=$task bash "$script" > "$here/task" 2>&1
        done
    done
    echo "77;cluster"
else
    bash "$script" > "$here/merge" 2>&1
    echo "exit $?" >> "$here/merge"
    echo 78
fi
)bash";

/// A cluster and a study, in folders with a name that scripts may stumble over.
struct Cluster {
    explicit Cluster(const std::string& text = small) {
        fs::create_directory(place);
        fs::create_directory(folder.path("bin"));
        file = folder.write(name + "/s.toml", text);
        fs::permissions(folder.write("bin/sbatch", fake_sbatch), fs::perms::owner_all);
    }

    /// A sweep, as it is called in the folder of the study by a shell that finds sbatch.
    Ended sweep(std::vector<std::string> options,
                const std::string& path = "$0/bin:/usr/bin:/bin") const {
        std::vector<std::string> words{"-c",
                                       "cd \"$1\" && PATH=" + path + " && shift && exec \"$@\"",
                                       folder.path(""),
                                       place,
                                       ROVERNET_COMMAND,
                                       "sweep",
                                       "s.toml"};
        words.insert(words.end(), options.begin(), options.end());
        return Process(folder, words, "/bin/bash").wait();
    }
    Ended submit(std::vector<std::string> options = {}) const {
        options.insert(options.begin(), {"--executor", "slurm", "--chunk", "5"});
        return sweep(options);
    }

    std::string said(const std::string& by) const { return content(folder.path("bin/" + by)); }
    std::string store() const { return place + "/s.db"; }
    std::string shards() const { return store() + ".slurm/shards"; }
    std::string csv() const { return command(folder, {"results", store(), "--csv"}).out; }
    static std::string local_csv() {
        const Cluster local;
        CHECK(local.sweep({}).exit == 0);
        return local.csv();
    }

    TemporaryFolder folder;
    std::string name = "it's a \"$1\" 50%a";
    std::string place = folder.path(name);
    std::string file;
};

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("sweep on Slurm: the tasks and their merge give the same results as a local sweep") {
    const Cluster cluster;
    const Ended ended = cluster.submit({"--workers", "2", "--sbatch", "--partition=x --time=1:00"});
    CAPTURE(ended.err);
    CHECK(ended.exit == 0);
    CHECK(has(ended.out, "job 77: 3 tasks of up to 5 runs; job 78 "));
    CHECK(has(cluster.said("words"), "\n--array=0-2%2\n"));
    CHECK(has(cluster.said("words"), "\n--dependency=afterany:77\n"));
    CHECK(has(cluster.said("words"), "\n--partition=x\n--time=1:00\n"));
    CHECK(has(cluster.said("merge"), "12 runs are finished, 0 failed, 0 are left"));
    CHECK(has(cluster.said("merge"), "exit 0\n"));
    CHECK(fs::is_empty(cluster.shards()));
    CHECK(cluster.csv() == Cluster::local_csv());
    CHECK(has(cluster.submit().err, "nothing to submit"));
}

TEST_CASE(
    "sweep on Slurm: if a task is lost, this is reported, and the same command repeats its runs") {
    const Cluster cluster;
    cluster.folder.write("bin/lost", "1");
    CHECK(cluster.submit().exit == 0);
    CHECK(has(cluster.said("merge"),
              "/shards/1.db: there is no such file; expected a store that sweep --shard wrote"));
    CHECK(has(cluster.said("merge"), "7 runs are finished, 0 failed, 5 are left"));
    CHECK(has(cluster.said("merge"), "exit 4\n"));
    fs::remove(cluster.folder.path("bin/lost"));
    fs::remove(cluster.folder.path("bin/words"));
    CHECK(has(cluster.submit().out, "1 tasks"));
    CHECK(has(cluster.said("words"), "\n--array=1\n"));
    CHECK(has(cluster.said("merge"), "exit 0\n"));
    CHECK(cluster.csv() == Cluster::local_csv());
}

TEST_CASE("sweep on Slurm: a task skips runs that are in the store or in the task's shard file") {
    const Cluster cluster;
    CHECK(cluster.sweep({"--shard", "0", "--chunk", "3"}).exit == 0);
    fs::create_directories(cluster.shards());
    CHECK(cluster.sweep({"--shard", "3", "--chunk", "1", "--store", cluster.shards() + "/0.db"})
              .exit == 0);
    CHECK(cluster.submit({"--json"}).exit == 0);
    CHECK(has(cluster.said("merge"), "exit 0\n"));
    CHECK(cluster.csv() == Cluster::local_csv());

    const Cluster one;
    CHECK(one.sweep({"--shard", "0", "--chunk", "3"}).exit == 0);
    const Ended task = one.sweep(
        {"--shard", "0", "--chunk", "5", "--except", "s.db", "--store", "t.db", "--json"});
    const Json json = Json::parse(task.out);
    CHECK(json["before"] == 3);
    CHECK(json["finished"] == 2);
}

TEST_CASE("sweep on Slurm: a dry run prints scripts and commands, and submits nothing") {
    const Cluster cluster;
    const Ended ended = cluster.submit({"--dry-run", "--seed", "3", "--replications", "3",
                                        "--timeout", "60 s", "--memory", "2GB", "--fail-fast"});
    CHECK(ended.exit == 0);
    CHECK_FALSE(fs::exists(cluster.folder.path("bin/words")));
    CHECK(has(ended.out, "\nsbatch --parsable --job-name=s --array=0-1 "));
    CHECK(has(ended.out, " --dependency=afterany:JOB "));
    for (const char* script : {"/job.sh", "/merge.sh"}) {
        const std::string text = content(cluster.store() + ".slurm" + script);
        CHECK(text.starts_with("#!/bin/bash\n"));
        CHECK(has(text,
                  "s.toml' --set scenario.seed=3 --set study.replications=3 "
                  "--timeout '60 s' --memory 2GB --fail-fast "));
        CHECK(has(ended.out, text));
    }
}

TEST_CASE("sweep on Slurm: with --json the output of each call is one JSON document") {
    const Cluster cluster;
    const Json shown = Json::parse(cluster.submit({"--dry-run", "--json"}).out);
    CHECK(shown["merge_script"] == content(cluster.store() + ".slurm/merge.sh"));
    CHECK(shown["job_script"] == content(cluster.store() + ".slurm/job.sh"));
    const Json submitted = Json::parse(cluster.submit({"--json"}).out);
    CHECK(submitted["job"] == "77");
    CHECK(submitted["merge_job"] == "78");
    CHECK(submitted["tasks"] == 3);
    CHECK(Json::parse(cluster.submit({"--json"}).out)["tasks"] == 0);
}

TEST_CASE("sweep on Slurm: a dry run deletes nothing; the command for missing runs lacks --fresh") {
    const Cluster cluster;
    CHECK(cluster.sweep({"--shard", "0", "--chunk", "5"}).exit == 0);
    const std::string kept = cluster.csv();
    CHECK(cluster.submit({"--dry-run", "--fresh", "--yes"}).exit == 0);
    CHECK(cluster.csv() == kept);
    const std::string fresh = cluster.submit({"--fresh", "--yes"}).out;
    CHECK(has(fresh, "this command makes missing runs:\n  rovernet sweep"));
    CHECK_FALSE(has(fresh, "--fresh"));
}

TEST_CASE("sweep on Slurm: an error says that sbatch is missing, or that it refuses the job") {
    const Cluster cluster;
    const Ended none = cluster.sweep({"--executor", "slurm"}, "/nowhere");
    CHECK(none.exit == 1);
    CHECK(has(none.err, "the program sbatch was not found"));
    cluster.folder.write("bin/refused", "--array");
    const Ended refused = cluster.submit();
    CHECK(refused.exit == 1);
    CHECK(has(refused.err, "sbatch: error: invalid partition\n"));
    CHECK(has(refused.err, "sbatch refused the job (exit code 1)"));
    cluster.folder.write("bin/refused", "--dependency");
    const Ended half = cluster.submit();
    CHECK(half.exit == 1);
    CHECK(has(half.err, "the tasks were submitted as job 77, but "));
    // What it says to call is right.
    const std::string call = half.err.substr(half.err.find("\n  bash ") + 1);
    CHECK(Process(cluster.folder, {"-c", call}, "/bin/bash").wait().exit == 0);
    CHECK(cluster.csv() == Cluster::local_csv());
}

TEST_CASE("sweep on Slurm: a failed run is repeated by each later sweep") {
    const Cluster cluster;
    const std::vector<std::string> limit{"--set", "scenario.event_limit=1"};
    cluster.submit(limit);
    CHECK(has(cluster.said("merge"), " failed, 0 are left"));
    CHECK_FALSE(has(cluster.said("merge"), " 0 failed"));
    CHECK(has(cluster.said("merge"), "exit 4\n"));
    CHECK(has(cluster.submit(limit).out, "job 77: "));
}

TEST_CASE("sweep on Slurm: options that exclude each other are refused") {
    const Cluster cluster;
    CHECK(cluster.submit({"--shard", "1"}).exit == 2);
    CHECK(cluster.submit({"--merge", "x.db"}).exit == 2);
    CHECK(cluster.sweep({"--shard", "1", "--merge", "x.db"}).exit == 2);
    CHECK(cluster.sweep({"--executor", "cloud"}).exit == 2);
    CHECK(has(cluster.submit({"--precision", "0.1"}).err, "expected [study] replications without"));
    CHECK(has(cluster.sweep({"--precision", "0.1", "--merge", "x.db"}).err, "replications"));
    CHECK_FALSE(fs::exists(cluster.store()));
}

TEST_CASE(
    "sweep --merge: prints the state of the store as JSON, and exits with 4 as long as runs are "
    "missing") {
    const Cluster cluster;
    for (const char* shard : {"0", "1"}) {
        const std::string store = std::string(shard) + ".db";
        CHECK(cluster.sweep({"--shard", shard, "--chunk", "6", "--store", store}).exit == 0);
    }
    const Ended part = cluster.sweep({"--json", "--merge", "0.db", "none.db"});
    CHECK(part.exit == 4);
    CHECK(has(
        part.err,
        "not merged: none.db: there is no such file; expected a store that sweep --shard wrote"));
    const Json json = Json::parse(part.out);
    CHECK(json["finished"] == 6);
    CHECK(json["left"] == 6);
    CHECK(cluster.sweep({"--merge", "1.db"}).exit == 0);
    CHECK(cluster.csv() == Cluster::local_csv());
}

TEST_CASE("sweep --fresh: shard files that are not merged are deleted after confirmation") {
    const Cluster cluster;
    fs::create_directories(cluster.shards());
    CHECK(cluster.sweep({"--store", cluster.shards() + "/0.db"}).exit == 0);
    const Ended asked = cluster.sweep({"--fresh"});
    CHECK(asked.exit == 2);
    CHECK(has(asked.err, "its shards on Slurm"));
    CHECK_FALSE(fs::is_empty(cluster.shards()));
    CHECK(cluster.sweep({"--fresh", "--yes"}).exit == 0);
    CHECK_FALSE(fs::exists(cluster.shards()));
}

}  // namespace slurm_test
