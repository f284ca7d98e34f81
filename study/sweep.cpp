// SPDX-License-Identifier: MIT
#include "study/sweep.hpp"

#include "experiment/run.hpp"
#include "experiment/version.hpp"
#include "mobility/kept_planners.hpp"
#include "scenario/document/json.hpp"
#include "scenario/document/toml.hpp"
#include "scenario/scenario.hpp"
#include "study/command_words.hpp"
#include "study/precision.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <filesystem>
#include <map>

namespace rovernet {
namespace {

constexpr double longest_wait_s = 0.2;

/// A run of a study: its point and its replication.
struct Task {
    std::uint32_t point, replication;
    std::uint64_t number() const { return std::uint64_t{replication} << 32 | point; }
    static Task of(std::uint64_t number) {
        return {static_cast<std::uint32_t>(number), static_cast<std::uint32_t>(number >> 32)};
    }
    /// Order of runs: first one replication of every point, then the next one, so that a stopped
    /// sweep has equally many for each point.
    static Task at(std::uint64_t place, std::size_t points) {
        return {static_cast<std::uint32_t>(place % points),
                static_cast<std::uint32_t>(place / points)};
    }
};

/// Replications requested for every point, with or without `precision`.
std::uint64_t planned_runs(const Study& study) {
    return study.points().size() * static_cast<std::uint64_t>(study.table().replications);
}

/// The keys of a scenario with their values as texts, for saying where two differ.
void flatten(const Value& value, const std::string& path, std::map<std::string, std::string>& out) {
    if (const Table* table = value.table()) {
        for (const Entry& entry : table->entries) {
            flatten(entry.value, path.empty() ? entry.key : path + "." + entry.key, out);
        }
    } else if (const Array* list = value.array(); list && !list->empty() && list->front().table()) {
        for (std::size_t i = 0; i < list->size(); ++i) {
            flatten((*list)[i], fmt::format("{}.{}", path, i), out);
        }
    } else {
        out[path] = to_toml(value);
    }
}

/// Difference of a value of the scenario in words. @param other  value of now
std::string difference_text(const std::string& path, const std::string& text,
                            const std::string& other) {
    constexpr std::pair<std::string_view, std::string_view> hashes[] = {
        {"digests.walls", "the walls have changed"},
        {"digests.movement", "the movement file has changed"}};
    for (const auto& [name, words] : hashes)
        if (path == name) return std::string(words);
    if (path == "digests.warmup")
        return fmt::format("the warmup of [study] was {} and is now {}", text, other);
    return fmt::format("{} was {} and is now {}", path, text, other);
}

/// Differences between the scenario that a store was made for and that of now, in words: the first
/// one, and the number of the others if there are many; empty if nothing does.
/// @param varied  keys of the study, whose values in the scenario have no effect
std::string difference(const Value& then, const Table& now, const std::vector<Vary>& varied) {
    std::map<std::string, std::string> old_keys, new_keys;
    if (then.table()) flatten(then, "", old_keys);
    flatten(now, "", new_keys);
    for (const Vary& each : varied) {
        old_keys.erase(each.path);
        new_keys.erase(each.path);
    }
    std::vector<std::string> all;
    for (const auto& [path, text] : old_keys) {
        const auto found = new_keys.find(path);
        const std::string other = found == new_keys.end() ? "not given" : found->second;
        if (other != text) all.push_back(difference_text(path, text, other));
    }
    for (const auto& [path, text] : new_keys)
        if (!old_keys.contains(path)) all.push_back(difference_text(path, "not given", text));
    constexpr std::size_t few = 5;  // that a user may have changed in one scenario
    if (all.size() <= few) return all.empty() ? "" : all.front();
    return fmt::format(
        "{}, and {} more values are different: the store probably belongs to a different scenario",
        all.front(), all.size() - 1);
}

/// Reason why a point with stored runs is no longer in the study.
std::string why_gone(const StoredPoint& gone, const Study& study, const Value& then,
                     const Table& now) {
    std::vector<std::string> reasons;
    const std::string settings = settings_text(gone.settings);
    const auto& points = study.points();
    const bool listed = std::any_of(points.begin(), points.end(), [&](const StudyPoint& point) {
        return settings_text(point.settings) == settings;
    });
    if (!listed) reasons.emplace_back("[study] no longer contains this point");
    if (std::string changed = difference(then, now, study.table().vary); !changed.empty())
        reasons.push_back(changed);
    if (reasons.empty()) reasons.emplace_back("the map or the movement file has changed");
    return fmt::format("{}", fmt::join(reasons, ", and "));
}

std::vector<StoredPoint> stored_points(const Study& study) {
    std::vector<StoredPoint> points;
    for (const StudyPoint& point : study.points()) {
        points.push_back({static_cast<std::uint32_t>(points.size()), point.id, point.settings});
    }
    return points;
}

/// Sweep at work: what is to run, what has run, and the workers.
class Sweep {
  public:
    Sweep(Study& study, Store& store, const SweepOptions& options);
    SweepResult run();

