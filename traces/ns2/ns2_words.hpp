// SPDX-License-Identifier: MIT
#pragma once

#include "sim/ids.hpp"
#include "sim/time.hpp"
#include "traces/ns2/ns2_line.hpp"

#include <charconv>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <system_error>

namespace rovernet {

/// Reader of the words of one trace line, from left to right, with checks. If a word has the wrong
/// form, a function returns false, and stores the word and its column in `refused`.
class Ns2Words {
  public:
    explicit Ns2Words(std::string_view line) : line_(line) {}

    Ns2Refused refused;

    /// Next word; empty at the end of the line.
    std::string_view next() {
        while (at_ < line_.size() && is_blank(line_[at_])) ++at_;
        const std::size_t begin = at_;
        while (at_ < line_.size() && !is_blank(line_[at_])) ++at_;
        return line_.substr(begin, at_ - begin);
    }
    /// Next word, without consuming it.
    std::string_view peek() {
        const std::size_t here = at_;
        const std::string_view word = next();
        at_ = here;
        return word;
    }
    /// Rest of the line, without blanks around it.
    std::string_view rest() {
        peek_blanks();
        std::string_view all = line_.substr(at_);
        while (!all.empty() && is_blank(all.back())) all.remove_suffix(1);
        at_ = line_.size();
        return all;
    }
    /// Column of a word in the line, from 1.
    int column(std::string_view word) const {
        return static_cast<int>(word.data() - line_.data()) + 1;
    }

    bool fail(std::string_view word, std::string_view expected) {
        refused = {column(word), word, expected};
        return false;
    }
    bool expect(std::string_view text) {
        const std::string_view word = next();
        return word == text || fail(word, text);
    }
    /// Removes the texts `before` and `after` from the ends of a word, which must have both.
    bool strip(std::string_view& word, std::string_view before, std::string_view after,
               std::string_view expected) {
        if (word.size() < before.size() + after.size() || !word.starts_with(before) ||
            !word.ends_with(after)) {
            return fail(word, expected);
        }
        word = word.substr(before.size(), word.size() - before.size() - after.size());
        return true;
    }
    template <class Integer>
    bool integer(std::string_view word, Integer& value, std::string_view expected, int base = 10) {
        const auto [stop, error] =
            std::from_chars(word.data(), word.data() + word.size(), value, base);
        return (error == std::errc{} && stop == word.data() + word.size()) || fail(word, expected);
    }
    bool robot(std::string_view word, NodeId& node) {
        constexpr std::string_view expected = "a robot's number below 1048576";
        return integer(word, node.value, expected) &&
               (node.value < most_robots || fail(word, expected));
    }
    bool number(std::string_view word, double& value, std::string_view expected) {
        const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        return (error == std::errc{} && stop == word.data() + word.size() &&
                std::isfinite(value)) ||
               fail(word, expected);
    }
    /// Reads a time [s], rounded to 1 ns.
    bool time(std::string_view word, Time& value);

  private:
    static constexpr bool is_blank(char c) { return c == ' ' || c == '\t'; }
    void peek_blanks() {
        while (at_ < line_.size() && is_blank(line_[at_])) ++at_;
    }

    std::string_view line_;
    std::size_t at_ = 0;
};

}  // namespace rovernet
