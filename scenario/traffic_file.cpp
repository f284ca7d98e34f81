// SPDX-License-Identifier: MIT
#include "scenario/traffic_file.hpp"

#include "files/text_source.hpp"
#include "files/word.hpp"
#include "scenario/document/located.hpp"
#include "scenario/tables/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <map>
#include <string_view>
#include <utility>

namespace rovernet {
namespace {

/// The words of a line, without its brackets, quotes and comment.
std::vector<Word> words_of(std::string_view line) {
    constexpr std::string_view between = " \t\r;[]\"{}";
    if (const auto first = line.find_first_not_of(" \t");
        first != line.npos && line[first] == '#') {
        return {};
    }
    line = line.substr(0, line.find(";#"));
    std::vector<Word> words;
    for (std::size_t at = 0; (at = line.find_first_not_of(between, at)) != line.npos;) {
        const std::size_t end = std::min(line.find_first_of(between, at), line.size());
        words.push_back({line.substr(at, end - at), static_cast<int>(at) + 1});
        at = end;
    }
    return words;
}

/// Adds a flow of messages of `size` bytes, which leave as packets of at most `largest` bytes: as
/// many as fit, and one with the rest (ns-2.35, apps/udp.cc, UdpAgent::sendmsg). Packets after the
/// first one are flows of their own.
void add_packets(const TrafficTable& flow, std::uint32_t size, std::uint32_t largest,
                 TrafficFile& file) {
    do {
        TrafficTable& packet = file.flows.emplace_back(flow);
        packet.size = Bytes{std::min(size, largest)};
        size -= std::min(size, largest);
    } while (size > 0);
}

class TrafficReader {
  public:
    explicit TrafficReader(const std::string& path)
        : lines_(TextSource(path, TextSource::Reads::once)) {}

    TrafficFile read() {
        while (const auto line = lines_.next()) {
            words_ = words_of(*line);
            if (!words_.empty()) command();
        }
        TrafficFile file;
        for (const std::string& name : order_) add_flow(apps_.find(name)->second, file);
        if (random_ > 0) {
            file.notices.push_back(fmt::format(
                "{}: the setting random_ of {} flow{} is ignored: ns-2 makes each interval up to "
                "50 % longer or shorter, but rovernet makes all intervals equal",
                lines_.where().source, random_, random_ == 1 ? "" : "s"));
        }
        if (left_out_ > 0) {
            file.notices.push_back(fmt::format(
                "{}: this line about an agent is left out{}; the only setting of "
                "agents that is read is packetSize_",
                first_left_out_.text(),
                left_out_ > 1 ? fmt::format(", and {} more like this", left_out_ - 1) : ""));
        }
        return file;
    }

  private:
    /// Agent of ns-2, which sends or receives on a node.
    struct Agent {
        bool sends = false;
        std::optional<std::uint32_t> node = std::nullopt;
        std::string peer = {};
        Location where = {};        // of its node
        std::uint32_t size = 1000;  // [bytes] of the largest packet, by default as in ns-2.35
    };
    /// Application of ns-2, which makes an agent send; the defaults are those of ns-2.35.
    struct App {
        std::uint32_t size = 210;  // [bytes]
        double rate = 448e3;       // [bit/s]
        std::optional<double> interval = std::nullopt;
        double most = 268435456;
        std::string agent = {};
        std::optional<Time> start = std::nullopt, stop = std::nullopt;
        Location where = {};
    };

