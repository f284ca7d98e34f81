// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/movement_table.hpp"
#include "experiment/propagation_table.hpp"
#include "experiment/reader.hpp"
#include "experiment/robot_table.hpp"
#include "experiment/scene_table.hpp"
#include "experiment/value.hpp"
#include "models/access_rung.hpp"
#include "models/link_changes.hpp"
#include "models/radio.hpp"
#include "models/reception.hpp"
#include "routing/flood.hpp"
#include "sim/fields.hpp"
#include "sim/geometry.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

// A scenario file as plain structs: every table and key has one struct and field of the same name.

namespace rovernet {

/// [scenario]
struct ScenarioTable {
    std::string name = "run";
    Duration duration = std::chrono::seconds{60};
    std::uint64_t seed = 1;
    std::uint64_t replication = 0;
    std::uint64_t event_limit = 100'000'000;

    static constexpr auto fields() {
        constexpr Range thirty_two_bits{
            .low = 0, .high = 4294967295, .text = "from 0 to 4294967295"};
        return describe(field("name", &ScenarioTable::name, "of the run and its output folder"),
                        field("duration", &ScenarioTable::duration, positive, "simulated time"),
                        field("seed", &ScenarioTable::seed, "of every random draw"),
                        field("replication", &ScenarioTable::replication, thirty_two_bits,
                              "which of the independent repetitions of the scenario"),
                        field("event_limit", &ScenarioTable::event_limit, positive,
                              "a run that needs more events fails"));
    }
};

/// [medium]
struct MediumTable {
    bool propagation_delay = true;

    static constexpr auto fields() {
        return describe(field("propagation_delay", &MediumTable::propagation_delay,
                              "frames travel at the speed of light, not at once"));
    }
};

/// [links]: how link changes are looked for
struct LinksTable {
    Duration tolerance = LinkSearch{}.tolerance;
    Duration min_dwell = LinkSearch{}.min_dwell;

    static constexpr auto fields() {
        constexpr Range step{.low = 1e-9, .high = 1e6, .text = "from 1 ns to 1e6 s"};
        constexpr Range dwell{.low = 1e-6, .high = 1e6, .text = "from 1 us to 1e6 s"};
        return describe(field("tolerance", &LinksTable::tolerance, step,
                              "a link change behind walls is known to this"),
                        field("min_dwell", &LinksTable::min_dwell, dwell,
                              "of models of unknown shape: shorter states of a link are missed"));
    }
};

/// How a frame is received.
enum class ReceptionModel { threshold, collision, sinr };
template <>
struct EnumNames<ReceptionModel> {
    static constexpr std::array<std::string_view, 3> values = {"threshold", "collision", "sinr"};
};

/// [reception]
struct ReceptionTable {
    ReceptionModel model = ReceptionModel::threshold;
    Db capture_ratio = Collision{}.capture_ratio;
    CaptureOrder capture = Collision{}.capture;
    Db interference_cut = Sinr{}.interference_cut;

    static constexpr auto fields() {
        return describe(
            field("model", &ReceptionTable::model,
                  "threshold: by the link budget alone; collision: frames that overlap are lost; "
                  "sinr: by errors in the bits"),
            field("capture_ratio", &ReceptionTable::capture_ratio, positive,
                  "how much stronger a frame is that survives another"),
            field("capture", &ReceptionTable::capture,
                  "which of two frames may survive: the first, or also the later one"),
            field("interference_cut", &ReceptionTable::interference_cut, non_negative,
                  "of sinr: weaker frames, below the noise floor by this, are left out"));
    }
    ReceptionRung make() const;
};

/// How robots get access to the medium.
enum class AccessModel { none, aloha, csma };
template <>
struct EnumNames<AccessModel> {
    static constexpr std::array<std::string_view, 3> values = {"none", "aloha", "csma"};
};

/// [access]: keys of csma that are not given are those of its standard.
struct AccessTable {
    AccessModel model = AccessModel::none;
    std::optional<Duration> slot = std::nullopt;
    int queue = 50;
    WifiStandard standard = WifiStandard::b;
    std::optional<Duration> sifs = std::nullopt, difs = std::nullopt, cca_time = std::nullopt,
                            turnaround = std::nullopt, rx_start_delay = std::nullopt;
    std::optional<int> cw_min = std::nullopt, cw_max = std::nullopt;
    std::optional<BitRate> basic_rate = std::nullopt;
    bool eifs = true;
    int short_retries = Csma{}.short_retries;
    int long_retries = Csma{}.long_retries;
    Bytes rts_threshold{Csma{}.rts_threshold};
    Bytes header{Csma{}.header};

