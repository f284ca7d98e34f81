// SPDX-License-Identifier: MIT
#include "live/input_log.hpp"

#include "experiment/output.hpp"
#include "experiment/run_folder.hpp"
#include "experiment/version.hpp"
#include "files/base64.hpp"
#include "network/network.hpp"
#include "scenario/document/json.hpp"
#include "scenario/document/toml.hpp"
#include "sim/error.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <concepts>

namespace rovernet {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

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

bool has_results(const fs::path& folder) {
    std::error_code ignored;
    return fs::exists(folder / "summary.json", ignored);
}

}  // namespace

std::string text_digest(const std::string& text) {
    return fmt::format("{:016x}", XXH64(text.data(), text.size(), 0));
}

InputLog::InputLog(const std::string& folder, const Scenario& scenario)
    : file_(fmt::format("{}/{}", folder, input_log_name), PartFile::Failed::is_kept,
            PartFile::Orphans::are_kept) {
    const std::string document = to_toml(document_in(folder, scenario));
    // A folder with results keeps their scenario until new results replace it.
    if (!has_results(folder)) {
        scenario_ = fs::path(folder) / "scenario.toml";
        write_file(scenario_, document);
    }
    Table head;
    head.set("version", code_version());
    head.set("scenario", text_digest(document));
    head.set("seed", scenario.scenario.seed);
    head.set("toml", document);
    lines_.put(to_json_line(Value(std::move(head))) + "\n");
    flush();
}

InputLog::~InputLog() {
    if (is_finished_) return;
    if (!has_inputs_) {
        if (!scenario_.empty() && !has_results(scenario_.parent_path())) {
            std::error_code ignored;
            fs::remove(scenario_, ignored);
        }
        return;
    }
    try {
        flush();
        file_.keep();
    } catch (const RunError&) {
        // The error is ignored: it is the one with which the run has failed.
    }
}

void InputLog::discard() { has_inputs_ = false; }

void InputLog::flush() {
    file_.write(lines_.text());
    lines_.clear();
    written_ = Clock::now();
}

void InputLog::add(const Input& input, const Network& network) {
    has_inputs_ = true;
    lines_.put("{\"t_ns\":");
    put(lines_, input.time.time_since_epoch().count());
    put(lines_, "n", input.number);
    put(lines_, "client", input.client);
    put(lines_, "robot", network.name(input.robot));
    std::visit([&](const auto& command) { put(lines_, command, network); }, input.command);
    lines_.put("}\n");
    keep_up();
}

void InputLog::keep_up() {
    constexpr std::size_t portion = 65536;  // [bytes]
    if (lines_.text().empty()) return;
    if (lines_.text().size() >= portion || Clock::now() - written_ >= 1s) flush();
}

void InputLog::finish(Duration simulated, std::string_view fingerprint) {
    Table line;
    line.set("end_ns", std::int64_t{simulated.count()});
    line.set("fingerprint", fingerprint);
    lines_.put(to_json_line(Value(std::move(line))) + "\n");
    flush();
    file_.give_name();
    is_finished_ = true;
}

}  // namespace rovernet
