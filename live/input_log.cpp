// SPDX-License-Identifier: MIT
#include "live/input_log.hpp"

#include "experiment/run.hpp"
#include "experiment/run_folder.hpp"
#include "experiment/session.hpp"
#include "experiment/version.hpp"
#include "files/base64.hpp"
#include "files/input_file.hpp"
#include "live/json_object.hpp"
#include "scenario/json.hpp"
#include "scenario/toml.hpp"

#include <xxhash.h>

#include <algorithm>
#include <concepts>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace rovernet {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

std::string digest(const std::string& text) {
    return fmt::format("{:016x}", XXH64(text.data(), text.size(), 0));
}

void put(JsonLine& line, std::integral auto number) { line.put_number(number); }

/// Number with a point, as -0 would be read as 0.
void put(JsonLine& line, double number) {
    if (line.put_number(number).find_first_of(".e") == std::string_view::npos) line.put(".0");
}

void put(JsonLine& line, std::string_view text) {
    const bool is_plain = std::all_of(text.begin(), text.end(), [](char c) {
        return c >= ' ' && c <= '~' && c != '"' && c != '\\';
    });
    if (!is_plain) return line.put(to_json_line(Value(text)));
    line.put('"');
    line.put(text);
    line.put('"');
}

void put(JsonLine& line, const Vec3& at) {
    line.put('[');
    put(line, at.x);
    line.put(',');
    put(line, at.y);
    line.put(',');
    put(line, at.z);
    line.put(']');
}

/// Adds a member of an object, behind another one.
template <class Member>
void put(JsonLine& line, std::string_view key, const Member& value) {
    line.put(",\"");
    line.put(key);
    line.put("\":");
    put(line, value);
}

void put(JsonLine& line, const DriveCommand& command, const Network&) {
    put(line, "do", "velocity");
    put(line, "v", command.speed.value);
    put(line, "w", command.turn_rate.value);
    if (command.timeout) put(line, "timeout_ns", command.timeout->count());
}
void put(JsonLine& line, const GoalCommand& command, const Network&) {
    put(line, "do", "goal");
    put(line, "goal", command.to);
    put(line, "speed", command.speed.value);
}
void put(JsonLine& line, const StopCommand&, const Network&) { put(line, "do", "stop"); }
void put(JsonLine& line, const PlaceCommand& command, const Network&) {
    put(line, "do", "place");
    put(line, "at", command.at);
    put(line, "heading", command.heading.value);
}
void put(JsonLine& line, const SendCommand& command, const Network& network) {
    const bool is_to_one = command.to && *command.to != everyone;
    put(line, "do", "send");
    put(line, "to", is_to_one ? network.name(*command.to) : "*");
    if (command.to == everyone) put(line, "hops", 1);
    put(line, "port", command.port);
    put(line, "data", base64(command.payload));
    if (command.size) put(line, "size", *command.size);
}

}  // namespace

InputLog::InputLog(const std::string& folder, const Scenario& scenario)
    : file_(fmt::format("{}/{}", folder, input_log_name), PartFile::Failed::is_kept) {
    Table head;
    head.set("version", code_version());
    head.set("scenario", digest(to_toml(document_in(folder, scenario))));
    head.set("seed", scenario.scenario.seed);
    lines_.put(to_json_line(Value(std::move(head))) + "\n");
    flush();
}

void InputLog::flush() {
    file_.write(lines_.text());
    lines_.clear();
    written_ = Clock::now();
}

void InputLog::add(const Input& input, const Network& network) {
    constexpr std::size_t portion = 65536;  // [bytes]
    lines_.put("{\"t_ns\":");
    put(lines_, input.time.time_since_epoch().count());
    put(lines_, "n", input.number);
    put(lines_, "client", input.client);
    put(lines_, "robot", network.name(input.robot));
    std::visit([&](const auto& command) { put(lines_, command, network); }, input.command);
    lines_.put("}\n");
    if (lines_.text().size() >= portion || Clock::now() - written_ >= 1s) flush();
}

