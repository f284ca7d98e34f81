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

/// The command line: commands with their options, how they are read and how they are listed. It is
/// CLI11 behind two handles, so that only command_line.cpp pays for reading that library's headers.
namespace rovernet::cli {

/// Check of an option's text.
struct Check {
    const char* kind;  ///< kind of value, in --help; may be empty
    /// What is wrong with a text; empty if nothing.
    std::function<std::string(const std::string& text)> fault;
};

/// Option of a command, or an argument without a name. A handle: cheap to copy; the command keeps
/// the option. Each function returns the option itself.
class Option {
  public:
    explicit Option(CLI::Option* option) : option_(option) {}

    Option required() const;
    /// Shows the variable's present value as the default.
    Option shows_default() const;
    /// Takes several values in one word, between these characters.
    Option delimiter(char between) const;
    /// Its value may be left out; then it is `text`.
    Option usually(const char* text) const;
    /// Takes one word each time that it is given.
    Option one_word() const;
    Option check(const Check& check) const;
    /// Takes numbers from `lowest` to `highest` only.
    Option range(int lowest, int highest) const;
    Option range(double lowest, double highest) const;
    /// Takes these words only.
    Option one_of(const std::vector<std::string>& words) const;
    /// Changes the text before it is checked and read.
    Option transform(std::string (*changed)(const std::string& text)) const;
    Option excludes(Option other) const;
    Option needs(Option other) const;

  private:
    CLI::Option* option_;
};

/// One command: the program itself, or one below another. A handle: cheap to copy.
class Command {
  public:
    explicit Command(CLI::App* command) : command_(command) {}

    /// Adds a command below this one.
    Command add_command(const char* name, const char* what) const;
    /// Adds an option whose value goes to `value`, which has to live as long as the command. Types:
    /// text, int, unsigned 64-bit numbers and double, optional ones, lists of text and of 32-bit
    /// numbers.
    /// @param name  "--seed", "-o,--output", or "FILE" for an argument without a name
    template <class T>
    Option add_option(const char* name, T& value, const char* what) const;
    Option add_flag(const char* name, bool& value, const char* what) const;
    /// Adds a flag that does something at once.
    Option add_flag(const char* name, const std::function<void()>& act, const char* what) const;
    /// Option that was added under this name.
    Option option(const char* name) const;

    /// What the command does once its words are read. @return exit code
    void runs(const std::function<int()>& act) const;
    /// Asks for one of the commands below this one.
    void needs_command() const;
    /// Leaves the command out of every list.
    void hide() const;
    /// Lines under "Examples" in --help and in the man page.
    void add_examples(std::initializer_list<const char*> lines) const;

    /// Texts of an option, to be listed.
    struct OptionText {
        std::vector<std::string> short_names, long_names;  ///< without dashes
        std::string argument;                              ///< its name, if it has no dashes
        std::string type, what, usual;                     ///< type is empty if it takes no value
    };
    /// Texts of a command and of those below it that are not hidden.
    struct Text {
        std::string name, what, examples;
        std::vector<OptionText> options;
        std::vector<Text> commands;
    };
    Text text() const;

  private:
    CLI::App* command_;
};

/// Reads a command line and runs the command that it names.
/// @param declare  adds the commands below the program
/// @return exit code
int run_command_line(int argc, char** argv, const char* name, const char* what,
                     const std::string& version,
                     const std::function<void(Command program)>& declare);

}  // namespace rovernet::cli
