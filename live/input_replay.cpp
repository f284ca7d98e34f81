// SPDX-License-Identifier: MIT
#include "live/input_replay.hpp"

#include "experiment/run.hpp"
#include "experiment/session.hpp"
#include "files/input_file.hpp"
#include "files/part_file.hpp"
#include "live/carriers/command_reader.hpp"
#include "live/input_log.hpp"
#include "scenario/document/toml.hpp"
#include "scenario/scenario_file.hpp"
#include "traces/fingerprint.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>

namespace rovernet {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t latest = std::uint64_t{1} << 62U;  // [ns]
constexpr auto largest = ~std::uint64_t{0};

Duration logged_time(const JsonElement& element) {
    return Duration{static_cast<std::int64_t>(element.whole_number(0, latest))};
}

NodeId logged_robot(const JsonElement& element, const Network& network) {
    const auto robot = network.find(element.text());
    if (!robot)
        element.fail("unknown_robot", fmt::format("the scenario has no robot {}", element.text()));
    return *robot;
}

/// Reader of commands in a log. Times are whole nanoseconds, and hops are a number, in the first
/// format.
class LoggedCommands : public CommandReader {
  public:
    explicit LoggedCommands(const Network& network) : network_(network) {}

  protected:
    NodeId robot(const JsonElement& name) const override { return logged_robot(name, network_); }
    Duration time(const JsonElement& element) const override {
        return element.value.is_string() ? CommandReader::time(element) : logged_time(element);
    }
    bool truth(const JsonElement& element) const override {
        return element.value.is_number() ? element.whole_number(1, 1) == 1 : element.truth();
    }

  private:
    const Network& network_;
};

constexpr std::array<std::string_view, 5> input_keys = {"t_ns", "n", "client", "robot", "do"};

/// Input of a line without its command. @param found  members of the input_keys
Input begin_input(const JsonElement& line, std::span<const CommandReader::Member> found,
                  const Network& network) {
    for (std::size_t i = 0; i < input_keys.size(); ++i) {
        needed(found[i], line, input_keys[i], "a line of inputs.jsonl");
    }
    return {.time = start_of_run + logged_time(*found[0]),
            .robot = logged_robot(*found[3], network),
            .client = std::string(found[2]->text()),
            .number = found[1]->whole_number(0, largest),
            .command = StopCommand{}};
}

/// Key in logs of the first format.
constexpr std::string_view first_key(std::string_view key) {
    return key == "place"     ? "at"
           : key == "timeout" ? "timeout_ns"
           : key == "one_hop" ? "hops"
                              : key;
}

/// Reads a line of the first format: `do` is the name of the command, its keys stand beside it.
template <class... Commands>
Input first_input(std::tuple<std::type_identity<Commands>...> /*commands*/, const JsonElement& line,
                  const Network& network) {
    static constexpr auto keys = [] {
        constexpr auto own = keys_of<Commands...>();
        std::array<std::string_view, input_keys.size() + own.size()> all{};
        const auto rest = std::copy(input_keys.begin(), input_keys.end(), all.begin());
        std::transform(own.begin(), own.end(), rest, first_key);
        return all;
    }();
    const auto found = members(line, keys);
    Input input = begin_input(line, found, network);
    const std::string_view name = found[4]->text();
    bool is_known = false;
    std::size_t first = input_keys.size();
    const auto read = [&]<class Command>(std::type_identity<Command>) {
        constexpr std::size_t size = number_of_keys<Command>();
        if (name == (Command::name == "drive" ? "velocity" : Command::name)) {
            is_known = true;
            auto command = command_at<Command>(network, input.robot);
            LoggedCommands(network).read(command, line, std::span(keys).subspan(first, size),
                                         std::span(found).subspan(first, size));
            input.command = std::move(command);
        }
        first += size;
    };
    (read(std::type_identity<Commands>{}), ...);
    if (!is_known) {
        found[4]->fail("bad_value",
                       "expected \"velocity\", \"goal\", \"stop\", \"place\" or \"send\"");
    }
    return input;
}

/// Reads a line that is neither the first nor the last.
Input input_in(const JsonElement& line, const Network& network, std::uint64_t format) {
    if (format == 1) return first_input(AllCommands{}, line, network);
    const auto found = members(line, input_keys);
    Input input = begin_input(line, found, network);
    auto command =
        read_one_of(AllCommands{}, LoggedCommands(network), *found[4], network, input.robot);
    if (!command) found[4]->fail("bad_value", "expected a command");
    input.command = std::move(*command);
    return input;
}

/// Replay of a run from the lines of its log.
class Replayed {
  public:
    /// @param format  of the log
    Replayed(const Scenario& scenario, std::uint64_t format,
             const std::function<bool(double)>& progress)
        : session_(scenario), format_(format), progress_(progress) {
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
        const Input input = input_in(line, session_.network(), format_);
        if (input.time < session_.network().now()) {
            line.fail("out_of_range",
                      "the time of this input is earlier than the time of the previous input");
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
        return session_.attach({robot}, {}, false);
    }

    void run_to(Time time) {
        constexpr std::uint64_t events_a_slice = 4096;
        while (!session_.advance(time, events_a_slice)) {
            const double share = seconds(session_.network().now()) / seconds(session_.end());
            if (progress_ && !progress_(share)) throw Interrupted();
        }
    }

    Session session_;
    std::uint64_t format_;
    const std::function<bool(double)>& progress_;
    std::shared_ptr<Fingerprint> fingerprint_ = std::make_shared<Fingerprint>();
};

/// Lines of a log, each read as JSON.
class LogLines {
  public:
    explicit LogLines(const std::string& path)
        : path_((need_file(path), path)), file_(path, std::ios::binary) {
        if (!file_)
            throw InputError({.source = path}, "this file cannot be read; check its permissions");
    }

