// SPDX-License-Identifier: MIT
#include "cli/manual.hpp"

#include "experiment/version.hpp"

#include <fmt/format.h>

#include <functional>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace rovernet::cli {
namespace {

constexpr std::string_view examples_title = "Examples:\n";

/// Visits a command and those below it, with its words: "", "run", "move convert".
using Visit = std::function<void(const CLI::App& command, const std::string& words)>;
void for_each_command(const CLI::App& command, const std::string& words, const Visit& visit) {
    visit(command, words);
    for (const CLI::App* sub : command.get_subcommands(nullptr)) {
        if (sub->get_group().empty()) continue;  // hidden
        for_each_command(*sub, words.empty() ? sub->get_name() : words + " " + sub->get_name(),
                         visit);
    }
}

std::vector<std::string> names_of(const CLI::Option& option) {
    std::vector<std::string> names;
    for (const auto& name : option.get_snames()) names.push_back("-" + name);
    for (const auto& name : option.get_lnames()) names.push_back("--" + name);
    return names;
}

/// The words that may follow a command: those of its own, and its options.
std::vector<std::string> words_after(const CLI::App& command) {
    std::vector<std::string> words;
    for (const CLI::App* sub : command.get_subcommands(nullptr)) {
        if (!sub->get_group().empty()) words.push_back(sub->get_name());
    }
    for (const CLI::Option* option : command.get_options()) {
        for (std::string& name : names_of(*option)) words.push_back(std::move(name));
    }
    return words;
}

std::string bash_script(const CLI::App& app) {
    std::string commands, cases;
    for_each_command(app, "", [&](const CLI::App& command, const std::string& words) {
        if (!words.empty())
            commands += fmt::format("{}\"{}\"", commands.empty() ? "" : " | ", words);
        cases += fmt::format("        \"{}\") words=\"{}\" ;;\n", words,
                             fmt::join(words_after(command), " "));
    });
    return fmt::format(R"(# Completion of rovernet, by rovernet completion.
_rovernet() {{
    local current=${{COMP_WORDS[COMP_CWORD]}} command="" words="" i next
    for ((i = 1; i < COMP_CWORD; i++)); do
        next="${{command:+$command }}${{COMP_WORDS[i]}}"
        case "$next" in
            {}) command=$next ;;
        esac
    done
    case "$command" in
{}    esac
    COMPREPLY=($(compgen -W "$words" -- "$current"))
}}
complete -o default -F _rovernet rovernet
)",
                       commands, cases);
}

/// Text in single quotes, as fish reads them.
std::string fish_quoted(const std::string& text) {
    std::string quoted = "'";
    for (const char c : text) {
        if (c == '\'' || c == '\\') quoted += '\\';
        quoted += c;
    }
    return quoted + "'";
}

std::string fish_script(const CLI::App& app) {
    std::string script = "# Completion of rovernet, by rovernet completion.\n";
    for_each_command(app, "", [&](const CLI::App& command, const std::string& words) {
        std::string when = "__fish_use_subcommand";
        if (!words.empty()) {
            const std::string last = words.substr(words.rfind(' ') + 1);
            when = "__fish_seen_subcommand_from " + last;
        }
        for (const CLI::App* sub : command.get_subcommands(nullptr)) {
            if (sub->get_group().empty()) continue;
            script += fmt::format("complete -c rovernet -n '{}' -a {} -d {}\n", when,
                                  sub->get_name(), fish_quoted(sub->get_description()));
        }
        for (const CLI::Option* option : command.get_options()) {
            if (option->get_positional()) continue;
            script += fmt::format("complete -c rovernet -n '{}'", when);
            for (const auto& name : option->get_snames()) script += " -s " + name;
            for (const auto& name : option->get_lnames()) script += " -l " + name;
            script += fmt::format(" -d {}\n", fish_quoted(option->get_description()));
        }
    });
    return script;
}

/// Text as troff shows it.
std::string roff(const std::string& text) {
    std::string page;
    bool begins = true;
    for (const char c : text) {
        if (begins && (c == '.' || c == '\'')) page += "\\&";
        if (c == '\\')
            page += "\\e";
        else if (c == '-')
            page += "\\-";
        else
            page += c;
        begins = c == '\n';
    }
    return page;
}

std::string roff_option(const CLI::Option& option) {
    const bool positional = option.get_positional();
    std::string name =
        positional ? option.get_name(true) : fmt::format("{}", fmt::join(names_of(option), ", "));
    if (!positional && option.get_items_expected_max() > 0) name += " " + option.get_type_name();
    std::string what = option.get_description();
    const std::string usual = option.get_default_str();
    if (!usual.empty()) what += fmt::format(" (default: {})", usual);
    return fmt::format(".TP\n.B {}\n{}\n", roff(name), roff(what));
}

}  // namespace

void add_examples(CLI::App& command, std::initializer_list<const char*> lines) {
    std::string text{examples_title};
    for (const char* line : lines) text += fmt::format("  {}\n", line);
    command.footer(text);
}

std::string completion_script(const CLI::App& app, const std::string& shell) {
    if (shell == "bash") return bash_script(app);
    if (shell == "zsh") {
        return "#compdef rovernet\nautoload -U +X bashcompinit && bashcompinit\n" +
               bash_script(app);
    }
    if (shell == "fish") return fish_script(app);
    throw std::invalid_argument(
        fmt::format("SHELL: unknown \"{}\"; expected one of bash, zsh, fish", shell));
}

std::string man_page(const CLI::App& app) {
    std::string page = fmt::format(
        ".TH ROVERNET 1 \"\" \"rovernet {}\"\n.SH NAME\nrovernet \\- wireless networks of moving "
        "robots, event by event\n.SH SYNOPSIS\n.B rovernet\n.I COMMAND\n[OPTIONS]\n"
        ".SH COMMANDS\n",
        roff(std::string(version())));
    for_each_command(app, "", [&](const CLI::App& command, const std::string& words) {
        if (words.empty() || !command.get_subcommands(nullptr).empty()) return;
        page += fmt::format(".SS rovernet {}\n{}.\n", words, roff(command.get_description()));
        for (const CLI::Option* option : command.get_options()) page += roff_option(*option);
        const std::string footer = command.get_footer();
        if (!footer.starts_with(examples_title)) return;
        page += fmt::format(".PP\nExamples:\n.PP\n.nf\n{}.fi\n",
                            roff(footer.substr(examples_title.size())));
    });
    return page + R"(.SH EXIT STATUS
0: done. 1: failed. 2: the command line is wrong. 3: an input file is wrong. 4: some runs of a
study failed. 130: interrupted.
)";
}

}  // namespace rovernet::cli