  private:
    /// Points of each replication that wait for a worker.
    using Waiting = std::map<std::uint32_t, std::deque<std::uint32_t>>;

    void plan();
    void plan_replications();
    bool extends() const { return study_.table().precision && !options_.replications; }
    void add_run(Task task);
    void extend(std::uint32_t point);
    Waiting::iterator replication_for(std::size_t worker);
    void give_out();
    void end_run(Task task);
    void keep(const TaskEnd& end);
    void report();
    std::vector<double> values_of(std::uint32_t point) const;
    std::vector<ImprecisePoint> imprecise_points() const;
    std::string id_of(Task task) const {
        return run_id(study_.points()[task.point].id, task.replication, version_);
    }

    Study& study_;
    Store& store_;
    const SweepOptions& options_;
    const std::string version_ = code_version();
    KeptPlanners kept_;  // each worker has its own: it is a copy of this process
    Workers workers_;
    std::set<std::string> finished_;  // ids of runs here or elsewhere
    Waiting waiting_;
    const bool by_replication_;  // workers prefer replications that they have begun
    std::map<std::uint32_t, std::size_t> owner_;  // worker that began a replication
    std::map<std::uint64_t, int> attempts_;       // of tasks whose process died
    std::vector<std::uint32_t> planned_;          // of each point: replications asked for
    std::vector<std::uint32_t> open_;             // of each point: of those, runs that are not over
    std::vector<char> has_failed_;                // of each point: a run of it failed
    std::uint64_t next_ = 0;                      // place of the next run among all, for shards
    SweepResult result_;
};

Sweep::Sweep(Study& study, Store& store, const SweepOptions& options)
    : study_(study),
      store_(store),
      options_(options),
      workers_(
          options.workers,
          [this](std::uint64_t number) {
              const Task task = Task::of(number);
              return to_text(measure(study_.scenario(task.point, task.replication), kept_));
          },
          options.limits),
      by_replication_(study.has_walls()),
      planned_(study.points().size()),
      open_(study.points().size()),
      has_failed_(study.points().size()) {}

void Sweep::add_run(Task task) {
    const std::uint64_t place = next_++;
    ++planned_[task.point];
    if (options_.shard && place / options_.shard->size != options_.shard->number) return;
    if (finished_.contains(id_of(task))) {
        ++result_.progress.before;
        return;
    }
    ++open_[task.point];
    ++result_.progress.left;
    waiting_[task.replication].push_back(task.point);
}

void Sweep::plan() {
    finished_ = finished_runs(store_);
    finished_.insert(options_.elsewhere.begin(), options_.elsewhere.end());
    if (options_.replications) return plan_replications();
    const std::uint64_t runs = planned_runs(study_);
    for (std::uint64_t place = 0; place < runs; ++place) {
        add_run(Task::at(place, study_.points().size()));
    }
    for (std::uint32_t p = 0; p < open_.size(); ++p) {
        if (open_[p] == 0) extend(p);
    }
}

/// Plans the replications that were asked for, point by point within each replication.
void Sweep::plan_replications() {
    const std::vector<std::uint32_t>& asked = *options_.replications;
    const std::uint32_t most = *std::max_element(asked.begin(), asked.end());
    for (std::uint32_t r = 0; r < most; ++r) {
        for (std::uint32_t p = 0; p < asked.size(); ++p) {
            if (r < asked[p]) add_run({p, r});
        }
    }
}

/// Plans more replications of a point whose runs have all ended, if its precision is not reached.
void Sweep::extend(std::uint32_t point) {
    if (!extends()) return;
    while (open_[point] == 0 && has_failed_[point] == 0) {
        const auto wanted = replications_for(study_.table(), values_of(point), planned_[point]);
        if (wanted <= planned_[point]) return;
        for (std::uint32_t r = planned_[point]; r < wanted; ++r) add_run({point, r});
    }
}

/// The values of the study's first metric, in the order of the replications.
std::vector<double> Sweep::values_of(std::uint32_t point) const {
    std::vector<double> values;
    for (const StoredValue& v : store_.values(first_metric(study_.table()), point)) {
        if (v.value) values.push_back(*v.value);
    }
    return values;
}

std::vector<ImprecisePoint> Sweep::imprecise_points() const {
    std::vector<ImprecisePoint> list;
    if (!extends() || result_.stopped) return list;
    for (std::uint32_t point = 0; point < open_.size(); ++point) {
        const ReachedPrecision reached = reached_precision(study_.table(), values_of(point));
        if (reached.enough) continue;
        list.push_back(
            {.point = point, .values = reached.values, .half_width = reached.half_width});
    }
    return list;
}

void Sweep::end_run(Task task) {
    --result_.progress.left;
    if (--open_[task.point] == 0) extend(task.point);
}

void Sweep::keep(const TaskEnd& end) {
    const Task task = Task::of(end.task);
    if (end.kind == TaskEnd::died && ++attempts_[end.task] == 1) {
        waiting_[task.replication].push_front(task.point);
        return;
    }
    StoredRun run{.id = id_of(task),
                  .point = task.point,
                  .replication = task.replication,
                  .error = {},
                  .measurement = {}};
    if (end.kind == TaskEnd::done) {
        run.measurement = measurement_of(end.text);
        result_.progress.searches += run.measurement.searches;
        ++result_.progress.finished;
    } else {
        run.error = end.text;
        run.measurement.started = utc_now();
        run.measurement.host = host_name();
        ++result_.progress.failed;
        has_failed_[task.point] = 1;
        if (!result_.failure) result_.failure = run;
    }
    store_.record(run);
    end_run(task);
}

/// Next replication for a worker: one that it has started, whose paths it has cached; else one that
/// no worker has started; else, if workers may share replications, the first one.
Sweep::Waiting::iterator Sweep::replication_for(std::size_t worker) {
    if (!by_replication_) return waiting_.begin();
    for (auto each = waiting_.begin(); each != waiting_.end(); ++each) {
        const auto owner = owner_.find(each->first);
        if (owner == owner_.end() || owner->second == worker) return each;
    }
    return options_.replication_on_one_worker ? waiting_.end() : waiting_.begin();
}

void Sweep::give_out() {
    for (const std::size_t worker : workers_.idle()) {
        const auto chosen = replication_for(worker);
        if (chosen == waiting_.end()) continue;
        const Task task{chosen->second.front(), chosen->first};
        chosen->second.pop_front();
        if (chosen->second.empty()) waiting_.erase(chosen);
        owner_.try_emplace(task.replication, worker);
        workers_.begin(worker, task.number());
    }
}

void Sweep::report() { options_.progress(result_.progress); }

SweepResult Sweep::run() {
    plan();
    report();
    for (;;) {
        const Stop stop = options_.stop();
        const bool enough = options_.fail_fast && result_.failure;
        if (stop == Stop::no && !enough) give_out();
        if (stop == Stop::at_once || workers_.busy() == 0) break;
        if (const auto end = workers_.wait(longest_wait_s)) keep(*end);
        report();
    }
    result_.stopped = result_.progress.left > 0;
    result_.imprecise = imprecise_points();
    return result_;
}

}  // namespace

Store open_store(const std::string& path, Study& study) {
    Store store = Store::open_to_write(path);
    const std::string version = store.property("version");
    if (!version.empty() && version != code_version()) {
        throw InputError(
            {path},
            fmt::format("the stored runs were made by version {}, but this is version {}; expected "
                        "--fresh, which deletes the stored runs, or a different --store",
                        version, code_version()));
    }
    const Table scenario = study.identity(study.base());
    const std::vector<StoredPoint> points = stored_points(study);
    std::set<std::string> ids;
    for (const StoredPoint& point : points) ids.insert(point.id);
    for (const StoredPoint& point : store.points()) {
        if (ids.contains(point.id)) continue;
        throw InputError(
            {path},
            fmt::format(
                "the store has runs of {}, but the study does not have this point (reason: {}); "
                "expected --fresh, which deletes the stored runs, or a different --store",
                settings_text(point.settings),
                why_gone(point, study, store.document("scenario"), scenario)));
    }
    store.set_points(points);
    store.set_property("version", code_version());
    store.set_property("scenario", to_json_line(scenario));
    store.set_property("study", to_json_line(study_document(study.table())));
    const auto folder = std::filesystem::absolute(path).parent_path();
    store.set_property("file", std::filesystem::proximate(study.base().file, folder).string());
    Array options;
    for (std::string& word : option_words(study.options())) options.emplace_back(std::move(word));
    store.set_property("options", to_json_line(options));
    if (store.property("created").empty()) store.set_property("created", utc_now());
    return store;
}

std::set<std::string> finished_runs(const Store& store) {
    std::set<std::string> ids;
    for (StoredRun& run : store.runs()) {
        if (run.error.empty()) ids.insert(std::move(run.id));
    }
    return ids;
}

std::vector<RunState> run_states(const Study& study, const Store& store) {
    std::map<std::string, RunState> known;
    for (const StoredRun& run : store.runs()) {
        known[run.id] = run.error.empty() ? RunState::finished : RunState::failed;
    }
    const std::string version = code_version();
    std::vector<RunState> states(planned_runs(study), RunState::missing);
    for (std::uint64_t place = 0; place < states.size(); ++place) {
        const Task task = Task::at(place, study.points().size());
        const auto run =
            known.find(run_id(study.points()[task.point].id, task.replication, version));
        if (run != known.end()) states[place] = run->second;
    }
    return states;
}

SweepResult sweep(Study& study, Store& store, const SweepOptions& options) {
    return Sweep(study, store, options).run();
}

}  // namespace rovernet
