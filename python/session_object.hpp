// SPDX-License-Identifier: MIT
#pragma once

#include "live/lockstep/stepped_run.hpp"
#include "models/medium/medium.hpp"
#include "python/arguments.hpp"
#include "python/interruption.hpp"
#include "python/record_arrays.hpp"
#include "python/run_object.hpp"
#include "python/values.hpp"

#include <fmt/format.h>

#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace rovernet::python {

/// Message that a robot received: the Python class `rovernet.Heard`.
struct HeardObject {
    HeardMessage message;
    double noise;     // noise level at the receiver [dBm]
    py::tuple names;  // names of all robots

    py::object name(NodeId robot) const { return names[robot.index()]; }
    bool operator==(const HeardObject& other) const {
        return message == other.message && noise == other.noise;
    }
};

/// Step of a session. @throws std::invalid_argument if the step is too short, also if it is below
/// the resolution of a Duration
inline Duration step_of(double s) {
    const Duration step = from_seconds(s);
    if (step >= shortest_step) return step;
    throw std::invalid_argument(fmt::format("a step must be 1 us or more, got {} s", s));
}

/// Sink that calls a Python function with each record of one kind.
class RecordCallback {
  public:
    RecordCallback(KindMask kind, py::object function, Interruption& interruption)
        : kind_(kind), rows_(kind), function_(std::move(function)), interruption_(interruption) {}

    KindMask kinds() const { return rows_.kinds(); }
    void on(const Record& record, const RecordContext& context) {
        if (interruption_.has_error()) return;
        rows_.on(record, context);
        interruption_.call([&] {
            const RowSink::Table table = rows_.table(kind_);
            for (std::size_t i = 0; i < table.size(); ++i) function_(row_of(table, i));
        });
        rows_.clear();
    }
    const py::object& function() const { return function_; }

  private:
    KindMask kind_;
    RowSink rows_;
    py::object function_;
    Interruption& interruption_;
};

/// Scenario that a program drives step by step: the Python class `rovernet.Session`.
///
/// A step runs without Python's lock (GIL). Meanwhile the session rejects all calls except those
/// from callbacks, during which the simulation stands still.
class SessionObject {
  public:
    SessionObject(const py::object& scenario, const StepArgument& step, const py::object& seed,
                  const py::object& set, const RobotsArgument& robots, const py::object& out,
                  const KindsArgument& records)
        : kinds_(records.value),
          run_(to_scenario(scenario, set, seed),
               {.robots = robots.value,
                .step = step_of(step.value),
                .folder = folder_in(out),
                .client = "python",
                .prepare = [this](Network& network) { prepare(network); }}) {
        const Network& network = run_.session().network();
        names_ = names_of(network);
        for (std::size_t row = 0; row < run_.robots().size(); ++row) {
            rows_[run_.robots()[row]] = row;
        }
    }

    void reset(const SeedArgument& seed) {
        const Working working(*this);
        {
            const py::gil_scoped_release others_run;
            run_.reset(seed.value);
        }
        interruption_.raise();
    }
    py::list step() {
        // Number of events between two checks for an interruption: small, since one event may reach
        // thousands of robots.
        constexpr std::uint64_t events_a_slice = 256;
        const Working working(*this);
        {
            const py::gil_scoped_release others_run;
            run_.step(callbacks_.empty() ? events_a_slice : 1,
                      [this] { return interruption_.go_on(); });
        }
        interruption_.raise();
        py::list all;
        for (HeardMessage& message : run_.heard()) {
            const double noise =
                run_.session().network().medium().stations().noise(message.at).value;
            all.append(HeardObject{std::move(message), noise, names_});
        }
        return all;
    }
    RunObject finish() {
        const Working working(*this);
        auto scenario = std::make_shared<const Scenario>(run_.scenario());
        RunResult result = run_.finish();
        interruption_.raise();
        return {std::move(scenario), std::move(result), kept_, true};
    }
    /// Calls `function` with each record of the kind `name` from now on; None ends these calls.
    void on_record(const std::string& name, const py::object& function) {
        check_callable(function, "function");
        const Working working(*this);
        Network& network = run_.session().network();
        const KindMask kind = record_named(name);
        if (const auto old = callbacks_.find(kind); old != callbacks_.end()) {
            network.remove_sink(old->second.sink);
            callbacks_.erase(old);
        }
        if (function.is_none()) return;
        auto callback = std::make_shared<RecordCallback>(kind, function, interruption_);
        callbacks_[kind] = {callback, network.add_sink(callback)};
    }

    // Queries and commands that are allowed between steps and from callbacks.

    SteppedRun& run() {
        check_idle();
        return run_;
    }
    Network& network() { return run().session().network(); }
    std::size_t row(const std::string& robot) {
        const auto found = rows_.find(robot_named(network(), robot));
        if (found != rows_.end()) return found->second;
        throw py::value_error(
            fmt::format("robot {} is not among the robots that the session drives", robot));
    }
    const py::tuple& names() const { return names_; }
    py::array records(const std::string& name) {
        check_idle();
        const KindMask kind = record_named(name);
        if (!kept_ || (kept_->kinds() & kind) == 0) throw not_kept(name);
        return to_array(kept_->table(kind));
    }
    /// Calls visit(function) for each callback, for Python's garbage collector.
    template <class Visit>
    void for_each_callback(Visit visit) const {
        for (const auto& [kind, each] : callbacks_) visit(each.callback->function());
    }
    /// Removes all callbacks, to break reference cycles.
    void forget_callbacks() {
        for (const auto& [kind, each] : callbacks_) {
            if (!run_.is_over()) run_.session().network().remove_sink(each.sink);
        }
        callbacks_.clear();
    }

  private:
    struct Added {
        std::shared_ptr<RecordCallback> callback;
        SinkId sink;
    };
    /// Guard that marks the session as used by one call, so that other calls are rejected.
    class Working {
      public:
        explicit Working(SessionObject& session) : session_(session) {
            if (session_.works_) throw RunError("another call is still in a step of this session");
            session_.works_ = true;
        }
        ~Working() { session_.works_ = false; }

      private:
        SessionObject& session_;
    };
    void check_idle() const {
        if (works_ && !interruption_.is_calling()) {
            throw RunError("the session is in a step; expected this call between two steps");
        }
    }
    void prepare(Network& network) {
        kept_ = rows_of(kinds_);
        if (kept_) network.add_sink(kept_);
        for (auto& [kind, each] : callbacks_) each.sink = network.add_sink(each.callback);
    }

    std::vector<std::string> kinds_;
    std::shared_ptr<RowSink> kept_;  // stored records
    Interruption interruption_;
    std::map<KindMask, Added> callbacks_;
    bool works_ = false;
    SteppedRun run_;
    py::tuple names_;
    std::map<NodeId, std::size_t> rows_;
};

}  // namespace rovernet::python
