// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

// Errors that a user can correct, and their messages. A wrong argument of a C++ call is a
// std::invalid_argument instead; a lost packet is a record, never an exception.

namespace rovernet {

/// Place of an error in an input: a position in a file, a whole file (line 0), or an option of the
/// command line.
struct Location {
    /// File as the user named it, or the option's text as typed.
    std::string source;
    /// Line of the file, from 1; 0 stands for the whole file.
    int line = 0;
    /// Column of the line, from 1.
    int column = 0;
    /// True if the source is an option of the command line: the command then ends with the exit
    /// code for wrong use.
    bool is_option = false;

    /// Place as printed at the start of an error: "file:line:column", "file", or "--set text";
    /// empty if there is no place.
    std::string text() const;
};

/// Error in the input of a run, which the user can correct. what() reads "place: what was found;
/// what was expected; a suggestion", without the place if there is none.
///
/// Readers of scenarios, worlds, movement files and traces throw an InputError. The command prints
/// what() and ends with the exit code for bad input, or for wrong use if the place is an option.
class InputError : public std::runtime_error {
  public:
    /// @param where    place of the error
    /// @param message  what was found and what was expected, without the place
    InputError(Location where, const std::string& message);
    /// Place of the error in the input.
    const Location& where() const { return where_; }
    /// Message of the error without its place.
    const std::string& message() const { return message_; }

  private:
    // Place of the error, and message without the place.
    Location where_;
    std::string message_;
};

/// Error of a run with valid input: the event limit is reached, or a file cannot be written, for
/// example. what() includes what the user can do.
class RunError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Error of a run in which simulated time hardly grows: the events of a robot follow one another
/// without end. The cause is a fault of a movement, a protocol or a reaction, never of an
/// input.
class StalledRun : public RunError {
  public:
    using RunError::RunError;
};

/// Suggestion for an unknown word: "did you mean \"...\"?", or "" if no candidate is similar.
///
/// The candidate with the least edit distance is suggested: number of letters to insert, remove or
/// replace, and of neighbouring letters to swap. A candidate that differs only in upper and lower
/// case has distance 0; a candidate that contains the word (three letters or more) has distance 1.
/// A candidate is similar if at most half of the word's letters have to change (one letter may
/// always change), and not all of them. Words of more than 64 bytes get no suggestion. Among equal
/// distances the first candidate is taken.
///
/// @param word        unknown word that was found
/// @param candidates  words that are valid here
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace rovernet
