// SPDX-License-Identifier: MIT
#include "mobility/files/setdest_line.hpp"

#include "files/word.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

namespace rovernet {
namespace {

constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

/// Words of a line up to its comment and the `;` at its end.
class Words {
  public:
    Words(std::string_view line, const Location& where) : line_(line), where_(where) {
        line_ = line_.substr(0, line_.find('#'));
        while (!line_.empty() && (is_blank(line_.back()) || line_.back() == ';')) {
            line_.remove_suffix(1);
        }
    }
    Word peek() {
        while (at_ < line_.size() && is_blank(line_[at_])) ++at_;
        std::size_t end = at_;
        while (end < line_.size() && !is_blank(line_[end])) ++end;
        return {line_.substr(at_, end - at_), static_cast<int>(at_) + 1};
    }
    Word next() {
        const Word word = peek();
        at_ += word.text.size();
        return word;
    }
    /// Continues with the text between the quotes as the rest of the line.
    void unquote() {
        const Word first = peek();
        if (!first.text.starts_with('"')) fail_at(where_, first, "a command in quotes (\")");
        ++at_;
        if (line_.size() == at_ || line_.back() != '"') {
            fail_at(where_, {{}, static_cast<int>(line_.size()) + 1}, "a closing quote (\")");
        }
        line_.remove_suffix(1);
    }
    /// @throws InputError if there is another word
    void end() {
        const Word word = next();
        if (!word.text.empty()) fail_at(where_, word, "the end of the command");
    }
    [[noreturn]] void fail(Word word, std::string_view expected,
                           const std::vector<std::string>& candidates) const {
        const auto suggestion = did_you_mean(word.text, candidates);
        fail_at(where_, word,
                suggestion.empty() ? std::string(expected)
                                   : fmt::format("{}; {}", expected, suggestion));
    }

  private:
    std::string_view line_;
    const Location& where_;
    std::size_t at_ = 0;
};

std::uint8_t axis_of(Word word, const Words& words) {
    if (word.text == "X_") return 0;
    if (word.text == "Y_") return 1;
    if (word.text == "Z_") return 2;
    words.fail(word, "X_, Y_ or Z_", {"X_", "Y_", "Z_"});
}

/// Checks that a command which places or moves a node has a node with brackets.
/// @param rest  words after the name of the node
/// @throws NoBracketsError if there are none
void check_brackets(Word name, Words rest, const Location& where) {
    if (!name.text.starts_with('$') || name.text.find('(') != name.text.npos) return;
    rest.next();
    const std::string_view verb = rest.next().text, axis = rest.next().text;
    const bool is_axis = axis == "X_" || axis == "Y_" || axis == "Z_";
    if (verb != "setdest" && (verb != "set" || !is_axis)) return;
    constexpr std::size_t longest = 40;
    const std::string_view number = name.text.substr(name.text.find_last_not_of("0123456789") + 1);
    throw NoBracketsError(
        {where.source, where.line, name.column},
        fmt::format("found \"{}\", expected a node as in $node_({}): names without brackets are "
                    "not read",
                    printable(name.text, longest), number.empty() ? "0" : number));
}

/// Parses a command to a node; `line` already has its time.
void parse_command(Words& words, const Location& where, bool scheduled, SetdestLine& line) {
    check_brackets(words.peek(), words, where);
    line.node = node_number(words.next(), where);
    const Word verb = words.next();
    if (verb.text == "set") {
        line.kind = scheduled ? SetdestLine::Kind::jump : SetdestLine::Kind::place;
        line.axis = axis_of(words.next(), words);
        line.x = coordinate(words.next(), where);
    } else if (verb.text == "setdest" && scheduled) {
        line.kind = SetdestLine::Kind::setdest;
        line.x = coordinate(words.next(), where);
        line.y = coordinate(words.next(), where);
        line.speed = pace(words.next(), where);
    } else if (verb.text == "setdest") {
        fail_at(where, verb, "set; a setdest needs a time: $ns_ at 0.0 \"$node_(0) setdest ...\"");
    } else if (scheduled) {
        words.fail(verb, "setdest or set", {"setdest", "set"});
    } else {
        words.fail(verb, "set", {"set"});
    }
    words.end();
}

bool is_to_god(Word word) { return word.text.starts_with("$god"); }

}  // namespace

SetdestLine parse_setdest_line(std::string_view text, const Location& where) {
    SetdestLine line;
    Words words(text, where);
    const Word first = words.peek();
    if (first.text.empty() || is_to_god(first)) return line;
    if (first.text != "$ns_" && first.text != "$ns") {
        if (first.text.find('(') == first.text.npos) {
            check_brackets(first, words, where);
            words.fail(first, "$node_(0) set ..., $ns_ at ..., $god_ ... or a comment (#)",
                       {"$ns_", "$god_", "$node_(0)"});
        }
        parse_command(words, where, false, line);
        return line;
    }
    words.next();
    const Word at = words.next();
    if (at.text != "at") words.fail(at, "at", {"at"});
    line.time = moment(words.next(), where);
    words.unquote();
    if (is_to_god(words.peek())) return {};
    parse_command(words, where, true, line);
    return line;
}

}  // namespace rovernet
