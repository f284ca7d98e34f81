// SPDX-License-Identifier: MIT
#include "cli/terminal/command_line.hpp"

#include "cli/terminal/commands.hpp"
#include "cli/terminal/diagnostics.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <sstream>
#include <string_view>
#include <type_traits>

namespace rovernet::cli {
namespace {

constexpr std::string_view examples_title = "Examples:\n";

/// The command that the words of the command line name, as far as they do.
const CLI::App& named_command(const CLI::App& app) {
    const auto named = app.get_subcommands();
    return named.empty() ? app : named_command(*named.front());
}

std::vector<std::string> options_of(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options()) {
        for (const auto& name : option->get_lnames()) names.push_back("--" + name);
        for (const auto& name : option->get_snames()) names.push_back("-" + name);
    }
    return names;
}

std::vector<std::string> commands_of(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::App* sub : command.get_subcommands(nullptr)) {
        if (!sub->get_group().empty()) names.push_back(sub->get_name());
    }
    return names;
}

/// Message for a value that an option cannot have: of "Could not convert: --message = abc", what
/// the option expects.
std::string conversion_error(const CLI::App& command, const std::string& what) {
    constexpr std::string_view begin = "Could not convert: ", between = " = ";
    const std::size_t equals = what.find(between);
    if (!what.starts_with(begin) || equals == what.npos) return what;
    const std::string name = what.substr(begin.size(), equals - begin.size());
    const CLI::Option* option = command.get_option_no_throw(name);
    const std::string type = option ? option->get_type_name() : "";
    return fmt::format("{}: found \"{}\"; expected {}", name, what.substr(equals + between.size()),
                       type.find("UINT") != type.npos  ? "a whole number >= 0"
                       : type.find("INT") != type.npos ? "a whole number"
                                                       : "a number without a unit");
}

/// Message of what is wrong with the words of the command line, and what was probably meant.
std::string usage_error(const CLI::App* app, const CLI::Error& error) {
    std::string what = conversion_error(named_command(*app), error.what());
    const std::vector<std::string> unexpected = app->remaining(true);
    if (!unexpected.empty()) {
        const std::string word = unexpected.front().substr(0, unexpected.front().find('='));
        const CLI::App& command = named_command(*app);
        const std::vector<std::string> commands = commands_of(command);
        const bool is_option = word.starts_with('-');
        const std::vector<std::string> options = options_of(command);
        if (is_option && std::find(options.begin(), options.end(), word) != options.end()) {
            return fmt::format(
                "rovernet: the option \"{}\" is before the command; write it after \"{}\"\n", word,
                command.get_name());
        }
        if (is_option) {
            what = fmt::format("unknown option \"{}\"", word);
        } else if (!commands.empty()) {
            what = fmt::format("unknown command \"{}\"; expected one of {}", word,
                               fmt::join(commands, ", "));
        } else {
            what = fmt::format("unexpected argument \"{}\"", word);
        }
        const std::string near = did_you_mean(word, is_option ? options : commands);
        if (!near.empty()) what += "; " + near;
    }
    return fmt::format("rovernet: {}; run with --help for more\n", what);
}

Command::OptionText text_of(const CLI::Option& option) {
    Command::OptionText text;
    text.short_names = option.get_snames();
    text.long_names = option.get_lnames();
    if (option.get_positional()) text.argument = option.get_name(true);
    if (option.get_items_expected_max() > 0) text.type = option.get_type_name();
    text.what = option.get_description();
    text.usual = option.get_default_str();
    return text;
}

Command::Text text_of(const CLI::App& command) {
    Command::Text text{command.get_name(), command.get_description(), "", {}, {}};
    const std::string footer = command.get_footer();
    if (footer.starts_with(examples_title)) text.examples = footer.substr(examples_title.size());
    for (const CLI::Option* option : command.get_options()) {
        text.options.push_back(text_of(*option));
    }
    for (const CLI::App* sub : command.get_subcommands(nullptr)) {
        if (!sub->get_group().empty()) text.commands.push_back(text_of(*sub));
    }
    return text;
}

std::ptrdiff_t quotes_in(const std::string& word) {
    return std::count(word.begin(), word.end(), '"');
}

/// Values of a list that was split at each `between`: parts between double quotes are joined again,
/// and a value in quotes loses its quotes.
std::vector<std::string> with_quoted(const std::vector<std::string>& parts, char between) {
    std::vector<std::string> values;
    bool is_open = false;
    for (const std::string& part : parts) {
        if (is_open)
            values.back() += between + part;
        else
            values.push_back(part);
        is_open = is_open != (quotes_in(part) % 2 == 1);
    }
    if (is_open) return parts;
    for (std::string& value : values) {
        if (value.size() >= 2 && value.front() == '"' && value.back() == '"' &&
            quotes_in(value) == 2)
            value = value.substr(1, value.size() - 2);
    }
    return values;
}

