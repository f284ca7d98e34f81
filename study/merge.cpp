// SPDX-License-Identifier: MIT
#include "study/merge.hpp"

#include "files/input_file.hpp"
#include "sim/error.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <map>

namespace rovernet {

void merge(Store& store, const std::string& path) {
    const Store shard = Store::open(path);
    if (shard.property("version") != store.property("version")) {
        throw InputError({path}, fmt::format("runs of version {}, but {} has those of {}",
                                             shard.property("version"), store.path(),
                                             store.property("version")));
    }
    std::map<std::string, std::uint32_t> numbers;
    for (const StoredPoint& point : store.points()) numbers[point.id] = point.number;
    const std::vector<StoredPoint> theirs = shard.points();
    for (const StoredPoint& point : theirs) {
        if (!numbers.contains(point.id)) throw InputError({path}, "a store of another study");
    }
    std::map<std::string, bool> ours;  // run -> finished
    for (const StoredRun& run : store.runs()) ours[run.id] = run.error.empty();
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<MetricValue>> metrics;
    shard.for_each_value([&](const StoredValue& value, const std::string& metric) {
        metrics[{value.point, value.replication}].push_back({metric, value.value});
    });
    std::map<std::uint32_t, std::string> ids;
    for (const StoredPoint& point : theirs) ids[point.number] = point.id;
    for (StoredRun run : shard.runs()) {
        const auto known = ours.find(run.id);
        if (known != ours.end() && (known->second || !run.error.empty())) continue;
        run.measurement.metrics = metrics[{run.point, run.replication}];
        run.point = numbers[ids[run.point]];
        store.record(run);
    }
}

void check_shard(const std::string& path) {
    if (input_kind(path) == InputKind::nothing) return;
    need_file(path);
    // The first bytes of a SQLite database: https://www.sqlite.org/fileformat.html, 1.3. A process
    // that was killed as it began leaves an empty file.
    constexpr std::string_view magic{"SQLite format 3", 16};
    const std::string begin = InputFile(path).read(magic.size());
    if (begin.empty() || begin == magic) return;
    throw InputError({path}, "no store of a study; expected the store of a shard");
}

void merge_and_remove(Store& store, const std::string& path) {
    // The journal of a killed process comes into the file; a process that writes keeps us out.
    if (input_kind(path) == InputKind::nothing) {
        throw InputError({path}, "there is no such shard");
    }
    check_shard(path);
    Store::open_to_write(path);
    // A shard without runs may not say whose it is: its process ended too early for that.
    if (!Store::open(path).runs().empty()) merge(store, path);
    for (const char* ending : {"", "-wal", "-shm"}) std::filesystem::remove(path + ending);
}

}  // namespace rovernet
