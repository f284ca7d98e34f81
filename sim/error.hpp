// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// Where in an input something stands: a place in a file, a whole file (line 0), or an option.
struct Location {
    std::string source;      ///< file as the user named it, or the option's text as typed
    int line = 0;            ///< from 1; 0 = the whole source
    int column = 0;          ///< from 1
    bool is_option = false;  ///< source is a command-line option

    /// "file:line:column", "file", or "--set text".
    std::string text() const;
};

/// The input is wrong. what() reads "place: what was found; what was expected; a suggestion".
class InputError : public std::runtime_error {
  public:
    InputError(Location where, const std::string& message);
    const Location& where() const { return where_; }
    /// The message without its place.
    const std::string& message() const { return message_; }

  private:
    Location where_;
    std::string message_;
};

/// The simulation cannot go on (the event limit, say). The input may be well-formed.
class RunError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// "did you mean ...?" for the candidate nearest to `word` by edit distance, or "" if none is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace rovernet
