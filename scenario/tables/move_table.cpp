// SPDX-License-Identifier: MIT
#include "scenario/tables/move_table.hpp"

#include "scenario/tables/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

namespace rovernet {
namespace {

/// Calls `visit(Model{})` for each listed model.
template <class Visitor>
void for_each_move(Visitor&& visit) {
    [&]<class... Models>(std::variant<Models...>*) {
        (visit(Models{}), ...);
    }(static_cast<MoveModels*>(nullptr));
}

void check_times(const Value& value, const std::vector<Duration>& times) {
    const bool later =
        std::adjacent_find(times.begin(), times.end(), std::greater_equal<>()) == times.end();
    if (times.front() >= Duration{0} && later) return;
    throw InputError(value.where, "times: expected times >= 0 s, each later than the time before");
}

constexpr const char* path_example = "path = [[\"5 m\", \"3 m\"], [\"5 m\", \"9 m\"]]";

void check(const WaypointsTable& waypoints, TableReader& table) {
    if (waypoints.path.empty()) table.missing("path", path_example);
    if (!waypoints.times) return;
    const Value& times = *table.take("times");
    if (waypoints.times->size() != waypoints.path.size()) {
        throw InputError(
            times.where,
            fmt::format(
                "times: found {} times for a path of {} places; expected one time for each place",
                waypoints.times->size(), waypoints.path.size()));
    }
    check_times(times, *waypoints.times);
}

void check(const GoalTable& goal, TableReader& table) {
    if (goal.to && !goal.among.empty()) table.only_one_of("to", "among");
    if (!goal.to && goal.among.empty()) {
        table.missing(table.table().find("among") ? "among" : "to",
                      "to = [\"5 m\", \"9 m\"], or among = [[\"5 m\", \"9 m\"]]");
    }
}

void check(const Patrol& patrol, TableReader& table) {
    if (patrol.path.empty()) table.missing("path", path_example);
}

template <class Other>
void check(const Other&, TableReader&) {}

template <class Model>
void read_leader(TableReader& table, MoveTable& move) {
    if constexpr (LedModel<Model>) {
        if (!table.read("leader", move.leader)) table.missing("leader", "leader = \"A\"");
        move.leader_where = table.take("leader")->where;
    }
}

/// Start of a model that can draw one: a robot with a place of its own starts there.
template <class Model>
void settle_start(Model& model, TableReader& table, bool placed) {
    if constexpr (DrawnModel<Model>) {
        using Start = decltype(model.start);
        const Value* given = table.take("start");
        if (!given && placed) model.start = Start::here;
        if (given && placed && model.start != Start::here) {
            throw InputError(
                given->where,
                fmt::format("start: found \"{}\" for a robot with a given place; expected start = "
                            "\"here\", or a robot without the keys \"at\" and \"place\"",
                            name_of(model.start)));
        }
        if (given && !placed && model.start == Start::here) {
            throw InputError(given->where,
                             "start: found \"here\" for a robot without a place; expected also at "
                             "= [\"2 m\", \"3 m\"], or place = { ... }");
        }
    }
}

}  // namespace

std::vector<std::string> move_names() {
    std::vector<std::string> names;
    for_each_move([&](const auto& model) { names.emplace_back(model.name); });
    return names;
}

bool MoveTable::draws_place() const {
    return std::visit(
        [](const auto& m) {
            if constexpr (DrawnModel<std::decay_t<decltype(m)>>) {
                return m.start != decltype(m.start)::here;
            }
            return false;
        },
        model);
}

MoveTable read_move(const Value& value, bool placed) {
    TableReader table(value, "move");
    const Value* name = table.take("model");
    if (!name) table.missing("model", "move = { model = \"goal\", to = [\"5 m\", \"9 m\"] }");
    MoveTable move;
    move.where = value.where;
    const std::size_t chosen = read_choice(*name, "movement model", move_names());
    std::size_t index = 0;
    for_each_move([&]<class Model>(Model model) {
        if (index++ != chosen) return;
        if constexpr (LedModel<Model>) {
            table.expect<Model>({"leader"});
        } else {
            table.expect<Model>();
        }
        table.read_fields(model);
        read_leader<Model>(table, move);
        check(model, table);
        settle_start(model, table, placed);
        move.model = std::move(model);
    });
    return move;
}

Table move_document(const MoveTable& move) {
    Table table;
    table.set("model", move.name());
    if (!move.leader.empty()) table.set("leader", move.leader);
    std::visit([&](const auto& parameters) { append_fields(table, parameters); }, move.model);
    std::erase_if(table.entries, [](const Entry& entry) {
        return entry.value.array() && entry.value.array()->empty();
    });
    return table;
}

}  // namespace rovernet
