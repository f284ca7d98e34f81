// SPDX-License-Identifier: MIT
#include "study/merge.hpp"

#include "files/input_file.hpp"
#include "sim/error.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <set>

namespace rovernet {

void copy_runs(const Store& from, Store& to, std::uint32_t below) {
    std::map<std::string, std::uint32_t> numbers;
    for (const StoredPoint& point : to.points()) numbers[point.id] = point.number;
    std::map<std::string, bool> known;  // run -> finished
    for (const StoredRun& run : to.runs()) known[run.id] = run.error.empty();
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<MetricValue>> metrics;
    from.for_each_value([&](const StoredValue& value, const std::string& metric) {
        metrics[{value.point, value.replication}].push_back({metric, value.value});
    });
    std::map<std::uint32_t, std::string> ids;
    for (const StoredPoint& point : from.points()) ids[point.number] = point.id;
    for (StoredRun run : from.runs()) {
        const auto number = numbers.find(ids[run.point]);
        const auto there = known.find(run.id);
        if (number == numbers.end() || run.replication >= below) continue;
        if (there != known.end() && (there->second || !run.error.empty())) continue;
        run.measurement.metrics = metrics[{run.point, run.replication}];
        run.point = number->second;
        to.record(run);
    }
}

void merge(Store& store, const std::string& path) {
    const Store shard = Store::open(path);
    if (shard.property("version") != store.property("version")) {
        throw InputError(
            {path},
            fmt::format(
                "the runs in this store were made by version {}, but the runs in {} by version {}; "
                "expected runs of one version: repeat the sweep of one of the two stores",
                shard.property("version"), store.path(), store.property("version")));
    }
    std::set<std::string> ours;
    for (const StoredPoint& point : store.points()) ours.insert(point.id);
    for (const StoredPoint& point : shard.points()) {
        if (!ours.contains(point.id))
            throw InputError({path},
                             "this store belongs to a different study; expected a store that sweep "
                             "--shard made for the same study");
    }
    copy_runs(shard, store);
}

void check_shard(const std::string& path) {
    if (input_kind(path) == InputKind::nothing) return;
    need_file(path);
    // The first bytes of a SQLite database: https://www.sqlite.org/fileformat.html, 1.3. A process
    // that was killed as it began leaves an empty file.
    constexpr std::string_view magic{"SQLite format 3", 16};
    const std::string begin = InputFile(path).read(magic.size());
    if (begin.empty() || begin == magic) return;
    throw InputError(
        {path}, "this file is not a store of a study; expected a store that sweep --shard wrote");
}

void merge_and_remove(Store& store, const std::string& path) {
    // Opening for writing recovers the journal of a killed process, and fails if another process
    // writes.
    if (input_kind(path) == InputKind::nothing) {
        throw InputError({path},
                         "there is no such file; expected a store that sweep --shard wrote");
    }
    check_shard(path);
    Store::open_to_write(path);
    // A shard without runs may lack the identity of its study, if its process was killed early.
    if (!Store::open(path).runs().empty()) merge(store, path);
    for (const char* ending : {"", "-wal", "-shm"}) std::filesystem::remove(path + ending);
}

}  // namespace rovernet
