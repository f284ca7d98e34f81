// SPDX-License-Identifier: MIT
#include "pictures/map/margin_survey.hpp"

#include "experiment/reports/range_of_model.hpp"
#include "models/medium/medium.hpp"
#include "pictures/draw/svg.hpp"
#include "pictures/map/link_grades.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

namespace rovernet {
namespace {

constexpr std::int64_t least_samples = 1000, most_samples = 4000, most_margins = 400'000;

/// Margin between two samples [dB]: the mean, or the larger one if the link is down at the other.
double between(double a, double b) { return std::min(a, b) >= 0 ? (a + b) / 2 : std::max(a, b); }

constexpr std::size_t longest_station_name = 24;

bool is_in(const std::vector<NodeId>& nodes, NodeId node) {
    return std::find(nodes.begin(), nodes.end(), node) != nodes.end();
}

std::vector<std::string> names(const Network& network, const std::vector<NodeId>& nodes) {
    std::vector<std::string> out;
    for (const NodeId node : nodes)
        out.push_back(shortened(network.name(node), longest_station_name));
    return out;
}

/// Appends a piece, or lengthens the last one.
void append(std::vector<MarginPiece>& pieces, const MarginPiece& piece) {
    if (piece.begin >= piece.end) return;
    if (!pieces.empty() && pieces.back().end == piece.begin && pieces.back().grade == piece.grade) {
        pieces.back().end = piece.end;
    } else {
        pieces.push_back(piece);
    }
}

}  // namespace

MarginSurvey::MarginSurvey(Network& network, std::vector<NodeId> partners,
                           std::vector<NodeId> relays)
    : network_(network),
      partners_(std::move(partners)),
      relays_(std::move(relays)),
      robots_(network.size()) {
    for (NodeId node{0}; node.index() < robots_.size(); ++node.value) {
        if (is_in(partners_, node) || is_in(relays_, node)) continue;
        auto& finder = robots_[node.index()].finder;
        finder = std::make_shared<LinkGapFinder>(network, node, partners_, relays_);
        network.add_sink(finder);
    }
}

void MarginSurvey::run_until(Time end) {
    const std::size_t stations = partners_.size() + relays_.size();
    const auto pairs = static_cast<std::int64_t>((robots_.size() + relays_.size()) * stations);
    const std::int64_t samples =
        std::clamp(most_margins / std::max<std::int64_t>(pairs, 1), least_samples, most_samples);
    const std::int64_t ns = (end - start_of_run).count();
    for (std::int64_t i = 0; i <= samples; ++i) {
        const Duration passed{ns / samples * i + ns % samples * i / samples};
        network_.run_until(start_of_run + passed);
        times_.push_back(start_of_run + passed);
        sample_stations();
        for (NodeId node{0}; node.index() < robots_.size(); ++node.value) {
            if (!is_station(node)) sample(node);
        }
    }
    for (Robot& robot : robots_) {
        if (robot.finder) robot.gaps = robot.finder->gaps(end);
    }
}

double MarginSurvey::margin(NodeId a, NodeId b) const {
    const LinkLosses& links = network_.medium().links();
    const Time now = network_.now();
    return std::min(links.margin(a, b, now, network_.legs()).value,
                    links.margin(b, a, now, network_.legs()).value);
}

/// Finds each relay's best path to a partner, as in the algorithm of Prim: the relay with the best
/// margin is next.
void MarginSurvey::sample_stations() {
    constexpr double most = std::numeric_limits<double>::infinity();
    stations_.clear();
    for (const NodeId partner : partners_) stations_.push_back({partner, most});
    std::vector<Station> rest;
    for (const NodeId relay : relays_) {
        if (!is_in(partners_, relay)) rest.push_back({relay, -most});
    }
    std::size_t begin = 0;
    while (!rest.empty()) {
        for (; begin < stations_.size(); ++begin) {
            const auto [via, there] = stations_[begin];
            for (Station& each : rest)
                each.margin = std::max(each.margin, std::min(there, margin(each.node, via)));
        }
        const auto best = std::max_element(
            rest.begin(), rest.end(),
            [](const Station& a, const Station& b) { return a.margin < b.margin; });
        stations_.push_back(*best);
        rest.erase(best);
    }
}

/// Samples a robot's margin. A robot at rest draws no line, so that it keeps its last margin.
void MarginSurvey::sample(NodeId node) {
    Robot& robot = robots_[node.index()];
    const Vec3 here = network_.position(node);
    const bool rests = robot.sampled_at && *robot.sampled_at == here;
    double best = rests ? robot.margins.back() : -std::numeric_limits<double>::infinity();
    for (const Station& station : stations_) {
        if (!rests) best = std::max(best, std::min(station.margin, margin(node, station.node)));
    }
    robot.margins.push_back(best);
    robot.sampled_at = here;
}

std::vector<MarginPiece> MarginSurvey::pieces(NodeId node) const {
    const Robot& robot = robots_[node.index()];
    std::vector<MarginPiece> out;
    auto gap = robot.gaps.gaps.begin();
    for (std::size_t i = 1; i < robot.margins.size(); ++i) {
        const std::size_t grade = grade_of(between(robot.margins[i - 1], robot.margins[i]));
        Time begin = times_[i - 1];
        while (gap != robot.gaps.gaps.end() && gap->begin < times_[i]) {
            append(out, {begin, gap->begin, grade});
            begin = std::min(gap->end, times_[i]);
            append(out, {std::max(gap->begin, times_[i - 1]), begin, std::nullopt});
            if (gap->end > times_[i]) break;
            ++gap;
        }
        append(out, {begin, times_[i], grade});
    }
    return out;
}

std::vector<std::string> MarginSurvey::gap_texts() const {
    constexpr std::size_t most_texts = 3;
    LinkGapsQuestion question{{}, names(network_, partners_), names(network_, relays_)};
    std::vector<std::string> texts;
    std::size_t moved = 0;
    for (NodeId node{0}; node.index() < robots_.size(); ++node.value) {
        const LinkGaps& gaps = robots_[node.index()].gaps;
        if (is_station(node) || gaps.path == 0 || ++moved > most_texts) continue;
        question.robot = shortened(network_.name(node), longest_station_name);
        texts.push_back(link_gaps_text(question, gaps));
    }
    if (moved > most_texts) texts.push_back(fmt::format("and {} more robots", moved - most_texts));
    return texts;
}

std::string MarginSurvey::partner_names() const {
    return fmt::format("{}{}", fmt::join(names(network_, partners_), " or "),
                       relays_.empty() ? "" : ", also over relays");
}

bool MarginSurvey::has_margins() const {
    const Stations& stations = network_.medium().stations();
    for (NodeId node{0}; node.index() < robots_.size(); ++node.value) {
        if (range_of(stations.model(node))) return false;
    }
    return true;
}

}  // namespace rovernet
