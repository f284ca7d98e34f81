// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/playing.hpp"
#include "network/network.hpp"
#include "scenario/document/value.hpp"
#include "scenario/scenario.hpp"
#include "sim/geometry.hpp"
#include "sim/leg.hpp"
#include "sim/record.hpp"
#include "sim/sink.hpp"
#include "sim/time.hpp"

#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace rovernet {

/// Stretch of a robot's path on which it has no link to any of its partners.
struct LinkGap {
    Time begin, end;
    Vec3 from, to;    ///< positions of the robot at the start and at the end [m]
    double path = 0;  ///< length of the robot's path in the gap [m]

    Duration length() const { return end - begin; }
};

/// Gaps in a robot's connection to its partners during a run: times without a link to any partner.
struct LinkGaps {
    Duration present{0};             ///< time for which the robot takes part in the run, on or off
    double path = 0;                 ///< length of the robot's path [m]
    std::vector<LinkGap> gaps = {};  ///< gaps in the order of time; they do not touch

    Duration lost() const;      ///< sum of the gaps' lengths
    double lost_path() const;   ///< sum of the gaps' paths [m]
    double lost_share() const;  ///< lost() / present [-]; 0 if `present` is 0
};

/// Sink that finds the gaps in a robot's link to its partners.
///
/// The robot has a link to a partner while both receive each other's frames. Changes of links are
/// taken from the records LinkUp and LinkDown.
class LinkGapFinder {
  public:
    /// @param network   network of the run; outlives the finder
    /// @param partners  robots such as access points; a link to any one of them is enough
    /// @param relays    robots over which the connection may go, in any number of hops; each hop
    ///                  must be a link in both directions. Empty: direct links only
    LinkGapFinder(const Network& network, NodeId robot, std::vector<NodeId> partners,
                  std::vector<NodeId> relays);

    KindMask kinds() const { return kind_links | kind_of<Moved>() | kind_of<Switched>(); }
    void on(const Record& record, const RecordContext& context);

    /// Gaps until the time `end`, which no later record may precede.
    const LinkGaps& gaps(Time end);

  private:
    /// Accounts for the time from the last change until `t`, during which nothing has changed.
    void advance(Time t);
    bool is_linked() const;
    bool matters(NodeId a, NodeId b) const;
    bool both_hear(NodeId a, NodeId b) const {
        return up_.contains({a, b}) && up_.contains({b, a});
    }

    const Network& network_;
    NodeId robot_;
    std::vector<NodeId> partners_, relays_;
    bool is_there_;  // whether the robot is present
    Time now_ = start_of_run;
    std::optional<Leg> leg_ = std::nullopt;        // the robot's leg
    std::set<std::pair<NodeId, NodeId>> up_ = {};  // links that are up, between robot, partners and
                                                   // relays
    LinkGaps gaps_ = {};
};

/// Arguments of link_gaps(): names of the robot, its partners and the relays.
struct LinkGapsQuestion {
    std::string robot;
    std::vector<std::string> partners;
    std::vector<std::string> relays = {};
};

/// Looks up robots of a network by name. Each name must be listed once, and must not be the name of
/// `robot`.
/// @param option  name of the option that lists the names, for errors
/// @throws InputError for a robot that is listed twice or is `robot`; std::invalid_argument for an
///         unknown name
std::vector<NodeId> partners_named(const Network& network, const std::vector<std::string>& names,
                                   const std::optional<NodeId>& robot, const std::string& option);

/// Runs the scenario to its end and finds the gaps.
LinkGaps link_gaps(const Scenario& scenario, const LinkGapsQuestion& question,
                   const TellTime& tell = {});

/// Sentence on the gaps: "R1 has no link to ap1: 98.400 s of 227 s (43.3 %), ...".
std::string link_gaps_text(const LinkGapsQuestion& question, const LinkGaps& gaps);
/// Header line of the CSV output, for the lines of link_gaps_csv().
inline constexpr const char* link_gaps_csv_head =
    "begin_s,end_s,path_m,begin_x_m,begin_y_m,begin_z_m,end_x_m,end_y_m,end_z_m\n";
/// Gaps as CSV lines, one for each gap.
std::string link_gaps_csv(const LinkGaps& gaps);
/// Gaps as a document: {"robot", "to", "over", "present_s", "lost_s", ..., "gaps": [...]}.
Table link_gaps_document(const LinkGapsQuestion& question, const LinkGaps& gaps);

}  // namespace rovernet
