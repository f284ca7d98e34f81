// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fields.hpp"
#include "sim/record.hpp"
#include "sim/sink.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace rovernet {

/// Topology metrics of the network, averaged from the start of the measurement on,
/// independent of traffic. Values without data are empty.
struct TopologyValues {
    /// Node degree [-]: number of robots that a robot hears, mean over time and over the robots
    /// that are on.
    std::optional<double> degree_mean;
    /// Number of connected components of the robots that are on [-]: mean of samples, one at the
    /// beginning and one each second.
    std::optional<double> components_mean;
    std::optional<double> speed_mean;  ///< mean speed [m/s] over time, with rests, and all robots
    /// Mean link lifetime [s]: time from the start to the end of a link, averaged over the links
    /// whose start and end were observed. Source: F. Bai et al., IMPORTANT, INFOCOM 2003 (link
    /// duration).
    std::optional<double> link_lifetime_mean;
    std::uint64_t links_ended = 0;  ///< number of links over which link_lifetime_mean is averaged

    static constexpr auto fields() {
        using T = TopologyValues;
        return describe(
            field("degree_mean", &T::degree_mean, "mean number of robots that a robot hears"),
            field("components_mean", &T::components_mean,
                  "mean number of connected components of the network"),
            field("speed_mean_m_s", &T::speed_mean, "mean speed of the robots"),
            field("link_lifetime_mean_s", &T::link_lifetime_mean, "mean lifetime of a link"),
            field("links_ended", &T::links_ended,
                  "number of links over which the mean lifetime is computed"));
    }
};

/// Sink that measures the topology from the records of links, of legs, and of robots switched on
/// and off. Cost: a search for the times of all link changes (see kind_links), and about 50 bytes
/// for every link that is up.
class Topology {
  public:
    /// @param begin  simulated time at which the measurement starts
    explicit Topology(Time begin) : begin_(begin), now_(begin), next_sample_(begin) {}

    KindMask kinds() const { return kind_links | kind_of<Moved>() | kind_of<Switched>(); }
    void on(const Record& record, const RecordContext& context);

    /// Values of a run that has ended at `end`; call only once.
    TopologyValues values(Time end);

  private:
    struct Robot {
        bool is_there = false;
        bool on = true;
        Time since = start_of_run, until = start_of_run;  // start and end of the current leg
        double speed = 0;                                 // speed during the leg [m/s]
    };

    void advance(Time t);
    void sample();
    void end_leg(Robot& robot, Time t);
    Robot& robot(NodeId node);

    Time begin_, now_, next_sample_;
    std::vector<Robot> robots_;
    std::size_t there_ = 0, on_ = 0;
    std::map<std::pair<NodeId, NodeId>, Time> up_;  // start times of links that are up
    // Sums [s] of the times of links that were up, of robots that were on, and of all robots.
    double link_s_ = 0, on_s_ = 0, robot_s_ = 0;
    double way_ = 0;  // sum of the lengths of all robots' paths [m]
    std::uint64_t samples_ = 0, components_ = 0;
    double lifetime_ = 0;  // sum of the lifetimes of links that have ended [s]
    std::uint64_t ended_ = 0;
};

}  // namespace rovernet
