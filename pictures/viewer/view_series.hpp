// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"
#include "sim/record.hpp"
#include "sim/sink.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace rovernet {

class ViewFile;

/// Sink that collects series over the time of a run for the charts of the viewer's page: delivery
/// ratio, latency, receptions by outcome, use of the channel, and the topology if the records
/// contain links. The time of the run is divided into at most 300 equal bins; a series has a
/// value for each bin (docs/formats/view-format.md).
///
/// Memory: 16 bytes for each message in use, and for each link that is up; about 50 kB for the
/// bins.
class ViewSeries {
  public:
    /// @param end         end of the run
    /// @param with_links  whether the sink wants link changes, which a network must search for
    explicit ViewSeries(Time end, bool with_links = true);

    KindMask kinds() const {
        const KindMask frames = kind_of<Sent>() | kind_of<AirSent>() | kind_of<Received>() |
                                kind_of<ControlReceived>() | kind_of<Dropped>();
        const KindMask topology = kind_of<Moved>() | kind_of<Switched>() | kind_links;
        return with_links_ ? frames | topology : frames;
    }
    void on(const Record& record, const RecordContext& context);

    /// Writes the columns `series.N`, and the entry `series` of the head, after all records.
    void write(ViewFile& file, Table& head);
    /// Series of a run that has not ended, for the bins that lie before `now`. The elements have
    /// the form of the entries of `series`, with the additional key `values`; a missing value is
    /// null. @param now  present time of the run
    Array table(Time now);

  private:
    using Numbers = std::vector<double>;
    /// Series, and its name in the head.
    struct Series {
        const char *chart, *name, *unit;
        Numbers values;
        std::optional<std::size_t> outcome = {};

        Table entry(std::int64_t width) const;
    };
    /// Message that occupies a slot of the message table, and the number of its destinations
    /// (`others`).
    struct Expected {
        std::uint64_t uid = ~std::uint64_t{0};
        std::uint32_t others = 0;
    };

    std::size_t bin_of(std::int64_t t) const;
    double bin_end(std::size_t bin) const;
    double length(std::size_t bin) const;
    void take(const Received& received, const RecordContext& context);
    void take(const Dropped& dropped, const RecordContext& context);
    void take(const AirSent& sent);
    void count(const Reception& reception);
    void sample_topology_until(Time t);
    std::uint64_t components() const;
    std::vector<Series> list() const;
    void add_deliveries(std::vector<Series>& list) const;
    void add_receptions(std::vector<Series>& list) const;

    std::int64_t end_, width_;  // [ns] end of the run, width of a bin
    std::size_t bins_;
    std::vector<Expected> expected_of_;  // expected deliveries of each message, by MessageId
    Numbers expected_, deliveries_;      // numbers of expected and of actual deliveries in each bin
    Numbers latency_sum_, latency_most_;         // sum and maximum of the latencies in each bin [s]
    std::map<std::size_t, Numbers> receptions_;  // number of receptions in each bin, by outcome
    Numbers busy_;                               // time with a frame on air in each bin [ns]
    std::int64_t busy_until_ = 0;                // end of the last frame so far [ns]
    std::set<std::pair<NodeId, NodeId>> links_;  // links that are up
    std::vector<bool> is_on_;                    // flag of each robot, by NodeId: the robot is on
    bool links_known_ = false, has_changed_ = true;
    std::uint64_t components_ = 0;
    Numbers degree_, parts_;  // topology at the end of each bin
    bool with_links_;
};

}  // namespace rovernet
