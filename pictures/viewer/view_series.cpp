// SPDX-License-Identifier: MIT
#include "pictures/viewer/view_series.hpp"

#include "pictures/viewer/column.hpp"
#include "pictures/viewer/view_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <variant>

namespace rovernet {
namespace {

constexpr std::int64_t most_bins = 300;
constexpr double none = std::numeric_limits<double>::quiet_NaN();  // a bin without a value

double ratio(double part, double whole) { return whole > 0 ? part / whole : none; }

}  // namespace

ViewSeries::ViewSeries(Time end, bool with_links)
    : end_(std::max<std::int64_t>(1, whole_ns(end))),
      width_((end_ + most_bins - 1) / most_bins),
      bins_(static_cast<std::size_t>((end_ + width_ - 1) / width_)),
      expected_(bins_),
      deliveries_(bins_),
      latency_sum_(bins_),
      latency_most_(bins_, none),
      busy_(bins_),
      with_links_(with_links) {}

std::size_t ViewSeries::bin_of(std::int64_t t) const {
    return std::min(static_cast<std::size_t>(std::max<std::int64_t>(t, 0) / width_), bins_ - 1);
}

/// End [ns] of a bin; the last one ends with the run.
double ViewSeries::bin_end(std::size_t bin) const {
    return static_cast<double>(std::min(end_, static_cast<std::int64_t>(bin + 1) * width_));
}

/// Length [ns] of a bin.
double ViewSeries::length(std::size_t bin) const {
    return bin_end(bin) - (bin > 0 ? bin_end(bin - 1) : 0);
}

void ViewSeries::on(const Record& record, const RecordContext& context) {
    if (const auto* received = std::get_if<Received>(&record)) return take(*received, context);
    if (const auto* dropped = std::get_if<Dropped>(&record)) return take(*dropped, context);
    if (const auto* air = std::get_if<AirSent>(&record)) return take(*air);
    if (const auto* control = std::get_if<ControlReceived>(&record)) {
        count(control->reception);
    } else if (const auto* sent = std::get_if<Sent>(&record)) {
        const std::size_t slot = sent->message.index();
        if (slot >= expected_of_.size()) expected_of_.resize(slot + 1);
        const std::uint32_t others = std::max(sent->robots, 1U) - 1;
        expected_of_[slot] = {context.messages[sent->message].uid, others};
        expected_[bin_of(whole_ns(sent->time))] += others;
    } else if (const auto* up = std::get_if<LinkUp>(&record)) {
        sample_topology_until(up->time);
        links_known_ = has_changed_ = true;
        links_.emplace(up->from, up->to);
    } else if (const auto* down = std::get_if<LinkDown>(&record)) {
        sample_topology_until(down->time);
        links_known_ = has_changed_ = true;
        links_.erase({down->from, down->to});
    } else if (const auto* moved = std::get_if<Moved>(&record)) {
        const std::size_t robot = moved->node.index();
        if (robot < is_on_.size()) return;
        sample_topology_until(moved->time);
        is_on_.resize(robot + 1, true);
        has_changed_ = true;
    } else if (const auto* switched = std::get_if<Switched>(&record)) {
        sample_topology_until(switched->time);
        const std::size_t robot = switched->node.index();
        if (robot >= is_on_.size()) is_on_.resize(robot + 1, true);
        is_on_[robot] = switched->on;
        has_changed_ = true;
    }
}

void ViewSeries::count(const Reception& reception) {
    const std::size_t outcome =
        2 * static_cast<std::size_t>(reception.fate) + (reception.delivered ? 1 : 0);
    Numbers& counts = receptions_[outcome];
    counts.resize(bins_);
    ++counts[bin_of(whole_ns(reception.time))];
}

/// Counts receptions, and deliveries as Metrics does.
void ViewSeries::take(const Received& received, const RecordContext& context) {
    const Message& message = context.messages[received.frame.message];
    for (const Reception& rx : received.receptions) {
        count(rx);
        if (!rx.delivered || !message.kind.empty()) continue;
        const std::size_t bin = bin_of(whole_ns(rx.time));
        const double latency = seconds(rx.time - message.created);
        ++deliveries_[bin];
        latency_sum_[bin] += latency;
        if (!(latency_most_[bin] >= latency)) latency_most_[bin] = latency;
    }
}

/// A message that the end of the run cut off counts as never sent.
void ViewSeries::take(const Dropped& dropped, const RecordContext& context) {
    if (dropped.protocol_decides || dropped.reason != DropReason::cut_off) return;
    const MessageId id = dropped.frame.message;
    if (id.index() >= expected_of_.size()) return;
    const Expected& expected = expected_of_[id.index()];
    if (expected.uid != context.messages[id].uid) return;
    expected_[bin_of(whole_ns(dropped.time))] -= expected.others;
}

/// Adds the time of a frame during which no earlier frame is on air.
void ViewSeries::take(const AirSent& sent) {
    const std::int64_t start = whole_ns(sent.time);
    std::int64_t from = std::max(start, busy_until_);
    const std::int64_t until = std::min(end_, start + sent.airtime.count());
    busy_until_ = std::max(busy_until_, until);
    while (from < until) {
        const std::size_t bin = bin_of(from);
        const std::int64_t part = std::min(until, static_cast<std::int64_t>(bin_end(bin)));
        busy_[bin] += static_cast<double>(part - from);
        from = part;
    }
}

/// Takes the topology at the end of all bins that end before `t`.
void ViewSeries::sample_topology_until(Time t) {
    while (degree_.size() < bins_ && bin_end(degree_.size()) < static_cast<double>(whole_ns(t))) {
        if (std::exchange(has_changed_, false)) components_ = components();
        const auto on = static_cast<double>(std::count(is_on_.begin(), is_on_.end(), true));
        degree_.push_back(ratio(static_cast<double>(links_.size()), on));
        parts_.push_back(static_cast<double>(components_));
    }
}

/// Number of connected components of the robots that are on: their number, minus one for every
/// link that joins two components.
std::uint64_t ViewSeries::components() const {
    std::vector<std::uint32_t> part(is_on_.size());
    std::iota(part.begin(), part.end(), 0U);
    const auto root = [&](std::uint32_t i) {
        while (part[i] != i) i = part[i] = part[part[i]];
        return i;
    };
    auto count = static_cast<std::uint64_t>(std::count(is_on_.begin(), is_on_.end(), true));
    for (const auto& [from, to] : links_) {
        if (std::max(from, to).index() >= part.size()) continue;  // a damaged trace
        const std::uint32_t a = root(from.value), b = root(to.value);
        if (a == b) continue;
        part[a] = b;
        --count;
    }
    return count;
}

/// Entry of the series in the head.
Table ViewSeries::Series::entry(std::int64_t width) const {
    Table series;
    series.set("chart", chart);
    series.set("name", name);
    series.set("unit", unit);
    series.set("points", std::uint64_t{values.size()});
    series.set("width_ns", width);
    if (outcome) series.set("outcome", std::uint64_t{*outcome});
    return series;
}

void ViewSeries::add_deliveries(std::vector<Series>& list) const {
    Numbers so_far, mean;
    double expected = 0, deliveries = 0;
    for (std::size_t bin = 0; bin < bins_; ++bin) {
        expected += expected_[bin];
        deliveries += deliveries_[bin];
        so_far.push_back(ratio(deliveries, expected));
        mean.push_back(ratio(latency_sum_[bin], deliveries_[bin]));
    }
    if (expected > 0) list.push_back({"Delivery ratio", "so far", "", so_far});
    if (deliveries == 0) return;
    list.push_back({"Latency of deliveries", "mean", "s", mean});
    list.push_back({"Latency of deliveries", "largest", "s", latency_most_});
}

void ViewSeries::add_receptions(std::vector<Series>& list) const {
    for (const auto& [outcome, counts] : receptions_) {
        Numbers a_second;
        for (std::size_t bin = 0; bin < bins_; ++bin)
            a_second.push_back(1e9 * counts[bin] / length(bin));
        list.push_back({"Receptions", "", "1/s", std::move(a_second), outcome});
    }
}

std::vector<ViewSeries::Series> ViewSeries::list() const {
    std::vector<Series> list;
    add_deliveries(list);
    add_receptions(list);
    if (busy_until_ > 0) {
        Numbers share;
        for (std::size_t bin = 0; bin < bins_; ++bin) share.push_back(busy_[bin] / length(bin));
        list.push_back({"Channel occupancy", "share of time", "", std::move(share)});
    }
    if (links_known_) {
        list.push_back({"Neighbours of a robot", "mean", "", degree_});
        list.push_back({"Parts of the network", "connected components", "", parts_});
    }
    return list;
}

void ViewSeries::write(ViewFile& file, Table& head) {
    sample_topology_until(never);
    Array entries;
    for (const Series& each : list()) {
        file.add(fmt::format("series.{}", entries.size()), each.values);
        entries.emplace_back(each.entry(width_));
    }
    head.set("series", std::move(entries));
}

Array ViewSeries::table(Time now) {
    const auto over = std::min(static_cast<std::size_t>(whole_ns(now) / width_), bins_);
    Array entries;
    for (Series& each : list()) {
        each.values.resize(std::min(each.values.size(), over));
        Array values;
        for (const double value : each.values)
            values.push_back(std::isnan(value) ? Value() : Value(value));
        Table entry = each.entry(width_);
        entry.set("values", std::move(values));
        entries.emplace_back(std::move(entry));
    }
    return entries;
}

}  // namespace rovernet