    /// The next line; nothing at the end, or if the line is the last one and torn.
    std::optional<JsonElement> next() {
        if (!std::getline(file_, text_)) return std::nullopt;
        ++number_;
        simdjson::dom::element document;
        const auto error = parser_.parse(text_).get(document);
        if (error == simdjson::SUCCESS) return JsonElement{document, {}};
        is_torn_ = file_.eof();
        if (is_torn_) return std::nullopt;
        throw InputError(where(),
                         fmt::format("expected a JSON object: {}", simdjson::error_message(error)));
    }
    Location where() const { return {.source = path_, .line = number_, .column = 1}; }
    /// Line that was not written completely.
    std::optional<int> torn() const { return is_torn_ ? std::optional(number_) : std::nullopt; }

  private:
    std::string path_;
    std::ifstream file_;
    std::string text_;
    simdjson::dom::parser parser_;
    int number_ = 0;
    bool is_torn_ = false;
};

/// Reads the first line. @return the scenario that was run, as far as it can be known
ScenarioFile read_head(const JsonElement& line, const fs::path& folder, InputReplay& result,
                       std::uint64_t& format) {
    constexpr std::array<std::string_view, 5> keys = {"format", "version", "scenario", "seed",
                                                      "toml"};
    const auto [format_of, version, scenario, seed, toml] = members(line, keys);
    if (format_of) format = format_of->whole_number(1, input_log_format);
    result.recorded_by = needed(version, line, "version", "a text").text();
    const std::string path = folder / "scenario.toml";
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    const auto wanted = needed(scenario, line, "scenario", "a text").text();
    result.is_other_scenario = text_digest(text.str()) != wanted;
    result.has_own_scenario = toml && result.is_other_scenario;
    if (!result.has_own_scenario) return {path, {}};
    return {parse_toml(toml->text(), result.log), path, {}};
}

/// Parts of logs in a folder, the newest first.
std::vector<fs::path> parts_in(const fs::path& folder) {
    std::vector<std::pair<fs::file_time_type, fs::path>> found;
    std::error_code ignored;
    for (fs::directory_iterator entry(folder, ignored), end; entry != end;
         entry.increment(ignored)) {
        if (!is_part_of(input_log_name, entry->path().filename().native())) continue;
        found.emplace_back(entry->last_write_time(ignored), entry->path());
    }
    std::sort(found.begin(), found.end(), std::greater<>());
    std::vector<fs::path> parts;
    for (auto& [time, path] : found) parts.push_back(std::move(path));
    return parts;
}

/// Finds the log that a path means. @return it, and those that lie beside it in a folder
std::pair<fs::path, std::vector<fs::path>> logs_of(const std::string& path) {
    std::error_code ignored;
    if (!fs::is_directory(path, ignored)) return {path, {}};
    const fs::path whole = fs::path(path) / input_log_name;
    std::vector<fs::path> parts = parts_in(path);
    if (fs::exists(whole, ignored)) return {whole, std::move(parts)};
    if (parts.empty()) {
        throw InputError({path},
                         "this folder has no log of a live run (inputs.jsonl); to verify a run "
                         "without such a log, give its trace, such as " +
                             (fs::path(path) / "trace.mcap").string());
    }
    fs::path newest = parts.front();
    parts.erase(parts.begin());
    return {std::move(newest), std::move(parts)};
}

}  // namespace

bool has_input_log(const std::string& path) {
    std::error_code ignored;
    return fs::is_directory(path, ignored) || path.ends_with(".jsonl") ||
           is_part_of(input_log_name, fs::path(path).filename().native());
}

InputReplay replay_inputs(const std::string& path, const std::function<bool(double)>& progress) {
    const auto [log, others] = logs_of(path);
    InputReplay result;
    result.log = log.string();
    result.others.assign(others.begin(), others.end());
    LogLines lines(result.log);
    try {
        const auto head = lines.next();
        if (!head)
            throw InputError(lines.where(),
                             "the file is empty; expected a log of inputs (inputs.jsonl), which "
                             "rovernet live writes");
        const fs::path folder = log.has_parent_path() ? log.parent_path() : ".";
        std::uint64_t format = 1;
        const Scenario scenario = load_scenario(read_head(*head, folder, result, format));
        Replayed replayed(scenario, format, progress);
        for (auto line = lines.next(); line; line = lines.next()) {
            if (replayed.take(*line, result)) break;
        }
        result.now = replayed.fingerprint();
        result.torn = lines.torn();
    } catch (const RequestError& fault) {
        throw InputError(lines.where(), fmt::format("{}: {}", fault.at(), fault.what()));
    } catch (const std::invalid_argument& fault) {
        throw InputError(lines.where(), fault.what());
    }
    return result;
}

}  // namespace rovernet
