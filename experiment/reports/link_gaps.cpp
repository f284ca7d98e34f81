// SPDX-License-Identifier: MIT
#include "experiment/reports/link_gaps.hpp"

#include "experiment/build.hpp"
#include "experiment/reports/network_at.hpp"
#include "experiment/reports/time_text.hpp"
#include "experiment/run.hpp"
#include "sim/error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <variant>

namespace rovernet {
namespace {

/// Whether the robot is there, switched on or off.
bool is_present(const Network& network, NodeId robot) {
    const Presence presence = network.robot(robot).presence;
    return presence == Presence::on || presence == Presence::off;
}

/// Length of the path on a leg from `begin` to `end` [m].
double path_length(const Leg& leg, Time begin, Time end) {
    const Time until = std::min(end, leg.end);
    return until > begin ? distance(leg.velocity, {}) * seconds(until - begin) : 0;
}

bool is_in(const std::vector<NodeId>& nodes, NodeId node) {
    return std::find(nodes.begin(), nodes.end(), node) != nodes.end();
}

std::string place_text(Vec3 p) { return fmt::format("{:.6f},{:.6f},{:.6f}", p.x, p.y, p.z); }

}  // namespace

Duration LinkGaps::lost() const {
    Duration sum{0};
    for (const LinkGap& gap : gaps) sum += gap.length();
    return sum;
}

double LinkGaps::lost_path() const {
    double sum = 0;
    for (const LinkGap& gap : gaps) sum += gap.path;
    return sum;
}

double LinkGaps::lost_share() const {
    return present > Duration{0} ? seconds(lost()) / seconds(present) : 0;
}

LinkGapFinder::LinkGapFinder(const Network& network, NodeId robot, std::vector<NodeId> partners,
                             std::vector<NodeId> relays)
    : network_(network),
      robot_(robot),
      partners_(std::move(partners)),
      relays_(std::move(relays)),
      is_there_(is_present(network, robot)) {}

/// Whether a link between two robots may be part of the robot's link to a partner.
bool LinkGapFinder::matters(NodeId a, NodeId b) const {
    const auto is_own = [this](NodeId node) { return node == robot_ || is_in(relays_, node); };
    const auto is_any = [&](NodeId node) { return is_own(node) || is_in(partners_, node); };
    return is_any(a) && is_any(b) && (is_own(a) || is_own(b));
}

void LinkGapFinder::on(const Record& record, const RecordContext&) {
    if (const auto* moved = std::get_if<Moved>(&record)) {
        if (moved->node != robot_) return;
        advance(moved->time);
        leg_ = moved->leg;
    } else if (const auto* switched = std::get_if<Switched>(&record)) {
        if (switched->node != robot_) return;
        advance(switched->time);
        is_there_ = is_present(network_, robot_);
    } else if (const auto* up = std::get_if<LinkUp>(&record)) {
        if (!matters(up->from, up->to)) return;
        advance(up->time);
        up_.insert({up->from, up->to});
    } else if (const auto* down = std::get_if<LinkDown>(&record)) {
        if (!matters(down->from, down->to)) return;
        advance(down->time);
        up_.erase({down->from, down->to});
    }
}

void LinkGapFinder::advance(Time t) {
    const Time begin = std::exchange(now_, t);
    if (t <= begin || !leg_ || !is_there_) return;
    const double path = path_length(*leg_, begin, t);
    gaps_.present += t - begin;
    gaps_.path += path;
    if (is_linked()) return;
    auto& gaps = gaps_.gaps;
    if (gaps.empty() || gaps.back().end != begin) {
        gaps.push_back({.begin = begin, .end = begin, .from = leg_->position(begin), .to = {}});
    }
    gaps.back().end = t;
    gaps.back().to = leg_->position(t);
    gaps.back().path += path;
}

/// Whether the robot has a link to a partner, searched hop by hop.
bool LinkGapFinder::is_linked() const {
    std::vector<NodeId> reached{robot_};
    for (std::size_t next = 0; next < reached.size(); ++next) {
        const NodeId at = reached[next];
        for (const NodeId partner : partners_) {
            if (both_hear(at, partner)) return true;
        }
        for (const NodeId relay : relays_) {
            if (!is_in(reached, relay) && both_hear(at, relay)) reached.push_back(relay);
        }
    }
    return false;
}

const LinkGaps& LinkGapFinder::gaps(Time end) {
    advance(end);
    return gaps_;
}

std::vector<NodeId> partners_named(const Network& network, const std::vector<std::string>& names,
                                   const std::optional<NodeId>& robot, const std::string& option) {
    std::vector<NodeId> partners;
    for (const std::string& name : names) {
        const NodeId node = robot_named(network, name);
        const bool is_twice = is_in(partners, node);
        if (is_twice || node == robot) {
            throw InputError(
                Location{fmt::format("{} {}", option, fmt::join(names, ",")), 0, 0, true},
                is_twice
                    ? fmt::format("found \"{}\" twice; expected each robot once", name)
                    : fmt::format("found \"{}\", the robot itself; expected other robots", name));
        }
        partners.push_back(node);
    }
    return partners;
}

LinkGaps link_gaps(const Scenario& scenario, const LinkGapsQuestion& question,
                   const TellTime& tell) {
    const Scenario played = without_idle_traffic(scenario);
    Network network(network_settings(played));
    populate(network, played);
    const NodeId robot = robot_named(network, question.robot);
    const auto finder = std::make_shared<LinkGapFinder>(
        network, robot, partners_named(network, question.partners, robot, "--to"),
        partners_named(network, question.relays, robot, "--over"));
    network.add_sink(finder);
    const Time end = start_of_run + played.scenario.duration;
    play_until(network, end, tell);
    return finder->gaps(end);
}

std::string link_gaps_text(const LinkGapsQuestion& question, const LinkGaps& gaps) {
    if (gaps.present == Duration{0})
        return fmt::format("{} is not present during the run", question.robot);
    const std::string to = fmt::format("{}{}{}", fmt::join(question.partners, " or "),
                                       question.relays.empty() ? "" : ", also over ",
                                       fmt::join(question.relays, ", "));
    if (gaps.gaps.empty()) {
        return fmt::format("{} has a link to {} all the time ({:.6g} s)", question.robot, to,
                           seconds(gaps.present));
    }
    return fmt::format(
        "{} has no link to {} for {:.3f} s of {:.6g} s ({:.1f} %), and on {:.2f} m of the {:.2f} m "
        "of its path",
        question.robot, to, seconds(gaps.lost()), seconds(gaps.present), 100 * gaps.lost_share(),
        gaps.lost_path(), gaps.path);
}

std::string link_gaps_csv(const LinkGaps& gaps) {
    std::string lines;
    for (const LinkGap& gap : gaps.gaps) {
        lines +=
            fmt::format("{},{},{:.6f},{},{}\n", exact_seconds(gap.begin), exact_seconds(gap.end),
                        gap.path, place_text(gap.from), place_text(gap.to));
    }
    return lines;
}

Table link_gaps_document(const LinkGapsQuestion& question, const LinkGaps& gaps) {
    Table out;
    out.set("robot", question.robot);
    out.set("to", Array(question.partners.begin(), question.partners.end()));
    out.set("over", Array(question.relays.begin(), question.relays.end()));
    out.set("present_s", seconds(gaps.present));
    out.set("path_m", gaps.path);
    out.set("lost_s", seconds(gaps.lost()));
    out.set("lost_share", gaps.lost_share());
    out.set("lost_path_m", gaps.lost_path());
    Array list;
    for (const LinkGap& gap : gaps.gaps) {
        Table row;
        row.set("begin_s", seconds(gap.begin));
        row.set("end_s", seconds(gap.end));
        row.set("path_m", gap.path);
        row.set("begin_x_m", gap.from.x);
        row.set("begin_y_m", gap.from.y);
        row.set("begin_z_m", gap.from.z);
        row.set("end_x_m", gap.to.x);
        row.set("end_y_m", gap.to.y);
        row.set("end_z_m", gap.to.z);
        list.emplace_back(std::move(row));
    }
    out.set("gaps", std::move(list));
    return out;
}

}  // namespace rovernet
