// SPDX-License-Identifier: MIT
#include "models/links/link_changes.hpp"

#include "models/links/range_crossing.hpp"
#include "models/medium/link_range.hpp"
#include "models/medium/medium.hpp"
#include "models/propagation/log_distance.hpp"
#include "models/propagation/raytrace_2007.hpp"
#include "study/validation/cases/drawn_map.hpp"
#include "study/validation/validation_charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace rovernet {
namespace {

using std::chrono::nanoseconds;

constexpr Duration passing{20'000'000'000};  // of two robots, straight past one another

/// Times at which a link changes.
using Changes = std::vector<Time>;

/// Two robots on their way, and the medium between them.
class Pass {
  public:
    Pass(const Scene& scene, const Propagation& model, const Leg& from, const Leg& to)
        : medium({.scene = &scene}) {
        const Radio radio{.power = Dbm{10}, .sensitivity = Dbm{-80}};
        std::uint64_t key = 0;
        for (const Leg& leg : {from, to}) {
            legs.add(leg);
            medium.add(radio, ++key, model);
        }
    }
    bool up(Time t) const { return medium.links().is_up(a, b, t, legs); }

    Legs legs;
    Medium medium;
    static constexpr NodeId a{0}, b{1};
};

/// Scene with passes of robots through it.
struct Passes {
    std::string title;
    std::shared_ptr<const Scene> scene;
    Propagation model;
    WallPassages walls;
    std::deque<Pass> all;
    double range = 0;  // [m] of a link, where it goes by distance

    double link_seconds() const { return seconds(passing) * static_cast<double>(all.size()); }
};

Leg straight(Vec3 from, Vec3 to) {
    return {.end = start_of_run + passing,
            .from = from,
            .velocity = (1 / seconds(passing)) * (to - from),
            .to = to};
}

/// @param width, depth  [m] of the area that the robots cross
Passes passes_in(std::string title, std::shared_ptr<const Scene> scene, Propagation model,
                 double width, double depth, std::size_t n) {
    Passes out{std::move(title), std::move(scene), std::move(model), {}, {}};
    out.walls = WallPassages(*out.scene);
    const auto point = [&](std::uint64_t i) {
        return Vec3{width * validation_draw("link_changes", i, 0),
                    depth * validation_draw("link_changes", i, 1)};
    };
    for (std::uint64_t i = 0; i < n; ++i) {
        out.all.emplace_back(*out.scene, out.model, straight(point(4 * i), point(4 * i + 1)),
                             straight(point(4 * i + 2), point(4 * i + 3)));
    }
    return out;
}

Changes found_ahead(const Passes& where, const Pass& pass, const LinkSearch& search) {
    const Time end = start_of_run + passing;
    Changes out;
    for (Time t = start_of_run; t < end;) {
        const auto change =
            next_link_change(pass.medium, pass.legs, where.walls, pass.a, pass.b, t, end, search);
        if (!change) break;
        out.push_back(t = *change);
    }
    return out;
}

/// Changes as a simulator that samples at fixed steps sees them.
Changes sampled_changes(const Pass& pass, Duration step) {
    Changes out;
    bool up = pass.up(start_of_run);
    for (Time t = start_of_run + step; t <= start_of_run + passing; t += step) {
        const bool now = pass.up(t);
        if (now != up) out.push_back(t);
        up = now;
    }
    return out;
}

/// Changes as sampled_changes() finds them, each then halved down to a nanosecond.
Changes halved(const Pass& pass, Duration step) {
    Changes out = sampled_changes(pass, step);
    for (Time& change : out) {
        const bool after = pass.up(change);
        Time no = change - step;
        while (change - no > nanoseconds{1}) {
            const Time middle = no + (change - no) / 2;
            (pass.up(middle) == after ? change : no) = middle;
        }
    }
    return out;
}

/// The closed form: when two that move straight are within a range.
Changes crossed(const Passes& where, const Pass& pass) {
    const Leg a = pass.legs.leg(pass.a), b = pass.legs.leg(pass.b);
    Changes out;
    const auto passage = range_crossing(b.from - a.from, b.velocity - a.velocity, where.range);
    if (!passage) return out;
    for (const double s : {passage->enter, passage->leave}) {
        if (s > 0 && s <= seconds(passing)) {
            out.push_back(start_of_run +
                          nanoseconds{static_cast<std::int64_t>(std::ceil(1e9 * s))});
        }
    }
    return out;
}

/// Time [s] during which two histories that begin alike have different states.
double disagreement(const Changes& x, const Changes& y) {
    Changes all = x;
    all.insert(all.end(), y.begin(), y.end());
    std::sort(all.begin(), all.end());
    all.push_back(start_of_run + passing);
    double sum = 0;
    for (std::size_t i = 0; i + 1 < all.size(); i += 2) sum += seconds(all[i + 1] - all[i]);
    return sum;
}

/// A way to find the changes of a pass.
struct ChangeMethod {
    std::string label;
    std::function<Changes(const Pass&)> changes;
};

std::vector<ChangeMethod> change_methods(const Passes& where, const ValidationSize& size) {
    std::vector<ChangeMethod> out{
        {"rovernet", [&](const Pass& pass) { return found_ahead(where, pass, {}); }}};
    for (const std::int64_t ms : {1000, 100, 10, 1}) {
        if (size.quick && ms < 10) continue;
        out.push_back({ms == 1000 ? "check every 1 s" : fmt::format("check every {} ms", ms),
                       [ms](const Pass& pass) {
                           return sampled_changes(pass, nanoseconds{1'000'000 * ms});
                       }});
    }
    return out;
}

/// Errors of a method; `latest` is the worst time [s] of a change where none is missed.
ValidationPoint judged_changes(const ChangeMethod& method, const Passes& where,
                               const std::vector<Changes>& truth, double& latest) {
    double wrong = 0, missed = 0, known = 0;
    std::vector<double> parts;  // of each pass
    latest = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const Changes found = method.changes(where.all[i]);
        parts.push_back(disagreement(found, truth[i]));
        wrong += parts.back();
        known += static_cast<double>(truth[i].size());
        missed +=
            std::max(0.0, static_cast<double>(truth[i].size()) - static_cast<double>(found.size()));
        if (found.size() != truth[i].size()) continue;
        for (std::size_t k = 0; k < found.size(); ++k) {
            latest = std::max(latest, std::abs(seconds(found[k] - truth[i][k])));
        }
    }
    for (double& part : parts)
        part *= 1e3 * static_cast<double>(truth.size()) / std::max(known, 1.0);
    return {.label = method.label,
            .error = 1e3 * wrong / std::max(known, 1.0),
            .details = {{"changes missed [%]", 100 * missed / std::max(known, 1.0)},
                        {"changes", known}},
            .parts = std::move(parts)};
}

ValidationPanel changes_panel(const Passes& where, const std::vector<Changes>& truth,
                              const ValidationSize& size, double& latest) {
    ValidationPanel panel{.title = where.title,
                          .cost_label = "CPU per second of a link [ns]",
                          .error_label = "time in a wrong state, per change [ms]"};
    const std::vector<ChangeMethod> methods = change_methods(where, size);
    std::vector<TimedMethod> timed;
    for (const ChangeMethod& method : methods) {
        double worst = 0;
        panel.points.push_back(judged_changes(method, where, truth, worst));
        if (method.label == "rovernet") latest = worst;
        timed.push_back(
            timed_sum(where.all, [&](const Pass& pass) { return method.changes(pass).size(); }));
        timed.back().operations = where.link_seconds();
    }
    set_costs(panel, timed, size.turns());
    return panel;
}

std::string step_sentence(const ValidationPanel& panel) {
    const ValidationPoint& exact = point_of(panel, "rovernet");
    const ValidationPoint& slow = point_of(panel, "check every 100 ms");
    return fmt::format(
        "{}: checking each link every 100 ms costs {:.2g} times as much as computing the changes "
        "in advance, and misses {:.2g} % of the changes. With checks, the state of a link is wrong "
        "for {:.2g} ms per change on average. With changes computed in advance, the state is wrong "
        "for {:.2g} ms per change.",
        panel.title, slow.cost.median / exact.cost.median, detail_of(slow, "changes missed [%]"),
        slow.error, exact.error);
}

}  // namespace

