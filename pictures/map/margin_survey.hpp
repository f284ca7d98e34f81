// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/reports/link_gaps.hpp"
#include "network/network.hpp"
#include "sim/ids.hpp"
#include "sim/time.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// Piece of a robot's path on which its link has one grade, or on which it has no link.
struct MarginPiece {
    Time begin, end;
    std::optional<std::size_t> grade;  ///< index in link_grades; none: no link
};

/// Survey of link margins during a run. Each robot is surveyed for its best link to one of the
/// given partners, such as access points.
///
/// The margin of a link is the smaller margin of both directions, without fading. If a link goes
/// over relays, its margin is the margin of the weakest hop on the best path. Margins are sampled
/// at equal intervals, at least 1000 times. The begin and the end of a gap are exact: see
/// LinkGapFinder.
class MarginSurvey {
  public:
    /// @param network  network before its run, with all robots; outlives the survey
    /// @param relays   robots over which links may go; empty: direct links only
    MarginSurvey(Network& network, std::vector<NodeId> partners, std::vector<NodeId> relays);

    /// Runs the network until the time `end`. Call once.
    void run_until(Time end);

    /// Whether the robot is a partner or a relay, whose own links are not surveyed.
    bool is_station(NodeId node) const { return robots_[node.index()].finder == nullptr; }
    /// Pieces of a robot's path in the order of time; empty for a partner or a relay.
    std::vector<MarginPiece> pieces(NodeId node) const;
    /// Sentences on the gaps of robots that moved, for at most three robots.
    std::vector<std::string> gap_texts() const;
    /// Names of the partners: "ap1 or ap2", ", also over relays" if there are relays.
    std::string partner_names() const;
    /// Whether links have margins; the propagation model disc gives only a range.
    bool has_margins() const;

  private:
    struct Robot {
        std::shared_ptr<LinkGapFinder> finder = nullptr;  // null for a partner or relay
        std::vector<double> margins = {};                 // margin at each sample [dB]
        std::optional<Vec3> sampled_at = std::nullopt;    // position at the last sample [m]
        LinkGaps gaps = {};
    };

    /// Smaller margin of both directions of a link now [dB].
    double margin(NodeId a, NodeId b) const;
    void sample_stations();
    void sample(NodeId node);

    /// Partner or relay, with the margin of its own link to a partner now [dB].
    struct Station {
        NodeId node;
        double margin;
    };

    Network& network_;
    std::vector<NodeId> partners_, relays_;
    std::vector<Station> stations_ = {};
    std::vector<Robot> robots_;
    std::vector<Time> times_ = {};  // times of samples
};

}  // namespace rovernet
