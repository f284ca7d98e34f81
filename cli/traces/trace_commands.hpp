// SPDX-License-Identifier: MIT
#pragma once

#include "cli/terminal/commands.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// Commands that read traces: trace with its subcommands, replay and view.
namespace rovernet::cli {

struct TraceStatsArguments {
    std::string file;
    std::string by;  ///< grouping of the statistics: robot, flow or second; empty: totals
    bool strict = false, csv = false, json = false;
};
void trace_stats(const TraceStatsArguments& arguments);

struct TraceConvertArguments {
    std::string in, out, to;
    bool mac = false, strict = false;
};
void trace_convert(const TraceConvertArguments& arguments);

struct TraceCutArguments {
    std::string in, out;
    std::optional<std::string> from, to;
    std::optional<std::uint32_t> robot;
    std::optional<std::uint64_t> message;
    bool strict = false;
};
void trace_cut(const TraceCutArguments& arguments);

struct TraceDiffArguments {
    std::string a, b;
    std::string time_tolerance = "0 s";
    bool strict = false;
};
void trace_diff(const TraceDiffArguments& arguments);

struct TraceFollowArguments {
    std::string file;
    std::uint64_t message = 0;
    std::optional<std::string> robot;
    bool strict = false, json = false;
};
void trace_follow(const TraceFollowArguments& arguments);

struct ReplayArguments {
    std::string file;
    bool verify = false;
    /// Radios with which the recorded run is simulated again. Each element is a setting
    /// "path=value", or several settings separated by ";".
    std::vector<std::string> with;
    std::optional<std::string> map;  ///< map file to use instead of the recorded map
    std::optional<double> speed;
    // Options for an ns-2 trace:
    // - `as`: settings like an element of `with`; the radio with which all others are compared
    // - `routing`: routing of the messages, "flood" or "direct"
    // - `movements`: path of the robots' movement file
    std::optional<std::string> as, routing, movements;
    std::optional<std::string> store;
    bool json = false;
};
void replay(const ReplayArguments& arguments);

struct ViewArguments {
    std::string file;
    std::optional<std::string> other;  ///< second run, shown beside the first
    /// Settings "path=value", or several of them separated by ";", with which the run is simulated
    /// again as the second one.
    std::vector<std::string> with;
    std::optional<std::string> movements;  ///< movement file of the robots of an ns-2 trace
    std::optional<std::string> out;        ///< file of the page; none: the page is served
    std::string address = "127.0.0.1:0";
    std::optional<std::string> listen, from, to, limit;
    bool no_payloads = false, no_map = false;
    bool opens = false;  ///< whether the page is opened in a browser
};
void view(const ViewArguments& arguments);

}  // namespace rovernet::cli