ValidationChart link_changes_chart(const ValidationSize& size, Promises& promises) {
    const auto field = std::make_shared<const Scene>();
    const DrawnBuilding office = drawn_office();
    const auto building = std::make_shared<const Scene>(drawn_map(
        office.width, office.depth, office_cell.value, [&](Vec3 p) { return office.is_wall(p); }));
    Passes open = passes_in("open field, log_distance", field,
                            LogDistance{.exponent = 3, .sigma = Db{0}}, 120, 120, size.of(200, 20));
    open.range = std::sqrt(largest_squared_distance(open.model, Hertz{2450e6}, Db{90}));
    const Passes walled =
        passes_in("office, raytrace_2007", building,
                  Raytrace2007{.coefficient = 20, .wall_factor = 0.3}, 40, 20, size.of(50, 4));
    std::vector<Changes> open_truth, walled_truth;
    for (const Pass& pass : open.all) open_truth.push_back(crossed(open, pass));
    const Duration fine{size.quick ? 1'000'000 : 100'000};
    for (const Pass& pass : walled.all) walled_truth.push_back(halved(pass, fine));
    double open_latest = 0, walled_latest = 0;
    const ValidationPanel by_distance = changes_panel(open, open_truth, size, open_latest);
    const ValidationPanel by_walls = changes_panel(walled, walled_truth, size, walled_latest);
    promises.push_back({"time of a link change that distance causes, against the closed form", "ns",
                        2, 1e9 * open_latest, open.all.size()});
    promises.push_back({"time of a link change behind walls, against a finer search", "ms",
                        1e3 * seconds(LinkSearch{}.tolerance), 1e3 * walled_latest,
                        walled.all.size()});
    return {
        .name = "link_changes",
        .title = "When does a link come up or go down?",
        .truth = fmt::format(
            "Two robots drive along straight lines for {:g} s: {} times on an open field, {} times "
            "in an office. On the open field, the reference is the exact time at which the robots "
            "enter or leave each other's range. In the office, the reference is a search: the "
            "link is sampled every {:g} ms, and each change is then located by bisection, down to "
            "a nanosecond.",
            seconds(passing), open.all.size(), walled.all.size(), 1e3 * seconds(fine)),
        .panels = {by_distance, by_walls},
        .sentences = {step_sentence(by_distance), step_sentence(by_walls)}};
}

}  // namespace rovernet
