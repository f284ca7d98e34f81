// SPDX-License-Identifier: MIT
#pragma once

#include "sim/record.hpp"
#include "sim/sink.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace rovernet {

/// Shape of the network while it was measured, whatever was sent. Nothing where nothing is to be
/// averaged over.
struct TopologyValues {
    /// Robots that hear a robot [-]: the mean over time and over the robots that are on.
    std::optional<double> degree_mean;
    /// Parts of the network that no link joins [-], of robots that are on: the mean of samples, one
    /// at the beginning and one each second.
    std::optional<double> components_mean;
    std::optional<double> speed_mean;  ///< [m/s] over time and over all robots, rests included
    /// Time [s] from when a robot begins to hear another one until it no longer does, over the
    /// links for which both were seen. Source: F. Bai et al., IMPORTANT, INFOCOM 2003 (link
    /// duration).
    std::optional<double> link_lifetime_mean;
    std::uint64_t links_ended = 0;  ///< number of links in that mean
};

/// Measures the topology from the records of links, legs and switches. Costs a search for every
/// link's changes (see kind_links) and 50 bytes or so for every link that is up.
class Topology {
  public:
    /// @param begin  it measures from then on
    explicit Topology(Time begin) : begin_(begin), now_(begin), next_sample_(begin) {}

    KindMask kinds() const { return kind_links | kind_of<Moved>() | kind_of<Switched>(); }
    void on(const Record& record, const RecordContext& context);

    /// Values of a run that has ended at `end`; asked for once.
    TopologyValues values(Time end);

  private:
    struct Robot {
        bool is_there = false;
        bool on = true;
        Time since = start_of_run, until = start_of_run;  // begin and end of its leg
        double speed = 0;                                 // [m/s] on it
    };

    void advance(Time t);
    void sample();
    void end_leg(Robot& robot, Time t);
    Robot& robot(NodeId node);

    Time begin_, now_, next_sample_;
    std::vector<Robot> robots_;
    std::size_t there_ = 0, on_ = 0;
    std::map<std::pair<NodeId, NodeId>, Time> up_;  // since when
    double link_s_ = 0, on_s_ = 0, robot_s_ = 0;    // [s] sums over links, robots on, robots
    double way_ = 0;                                // [m] of all robots
    std::uint64_t samples_ = 0, components_ = 0;
    double lifetime_ = 0;  // [s] sum
    std::uint64_t ended_ = 0;
};

}  // namespace rovernet