    Word word(std::size_t i) const {
        return i < words_.size() ? words_[i] : Word{{}, words_.back().column};
    }
    Location here(const Word& word) const {
        Location where = lines_.where();
        where.column = word.column;
        return where;
    }
    [[noreturn]] void fail(const Word& word, std::string_view expected) const {
        fail_at(lines_.where(), word, expected);
    }
    double amount(const Word& word, double least, std::string_view expected) const {
        const double v = any_number(word, lines_.where(), expected);
        if (v < least || v > 1e9) fail(word, expected);
        return v;
    }
    /// Value of a number with a suffix: the number times the factor of its suffix; 0 if the word is
    /// no number, or the list has no such suffix.
    static double with_suffix(const Word& word,
                              std::initializer_list<std::pair<std::string_view, double>> factors) {
        double v = 0;
        const char* const end = word.text.data() + word.text.size();
        const auto [unit, error] = std::from_chars(word.text.data(), end, v);
        const std::string_view rest(unit, static_cast<std::size_t>(end - unit));
        const auto found = std::find_if(factors.begin(), factors.end(),
                                        [&](const auto& each) { return each.first == rest; });
        return error == std::errc{} && found != factors.end() ? v * found->second : 0;
    }
    /// Bit rate [bit/s] such as "64k", "0.5Mb" or 64000; with B, a rate of bytes.
    double rate(const Word& word) const {
        std::string_view text = word.text;
        for (const std::string_view ending : {"ps", "/s"})
            if (text.ends_with(ending)) text.remove_suffix(ending.size());
        const double v = with_suffix(
            {text, word.column}, {{"", 1},     {"b", 1},    {"k", 1e3},  {"kb", 1e3}, {"K", 1e3},
                                  {"Kb", 1e3}, {"m", 1e6},  {"mb", 1e6}, {"M", 1e6},  {"Mb", 1e6},
                                  {"g", 1e9},  {"gb", 1e9}, {"G", 1e9},  {"Gb", 1e9}, {"kB", 8e3},
                                  {"KB", 8e3}, {"mB", 8e6}, {"MB", 8e6}, {"gB", 8e9}, {"GB", 8e9}});
        if (!(v >= 1 && v <= 1e12))
            fail(word, "a bit rate such as 64k or 0.5Mb, or with B for bytes: 8kB");
        return v;
    }
    /// Interval [s] such as 0.25 or "250ms".
    double interval(const Word& word) const {
        const double v =
            with_suffix(word, {{"", 1}, {"s", 1}, {"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}});
        if (!(v >= 1e-9 && v <= 1e9))
            fail(word, "a time from 1e-9 to 1e9 [s], such as 0.25 or 250ms");
        return v;
    }
    std::uint32_t size(const Word& word, std::uint32_t least) const;
    std::string reference(const Word& word) const {
        if (!word.text.starts_with('$')) fail(word, "a name with $ before it");
        return std::string(word.text.substr(1));
    }
    template <class Map>
    auto& named(Map& map, const Word& word, std::string_view what) {
        const auto found = map.find(reference(word));
        if (found == map.end()) fail(word, what);
        return found->second;
    }

    void command();
    void make();
    void tell_simulator();
    void schedule();
    void tell(App& app);
    void tell(Agent& agent);
    void add_flow(const App& app, TrafficFile& file);

    TextLines lines_;
    std::vector<Word> words_;
    std::map<std::string, Agent, std::less<>> agents_;
    std::map<std::string, App, std::less<>> apps_;
    std::vector<std::string> order_;  // of the applications
    std::size_t random_ = 0;          // flows that ns-2 would make irregular
    std::size_t left_out_ = 0;        // lines about agents that change nothing here
    Location first_left_out_ = {};
};

void TrafficReader::command() {
    const Word first = word(0);
    if (first.text == "set") return make();
    if (first.text == "$ns_" || first.text == "$ns") return tell_simulator();
    if (first.text.starts_with("$god") || first.text == "puts") return;
    if (!first.text.starts_with('$')) fail(first, "set, $ns_ ..., $cbr_(0) ... or a comment (#)");
    const std::string name = reference(first);
    if (const auto app = apps_.find(name); app != apps_.end()) return tell(app->second);
    tell(named(agents_, first, "an agent or an application that an earlier line creates"));
}

/// Size of a packet [bytes], at least `least`.
std::uint32_t TrafficReader::size(const Word& word, std::uint32_t least) const {
    const std::string sizes = fmt::format(
        "a size in bytes from {} to {}, the content of a UDP packet", least, longest_message);
    const double bytes = amount(word, least, sizes);
    if (bytes > longest_message || bytes != std::floor(bytes)) fail(word, sizes);
    return static_cast<std::uint32_t>(bytes);
}

/// Command  $udp_(0) set packetSize_ 2000
void TrafficReader::tell(Agent& agent) {
    const std::string_view key = word(2).text;
    if (word(1).text == "set" && key == "packetSize_") {
        agent.size = size(word(3), 1);
    } else if (word(1).text != "set" || (key != "fid_" && key != "class_" && key != "prio_")) {
        if (left_out_++ == 0) first_left_out_ = here(word(0));
    }
}

/// Command  set NAME [new CLASS]
void TrafficReader::make() {
    constexpr std::string_view classes =
        "Agent/UDP, Agent/Null, Agent/LossMonitor or Application/Traffic/CBR";
    const std::string name(word(1).text);
    const Word kind = word(3);
    if (word(2).text != "new") fail(word(2), "[new ...]; TCP is not supported, only CBR over UDP");
    if (kind.text == "Application/Traffic/CBR") {
        order_.push_back(name);
        apps_[name].where = here(word(1));
    } else if (kind.text == "Agent/UDP") {
        agents_[name].sends = true;
    } else if (kind.text == "Agent/Null" || kind.text == "Agent/LossMonitor") {
        agents_[name].sends = false;
    } else {
        fail(kind, classes);
    }
}

void TrafficReader::tell_simulator() {
    const Word verb = word(1);
    if (verb.text == "at") return schedule();
    if (verb.text == "attach-agent") {
        Agent& agent = named(agents_, word(3), "an agent that an earlier line creates");
        agent.node = node_number(word(2), lines_.where());
        agent.where = here(word(2));
    } else if (verb.text == "connect") {
        named(agents_, word(2), "an agent that an earlier line creates").peer = reference(word(3));
        named(agents_, word(3), "an agent that an earlier line creates");
    } else {
        fail(verb, "attach-agent, connect or at");
    }
}

/// Command  $ns_ at TIME "$cbr_(0) start"
void TrafficReader::schedule() {
    const Time time = moment(word(2), lines_.where());
    if (word(3).text.starts_with("$god")) return;
    App& app = named(apps_, word(3), "an application that an earlier line creates");
    const Word verb = word(4);
    if (verb.text != "start" && verb.text != "stop") fail(verb, "start or stop");
    std::optional<Time>& at = verb.text == "start" ? app.start : app.stop;
    if (at) {
        throw InputError(here(verb),
                         fmt::format("found a second {} of this application; expected one start "
                                     "and at most one stop for each application",
                                     verb.text));
    }
    at = time;
}

/// Command  $cbr_(0) set KEY VALUE  or  $cbr_(0) attach-agent $udp_(0)
void TrafficReader::tell(App& app) {
    if (word(1).text == "attach-agent") {
        app.agent = reference(word(2));
        named(agents_, word(2), "an agent that an earlier line creates");
        return;
    }
    if (word(1).text != "set") fail(word(1), "set or attach-agent");
    const Word key = word(2), value = word(3);
    if (key.text == "packetSize_") {
        app.size = size(value, 0);
        if (app.size > 0 && app.rate > 0) app.interval.reset();  // ns-2 keeps the rate
    } else if (key.text == "interval_") {
        app.interval = interval(value);
        app.rate = 8 * app.size / *app.interval;
    } else if (key.text == "rate_") {
        app.rate = rate(value);
        app.interval.reset();
    } else if (key.text == "maxpkts_") {
        app.most = std::max(1.0, amount(value, -1, "a number of packets from -1 to 1e9"));
    } else if (key.text == "random_") {
        random_ += amount(value, 0, "0 or 1") != 0;
    } else {
        fail(key, "packetSize_, interval_, rate_, random_ or maxpkts_");
    }
}

void TrafficReader::add_flow(const App& app, TrafficFile& file) {
    const auto fault = [&](std::string_view what) {
        throw InputError(app.where, fmt::format("this application {}", what));
    };
    if (!app.start) return;
    const auto from = agents_.find(app.agent);
    if (from == agents_.end())
        fault("is attached to no agent; expected a command attach-agent for this application");
    const auto to = agents_.find(from->second.peer);
    if (!from->second.sends || to == agents_.end())
        fault("has no destination; expected a command connect for the agent of this application");
    if (!from->second.node || !to->second.node)
        fault(
            "sends from or to an agent that is on no node; expected a command $ns_ attach-agent "
            "for both agents");
    constexpr double most = std::numeric_limits<int>::max();
    TrafficTable flow;
    flow.kind = TrafficKind::unicast;
    flow.from = fmt::format("n{}", *from->second.node);
    flow.to = fmt::format("n{}", *to->second.node);
    flow.start = *app.start - start_of_run;
    const double interval = app.interval.value_or(8 * app.size / app.rate);
    flow.every = std::max(from_seconds(interval), Duration{1});
    flow.is_of_file = true;
    flow.from_where = from->second.where;
    flow.start_where = app.where;
    flow.to_where = to->second.where;
    if (app.stop) flow.stop = *app.stop - start_of_run;
    if (flow.stop && *flow.stop <= *flow.start)
        fault("stops before it starts; expected a stop after the start");
    if (flow.from == flow.to)
        fault("sends to its own node; expected an agent on a different node as destination");
    if (app.most < most) flow.count = static_cast<int>(app.most);
    add_packets(flow, app.size, from->second.size, file);
}

}  // namespace

TrafficFile read_traffic_file(const std::string& path) { return TrafficReader(path).read(); }

void read_flows(const Value& value, Scenario& out) {
    TableReader table(value, "[traffic] with a file");
    table.expect({"file"});
    std::string name;
    table.read("file", name);
    const auto path = std::filesystem::path(out.file).parent_path() / name;
    TrafficFile file = located_file(table.take("file")->where, "file",
                                    [&] { return read_traffic_file(path.string()); });
    for (TrafficTable& flow : file.flows) out.traffic.push_back(std::move(flow));
    out.notices.insert(out.notices.end(), file.notices.begin(), file.notices.end());
}

}  // namespace rovernet
