// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

/// Command line: commands with options, their parsing and listing. The classes Option and Command
/// wrap CLI11, so that only command_line.cpp includes CLI11, which is slow to compile.
namespace rovernet::cli {

/// Check of the value of a command-line option, given as text.
struct Check {
    const char* kind;  ///< kind of value, shown in --help; may be empty
    /// Function that returns the error message for a text; empty if the text is valid.
    std::function<std::string(const std::string& text)> fault;
};

/// Option of a command, or a positional argument. Objects are handles, which are cheap to copy. The
/// command owns the option. Each function returns the same option, so that calls can be chained.
class Option {
  public:
    explicit Option(CLI::Option* option) : option_(option) {}

    Option required() const;
    /// Shows the current value of the option's variable as the default in --help.
    Option shows_default() const;
    /// Accepts several values of the option in one word, separated by the character `between`. A
    /// value that contains `between` is in double quotes.
    Option delimiter(char between) const;
    /// Makes the value of the option optional: without a value the option means `text`.
    Option usually(const char* text) const;
    /// Accepts only one word as the value after each occurrence of the option.
    Option one_word() const;
    Option check(const Check& check) const;
    /// Accepts only numbers from `lowest` to `highest` as the option's value.
    Option range(int lowest, int highest) const;
    Option range(double lowest, double highest) const;
    /// Accepts only these words as the option's value.
    Option one_of(const std::vector<std::string>& words) const;
    /// Sets a function that transforms the option's text before the text is checked and read.
    Option transform(std::string (*changed)(const std::string& text)) const;
    Option excludes(Option other) const;
    Option needs(Option other) const;

  private:
    CLI::Option* option_;
};

/// Command: the program itself, or a subcommand. Objects are handles, which are cheap to copy.
class Command {
  public:
    explicit Command(CLI::App* command) : command_(command) {}

    /// Adds a subcommand to the command. @param what  description of the subcommand, for --help
    Command add_command(const char* name, const char* what) const;
    /// Adds an option that sets `value`, which must outlive the command. Types of `value`: text,
    /// int, unsigned 64-bit numbers, double, std::optional of these, lists of text and of 32-bit
    /// numbers.
    /// @param name  "--seed", "-o,--output", or "FILE" for a positional argument
    template <class T>
    Option add_option(const char* name, T& value, const char* what) const;
    Option add_flag(const char* name, bool& value, const char* what) const;
    /// Adds a flag (option without a value). When the flag is parsed, it calls `act`.
    Option add_flag(const char* name, const std::function<void()>& act, const char* what) const;
    /// Option of the command with this name.
    Option option(const char* name) const;

    /// Sets the function `act` that executes the command after parsing and returns the exit code.
    void runs(const std::function<int()>& act) const;
    /// Requires that the user names a subcommand of the command.
    void needs_command() const;
    /// Hides the command in --help, man page and completion.
    void hide() const;
    /// Adds lines to the section "Examples" of the command's --help text and man page.
    void add_examples(std::initializer_list<const char*> lines) const;

    /// Texts of an option, for --help, the man page and completion.
    struct OptionText {
        std::vector<std::string> short_names, long_names;  ///< names of the option, without dashes
        std::string argument;                              ///< name of a positional argument
        std::string type, what, usual;  ///< type of value (empty for a flag), description, default
    };
    /// Texts of a command and of its visible subcommands, for --help, the man page and completion.
    struct Text {
        std::string name, what, examples;
        std::vector<OptionText> options;
        std::vector<Text> commands;
    };
    Text text() const;

  private:
    CLI::App* command_;
};

/// Parses a command line and runs its command.
/// @param declare  function that adds the commands of the program
/// @return exit code
int run_command_line(int argc, char** argv, const char* name, const char* what,
                     const std::string& version,
                     const std::function<void(Command program)>& declare);

}  // namespace rovernet::cli
