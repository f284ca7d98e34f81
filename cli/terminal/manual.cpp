// SPDX-License-Identifier: MIT
#include "cli/terminal/manual.hpp"

#include "experiment/version.hpp"

#include <fmt/format.h>

#include <functional>
#include <stdexcept>
#include <vector>

namespace rovernet::cli {
namespace {

/// Visits a command and those below it, with its words: "", "run", "move convert".
using Visit = std::function<void(const Command::Text& command, const std::string& words)>;
void for_each_command(const Command::Text& command, const std::string& words, const Visit& visit) {
    visit(command, words);
    for (const Command::Text& sub : command.commands) {
        for_each_command(sub, words.empty() ? sub.name : words + " " + sub.name, visit);
    }
}

std::vector<std::string> names_of(const Command::OptionText& option) {
    std::vector<std::string> names;
    for (const auto& name : option.short_names) names.push_back("-" + name);
    for (const auto& name : option.long_names) names.push_back("--" + name);
    return names;
}

/// The words that may follow a command: those of its own, and its options.
std::vector<std::string> words_after(const Command::Text& command) {
    std::vector<std::string> words;
    for (const Command::Text& sub : command.commands) words.push_back(sub.name);
    for (const Command::OptionText& option : command.options) {
        for (std::string& name : names_of(option)) words.push_back(std::move(name));
    }
    return words;
}

std::string bash_script(const Command::Text& program) {
    std::string commands, cases;
    for_each_command(program, "", [&](const Command::Text& command, const std::string& words) {
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

std::string fish_script(const Command::Text& program) {
    std::string script = "# Completion of rovernet, by rovernet completion.\n";
    for_each_command(program, "", [&](const Command::Text& command, const std::string& words) {
        std::string when = "__fish_use_subcommand";
        if (!words.empty()) {
            const std::string last = words.substr(words.rfind(' ') + 1);
            when = "__fish_seen_subcommand_from " + last;
        }
        for (const Command::Text& sub : command.commands) {
            script += fmt::format("complete -c rovernet -n '{}' -a {} -d {}\n", when, sub.name,
                                  fish_quoted(sub.what));
        }
        for (const Command::OptionText& option : command.options) {
            if (!option.argument.empty()) continue;
            script += fmt::format("complete -c rovernet -n '{}'", when);
            for (const auto& name : option.short_names) script += " -s " + name;
            for (const auto& name : option.long_names) script += " -l " + name;
            script += fmt::format(" -d {}\n", fish_quoted(option.what));
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

std::string roff_option(const Command::OptionText& option) {
    std::string name = option.argument;
    if (name.empty()) {
        name = fmt::format("{}", fmt::join(names_of(option), ", "));
        if (!option.type.empty()) name += " " + option.type;
    }
    std::string what = option.what;
    if (!option.usual.empty()) what += fmt::format(" (default: {})", option.usual);
    return fmt::format(".TP\n.B {}\n{}\n", roff(name), roff(what));
}

}  // namespace

std::string completion_script(const Command::Text& program, const std::string& shell) {
    if (shell == "bash") return bash_script(program);
    if (shell == "zsh") {
        return "#compdef rovernet\nautoload -U +X bashcompinit && bashcompinit\n" +
               bash_script(program);
    }
    if (shell == "fish") return fish_script(program);
    throw std::invalid_argument(
        fmt::format("SHELL: unknown \"{}\"; expected one of bash, zsh, fish", shell));
}

std::string man_page(const Command::Text& program) {
    std::string page = fmt::format(
        ".TH ROVERNET 1 \"\" \"rovernet {}\"\n.SH NAME\nrovernet \\- discrete-event simulator of "
        "wireless networks of moving robots\n.SH SYNOPSIS\n.B rovernet\n.I COMMAND\n[OPTIONS]\n"
        ".SH COMMANDS\n",
        roff(std::string(version())));
    for_each_command(program, "", [&](const Command::Text& command, const std::string& words) {
        if (words.empty() || !command.commands.empty()) return;
        page += fmt::format(".SS rovernet {}\n{}.\n", words, roff(command.what));
        for (const Command::OptionText& option : command.options) page += roff_option(option);
        if (command.examples.empty()) return;
        page += fmt::format(".PP\nExamples:\n.PP\n.nf\n{}.fi\n", roff(command.examples));
    });
    return page + R"(.SH EXIT STATUS
0: done. 1: failed. 2: the command line is wrong. 3: an input file is wrong. 4: some runs of a
study failed. 130: interrupted.
)";
}

}  // namespace rovernet::cli
