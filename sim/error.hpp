// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

// Errors whose cause a user can mend, and the words for them. A caller's mistake in C++ is a
// std::invalid_argument instead; a packet that is lost is a record, never an exception.

namespace rovernet {

/// Place in an input that an error is about: a place in a file, a whole file (line 0), or an option
/// of the command line.
struct Location {
    /// File as the user named it, or the option's text as it was typed.
    std::string source;
    /// Line, from 1; 0: the whole source.
    int line = 0;
    /// Column, from 1.
    int column = 0;
    /// The source is an option of the command line: the command ends as for a mistake in its use.
    bool is_option = false;

    /// Place as an error begins with it: "file:line:column", "file", or "--set text"; empty for no
    /// place.
    std::string text() const;
};

/// Error in the input, which its author can mend. what() reads "place: what was found; what was
/// expected; a suggestion", without the place if there is none.
///
/// Readers of scenarios, worlds, movement files and traces throw it. The command prints what() and
/// ends with the code for a bad input, or for wrong use if the place is an option.
class InputError : public std::runtime_error {
  public:
    /// @param where    what the message is about
    /// @param message  what was found and what was expected, without the place
    InputError(Location where, const std::string& message);
    /// Place that the message is about.
    const Location& where() const { return where_; }
    /// The message without its place.
    const std::string& message() const { return message_; }

  private:
    // Place, and message without it.
    Location where_;
    std::string message_;
};

/// Error of a run whose input may be well-formed: the event limit is reached, or a file cannot be
/// written. what() says what can be done about it.
class RunError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Error of a run whose time does not go on: the events of a robot follow one another without end.
/// It is a fault of a movement, a protocol or a reaction, never of an input.
class StalledRun : public RunError {
  public:
    using RunError::RunError;
};

/// Suggestion for a word that is not known: "did you mean \"...\"?", or "" if no candidate is near.
///
/// The nearest candidate is the one with the least edit distance: letters to insert, remove or
/// replace, and neighbours to swap. A candidate that differs in upper and lower case only has
/// distance 0; one that contains the word, of three letters or more, has distance 1. It is near if
/// at most half of the word's letters have to change (but one may), and not all of them. Words of
/// more than 64 bytes get no suggestion. The first of several equally near ones is taken.
///
/// @param word        what was found
/// @param candidates  what could have stood there
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace rovernet