/// Adds an option that sets a list of texts.
CLI::Option* add_list(CLI::App& command, const char* name, std::vector<std::string>& value,
                      const char* what) {
    const auto made = std::make_shared<CLI::Option*>();
    *made = command.add_option_function<std::vector<std::string>>(
        name,
        [&value, made](const std::vector<std::string>& given) {
            const char between = (*made)->get_delimiter();
            value = between == '\0' ? given : with_quoted(given, between);
        },
        what);
    (*made)->default_function([&value] { return CLI::detail::to_string(value); });
    return (*made)->run_callback_for_default();
}

}  // namespace

Option Option::required() const { return Option(option_->required()); }

Option Option::shows_default() const { return Option(option_->capture_default_str()); }

Option Option::delimiter(char between) const { return Option(option_->delimiter(between)); }

Option Option::usually(const char* text) const {
    return Option(option_->expected(0, 1)->default_str(text)->run_callback_for_default(false));
}

Option Option::one_word() const { return Option(option_->allow_extra_args(false)); }

Option Option::check(const Check& check) const {
    const auto fault = [check](std::string& text) { return check.fault(text); };
    return Option(option_->check(CLI::Validator(fault, check.kind)));
}

Option Option::range(int lowest, int highest) const {
    return Option(option_->check(CLI::Range(lowest, highest)));
}

Option Option::range(double lowest, double highest) const {
    return Option(option_->check(CLI::Range(lowest, highest)));
}

Option Option::one_of(const std::vector<std::string>& words) const {
    return Option(option_->check(CLI::IsMember(words)));
}

Option Option::transform(std::string (*changed)(const std::string& text)) const {
    return Option(option_->transform(changed));
}

Option Option::excludes(Option other) const { return Option(option_->excludes(other.option_)); }

Option Option::needs(Option other) const { return Option(option_->needs(other.option_)); }

Command Command::add_command(const char* name, const char* what) const {
    return Command(command_->add_subcommand(name, what));
}

template <class T>
Option Command::add_option(const char* name, T& value, const char* what) const {
    if constexpr (std::is_same_v<T, std::vector<std::string>>) {
        return Option(add_list(*command_, name, value, what));
    } else {
        return Option(command_->add_option(name, value, what));
    }
}
template Option Command::add_option(const char*, std::vector<std::string>&, const char*) const;
template Option Command::add_option(const char*, std::string&, const char*) const;
template Option Command::add_option(const char*, std::optional<std::string>&, const char*) const;
template Option Command::add_option(const char*, int&, const char*) const;
template Option Command::add_option(const char*, std::uint64_t&, const char*) const;
template Option Command::add_option(const char*, std::optional<std::uint64_t>&, const char*) const;
template Option Command::add_option(const char*, std::optional<std::uint32_t>&, const char*) const;
template Option Command::add_option(const char*, std::vector<std::uint32_t>&, const char*) const;
template Option Command::add_option(const char*, double&, const char*) const;
template Option Command::add_option(const char*, std::optional<double>&, const char*) const;

Option Command::add_flag(const char* name, bool& value, const char* what) const {
    return Option(command_->add_flag(name, value, what));
}

Option Command::add_flag(const char* name, const std::function<void()>& act,
                         const char* what) const {
    return Option(command_->add_flag_callback(name, act, what));
}

Option Command::option(const char* name) const { return Option(command_->get_option(name)); }

void Command::runs(const std::function<int()>& act) const {
    command_->callback([act] {
        if (const int code = act(); code != ok) throw CLI::RuntimeError(code);
    });
}

void Command::needs_command() const { command_->require_subcommand(1); }

void Command::hide() const { command_->group(""); }

void Command::add_examples(std::initializer_list<const char*> lines) const {
    std::string text{examples_title};
    for (const char* line : lines) text += fmt::format("  {}\n", line);
    command_->footer(text);
}

Command::Text Command::text() const { return text_of(*command_); }

int run_command_line(int argc, char** argv, const char* name, const char* what,
                     const std::string& version,
                     const std::function<void(Command program)>& declare) {
    CLI::App app{what, name};
    app.set_version_flag("--version", version);
    app.require_subcommand(1);
    app.failure_message(usage_error);
    declare(Command(&app));
    try {
        app.parse(argc, argv);
    } catch (const CLI::RuntimeError& end) {
        return end.get_exit_code();
    } catch (const CLI::ParseError& error) {
        std::ostringstream text;  // std::cout would lose why it cannot be written
        if (app.exit(error, text) != 0) return usage;
        return guarded([&] { fmt::print("{}", text.str()); });
    }
    return ok;
}

}  // namespace rovernet::cli
