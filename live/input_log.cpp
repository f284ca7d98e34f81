// SPDX-License-Identifier: MIT
#include "live/input_log.hpp"

#include "experiment/output.hpp"
#include "experiment/run_folder.hpp"
#include "experiment/version.hpp"
#include "files/base64.hpp"
#include "files/kept_inputs.hpp"
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

void put(JsonLine& line, std::integral auto number, const Network&) { line.put_number(number); }
void put(JsonLine& line, bool is_true, const Network&) { line.put(is_true ? "true" : "false"); }

/// Number with a point, as -0 would be read as 0.
void put(JsonLine& line, double number, const Network&) {
    if (line.put_number(number).find_first_of(".e") == std::string_view::npos) line.put(".0");
}
template <class Unit>
void put(JsonLine& line, const Quantity<Unit>& quantity, const Network& network) {
    put(line, quantity.value, network);
}

void put_text(JsonLine& line, std::string_view text) {
    const bool is_plain = std::all_of(text.begin(), text.end(), [](char c) {
        return c >= ' ' && c <= '~' && c != '"' && c != '\\';
    });
    if (!is_plain) return line.put(to_json_line(Value(text)));
    line.put('"');
    line.put(text);
    line.put('"');
}

void put(JsonLine& line, const std::string& bytes, const Network&) {
    put_text(line, base64(bytes));
}
void put(JsonLine& line, Duration time, const Network&) {
    line.put('"');
    line.put_number(seconds(time));
    line.put(" s\"");
}
void put(JsonLine& line, const std::optional<NodeId>& robot, const Network& network) {
    put_text(line, robot ? network.name(*robot) : "*");
}
template <class Value>
void put(JsonLine& line, const std::optional<Value>& value, const Network& network) {
    put(line, *value, network);
}

void put(JsonLine& line, const Vec3& at, const Network& network) {
    char between = '[';
    for (const double each : {at.x, at.y, at.z}) {
        line.put(between);
        put(line, each, network);
        between = ',';
    }
    line.put(']');
}

/// Whether a field is left out: it has no value, and none has no word.
template <class Value>
bool is_left_out(const Value&) {
    return false;
}
template <class Value>
bool is_left_out(const std::optional<Value>& value) {
    return !std::same_as<Value, NodeId> && !value;
}

/// Adds a command as an object, with the keys of its fields.
template <class Command>
void put_command(JsonLine& line, const Command& command, const Network& network) {
    char between = '{';
    const auto put_key = [&](std::string_view key) {
        line.put(std::exchange(between, ','));
        line.put('"');
        line.put(key);
        line.put("\":");
    };
    for_each_field<Command>([&](const auto& f) {
        if (is_left_out(command.*f.member)) return;
        put_key(f.name);
        put(line, command.*f.member, network);
    });
    if (between == '{') {
        put_key(Command::name);
        put(line, true, network);
    }
    line.put('}');
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
    // A folder with results keeps their scenario until new results replace it. The scenario that
    // was read here is not written again, so that a failed run does not remove it.
    const fs::path path = fs::path(folder) / "scenario.toml";
    if (!has_results(folder) && !is_kept_input(path.string())) {
        scenario_ = path;
        write_file(scenario_, document);
    }
    Table head;
    head.set("format", input_log_format);
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
    lines_.put_number(input.time.time_since_epoch().count());
    lines_.put(",\"n\":");
    lines_.put_number(input.number);
    lines_.put(",\"client\":");
    put_text(lines_, input.client);
    lines_.put(",\"robot\":");
    put_text(lines_, network.name(input.robot));
    lines_.put(",\"do\":");
    std::visit([&](const auto& command) { put_command(lines_, command, network); }, input.command);
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