void InputLog::finish(Duration simulated, std::string_view fingerprint) {
    Table line;
    line.set("end_ns", std::int64_t{simulated.count()});
    line.set("fingerprint", fingerprint);
    lines_.put(to_json_line(Value(std::move(line))) + "\n");
    flush();
    file_.give_name();
}

namespace {

constexpr std::uint64_t latest = std::uint64_t{1} << 62U;  // [ns]
constexpr auto largest = ~std::uint64_t{0};

Duration logged_time(const JsonElement& element) {
    return Duration{static_cast<std::int64_t>(element.whole_number(0, latest))};
}

NodeId logged_robot(const JsonElement& element, const Network& network) {
    const auto robot = network.find(element.text());
    if (!robot) element.fail("unknown_robot", fmt::format("no robot {}", element.text()));
    return *robot;
}

Vec3 logged_place(const JsonElement& list) {
    std::vector<double> at;
    for (const auto& item : list.array()) {
        at.push_back(JsonElement{item, list.path}.number(goal_places));
    }
    if (at.size() != 3) list.fail("bad_value", "expected [x, y, z]");
    return {at[0], at[1], at[2]};
}

SendCommand logged_message(const JsonElement& to, const std::optional<JsonElement>& hops,
                           const JsonElement& port, const JsonElement& data,
                           const std::optional<JsonElement>& size, const Network& network) {
    SendCommand send;
    if (hops && hops->whole_number(1, 1) == 1) send.to = everyone;
    if (to.text() != "*") send.to = logged_robot(to, network);
    send.port = static_cast<std::uint16_t>(port.whole_number(0, 65'535));
    auto bytes = from_base64(data.text());
    if (!bytes) data.fail("bad_base64", "expected base64");
    send.payload = std::move(*bytes);
    if (size) send.size = static_cast<std::uint32_t>(size->whole_number(0, 65'535));
    return send;
}

/// Reads a line that is neither the first nor the last.
Input input_in(const JsonElement& line, const Network& network) {
    static constexpr std::array<std::string_view, 17> keys = {
        "t_ns",  "n",  "client",  "robot", "do",   "v",    "w",    "timeout_ns", "goal",
        "speed", "at", "heading", "to",    "hops", "port", "data", "size"};
    const auto [t, n, client, robot, what, v, w, timeout, goal, speed, at, heading, to, hops, port,
                data, size] = members(line, keys);
    const auto given = [&](const auto& member, std::string_view key) -> const JsonElement& {
        return needed(member, line, key, "a line of inputs.jsonl");
    };
    Input input{.time = start_of_run + logged_time(given(t, "t_ns")),
                .robot = logged_robot(given(robot, "robot"), network),
                .client = std::string(given(client, "client").text()),
                .number = given(n, "n").whole_number(0, largest),
                .command = StopCommand{}};
    const JsonElement& act = given(what, "do");
    const std::string_view name = act.text();
    if (name == "velocity") {
        DriveCommand drive{{given(v, "v").number(drive_speeds)},
                           {given(w, "w").number(drive_turns)}};
        if (timeout) drive.timeout = logged_time(*timeout);
        input.command = drive;
    } else if (name == "goal") {
        input.command = GoalCommand{logged_place(given(goal, "goal")),
                                    {given(speed, "speed").number(goal_speeds)}};
    } else if (name == "place") {
        input.command =
            PlaceCommand{logged_place(given(at, "at")), {given(heading, "heading").number(any)}};
    } else if (name == "send") {
        input.command = logged_message(given(to, "to"), hops, given(port, "port"),
                                       given(data, "data"), size, network);
    } else if (name != "stop") {
        act.fail("bad_value", "expected velocity, goal, stop, place or send");
    }
    return input;
}

/// Run that is made again from the lines of its log.
class Replayed {
  public:
    Replayed(const Scenario& scenario, const std::function<bool(double)>& progress)
        : session_(scenario), progress_(progress) {
        session_.network().add_sink(fingerprint_);
    }

    /// Takes a line. @return whether it is the last one
    bool take(const JsonElement& line, InputReplay& result) {
        simdjson::dom::element found;
        if (line.object().at_key("end_ns").get(found) == simdjson::SUCCESS) {
            const auto [end, fingerprint] =
                members(line, std::array<std::string_view, 2>{"end_ns", "fingerprint"});
            result.recorded = needed(fingerprint, line, "fingerprint", "a text").text();
            run_to(start_of_run + logged_time(*end));
            return true;
        }
        const Input input = input_in(line, session_.network());
        if (input.time < session_.network().now()) {
            line.fail("out_of_range", "this input is before the one above it");
        }
        run_to(input.time);
        session_.carry_out(driver_of(input.robot), input.robot, input.command);
        ++result.inputs;
        return false;
    }

    std::string fingerprint() const { return fingerprint_->text(); }

  private:
    ClientId driver_of(NodeId robot) {
        if (const auto driver = session_.driver(robot)) return *driver;
        const ClientId driver = session_.attach({robot});
        session_.set_hearing(driver, false);
        return driver;
    }

    void run_to(Time time) {
        constexpr std::uint64_t events_a_slice = 4096;
        while (!session_.advance(time, events_a_slice)) {
            const double share = seconds(session_.network().now()) / seconds(session_.end());
            if (progress_ && !progress_(share)) throw Interrupted();
        }
    }

    Session session_;
    const std::function<bool(double)>& progress_;
    std::shared_ptr<Fingerprint> fingerprint_ = std::make_shared<Fingerprint>();
};

/// Lines of a log, each read as JSON.
class LogLines {
  public:
    explicit LogLines(const std::string& path)
        : path_((need_file(path), path)), file_(path, std::ios::binary) {
        if (!file_) throw InputError({.source = path}, "cannot be read");
    }

    /// The next line; nothing at the end, or if the line is cut.
    std::optional<JsonElement> next() {
        if (!std::getline(file_, text_) || file_.eof()) return std::nullopt;
        ++number_;
        simdjson::dom::element document;
        const auto error = parser_.parse(text_).get(document);
        if (error != simdjson::SUCCESS) {
            throw InputError(
                where(), fmt::format("expected a JSON object: {}", simdjson::error_message(error)));
        }
        return JsonElement{document, {}};
    }
    Location where() const { return {.source = path_, .line = number_, .column = 1}; }

  private:
    std::string path_;
    std::ifstream file_;
    std::string text_;
    simdjson::dom::parser parser_;
    int number_ = 0;
};

void read_head(const JsonElement& line, const std::string& folder, InputReplay& result) {
    const auto [version, scenario, seed] =
        members(line, std::array<std::string_view, 3>{"version", "scenario", "seed"});
    result.recorded_by = needed(version, line, "version", "a text").text();
    std::ifstream file(fs::path(folder) / "scenario.toml", std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    result.is_other_scenario =
        digest(text.str()) != needed(scenario, line, "scenario", "a text").text();
}

fs::path log_of(const std::string& path) {
    return input_kind(path) == InputKind::folder ? fs::path(path) / input_log_name : fs::path(path);
}

}  // namespace

bool has_input_log(const std::string& path) {
    std::error_code ignored;
    return (fs::is_directory(path, ignored) && fs::exists(log_of(path), ignored)) ||
           path.ends_with(".jsonl");
}

InputReplay replay_inputs(const std::string& path, const std::function<bool(double)>& progress) {
    const fs::path log = log_of(path);
    const std::string folder = log.has_parent_path() ? log.parent_path().string() : ".";
    LogLines lines(log.string());
    InputReplay result;
    try {
        const auto head = lines.next();
        if (!head) throw InputError(lines.where(), "expected the first line of a log of inputs");
        read_head(*head, folder, result);
        Replayed replayed(load_scenario((fs::path(folder) / "scenario.toml").string(), {}),
                          progress);
        for (auto line = lines.next(); line; line = lines.next()) {
            if (replayed.take(*line, result)) break;
        }
        result.now = replayed.fingerprint();
    } catch (const RequestError& fault) {
        throw InputError(lines.where(), fmt::format("{}: {}", fault.at(), fault.what()));
    } catch (const std::invalid_argument& fault) {
        throw InputError(lines.where(), fault.what());
    }
    return result;
}

}  // namespace rovernet