    static constexpr auto fields() {
        constexpr Range counts{.low = 1, .high = 1000000, .text = "from 1 to 1000000"};
        constexpr Range window{.low = 0, .high = 65535, .text = "from 0 to 65535"};
        using A = AccessTable;
        return describe(
            field("model", &A::model, "none: at once; aloha: no listening; csma: 802.11 DCF"),
            field("slot", &A::slot, non_negative, "of csma's backoff, or of slotted aloha"),
            field("queue", &A::queue, counts, "frames that wait at a robot, at most"),
            field("standard", &A::standard, "of csma: its timing and airtimes"),
            field("sifs", &A::sifs, non_negative, "short interframe space"),
            field("difs", &A::difs, non_negative, "DCF interframe space"),
            field("cca_time", &A::cca_time, non_negative, "energy is sensed so long after it came"),
            field("turnaround", &A::turnaround, non_negative, "from deciding to send to sending"),
            field("rx_start_delay", &A::rx_start_delay, non_negative,
                  "until the beginning of an answer is noticed"),
            field("cw_min", &A::cw_min, window, "least contention window, in slots"),
            field("cw_max", &A::cw_max, window, "largest contention window, in slots"),
            field("basic_rate", &A::basic_rate, positive, "of broadcasts, RTS, CTS and ACK"),
            field("eifs", &A::eifs, "wait longer after a frame with errors"),
            field("short_retries", &A::short_retries, non_negative, "attempts; 0: no end"),
            field("long_retries", &A::long_retries, non_negative, "behind an RTS; 0: no end"),
            field("rts_threshold", &A::rts_threshold, "larger unicasts ask with an RTS first"),
            field("header", &A::header, "that access adds to a message"));
    }
    AccessRung make() const;
};

/// Routing protocols by name.
enum class Protocol { flood };
template <>
struct EnumNames<Protocol> {
    static constexpr std::array<std::string_view, 1> values = {"flood"};
};

/// [routing]
struct RoutingTable {
    Protocol protocol = Protocol::flood;
    Flood flood;
};

/// What traffic is made of.
enum class TrafficKind { broadcast, unicast };
template <>
struct EnumNames<TrafficKind> {
    static constexpr std::array<std::string_view, 2> values = {"broadcast", "unicast"};
};

/// [[traffic]]
struct TrafficTable {
    TrafficKind kind = TrafficKind::broadcast;
    std::string from;
    std::optional<std::string> to;  ///< of a unicast
    bool saturate = false;          ///< there is always a message to send
    std::string payload;
    std::optional<Bytes> size;
    std::optional<Duration> start;  ///< none: when `from` arrives at the end of its movement
    std::optional<Duration> every;
    std::optional<Duration> stop;
    std::optional<int> count;
    Location from_where = {}, to_where = {};
};

/// [trace]
enum class Ns2Choice { none, old_format, new_format };
template <>
struct EnumNames<Ns2Choice> {
    static constexpr std::array<std::string_view, 3> values = {"none", "old", "new"};
};
struct TraceTable {
    Ns2Choice ns2 = Ns2Choice::none;

    static constexpr auto fields() {
        return describe(field("ns2", &TraceTable::ns2, "wireless trace format of ns-2.35"));
    }
};

/// [study]: read and checked here, run by studies.
struct StudyTable {
    int replications = 1;
    Table vary;  ///< key path -> list of values

    static constexpr auto fields() {
        return describe(field("replications", &StudyTable::replications,
                              Range{.low = 1, .text = ">= 1"}, "independent repetitions"));
    }
};

/// A whole scenario with every default filled in.
struct Scenario {
    std::string file;  ///< as the user named it; maps are relative to it
    ScenarioTable scenario;
    SceneTable scene;
    std::shared_ptr<const Scene> world_walls;  ///< if the scene is a Stage world with walls
    Radio radio;
    MediumTable medium;
    PropagationTable propagation;
    Location propagation_where;
    ReceptionTable reception;
    AccessTable access;
    LinksTable links;
    MovementTable movement;
    std::vector<RobotTable> robots;
    RoutingTable routing;
    std::vector<TrafficTable> traffic;
    TraceTable trace;
    StudyTable study;
    std::vector<std::string> notices;  ///< what a person should know of the files read
};

/// Reads a scenario from its document. @throws InputError at the first mistake
Scenario read_scenario(const Value& document, const std::string& file);

/// Reads [propagation] or a robot's own over `out`. @throws InputError at the first mistake
void read_propagation(const Value& value, PropagationTable& out);
/// The reverse: the chosen model's parameters, and those of others that differ from their defaults.
Table propagation_document(const PropagationTable& propagation);

/// What the command line says over a scenario file.
struct ScenarioOptions {
    std::vector<std::string> set = {};         ///< "path=value"
    std::vector<std::string> world_path = {};  ///< folders, relative to where we are
    std::vector<std::string> bitmaps = {};     ///< "OLD=NEW"
    bool lenient = false;
};

/// Reads a scenario file, or a Stage world (NAME.world) as a scenario of its own.
Scenario load_scenario(const std::string& path, const ScenarioOptions& options);

/// The scenario as a document with every default; it reads back as the same scenario.
Table to_document(const Scenario& scenario);

}  // namespace rovernet
