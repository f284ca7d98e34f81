// SPDX-License-Identifier: MIT
#include "scenario/document/toml_mistake.hpp"

#include "scenario/document/choice.hpp"
#include "scenario/document/toml_repetition.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

namespace rovernet {
namespace {

bool contains(std::string_view text, std::string_view part) { return text.find(part) != text.npos; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_blank(char c) { return c == ' ' || c == '\t'; }

/// Line of a text at which the parser stopped: the whole line, and its parts before and from its
/// column on.
struct Place {
    std::string_view line, before, after;

    Place(std::string_view text, int number, int column) {
        for (int i = 1; i < number; ++i) {
            const std::size_t end = text.find('\n');
            text.remove_prefix(end == text.npos ? text.size() : end + 1);
        }
        text = line = text.substr(0, std::min(text.find('\n'), text.size()));
        std::size_t at = 0;
        for (int characters = 1; at < text.size(); ++at) {
            const bool continues = (static_cast<unsigned char>(text[at]) & 0xc0U) == 0x80;
            if (!continues && characters++ == column) break;
        }
        before = text.substr(0, at);
        after = text.substr(at);
    }
    char next() const { return after.empty() ? '\n' : after.front(); }
    /// Last character before the place that is not blank; 0: none.
    char last() const {
        const auto at = std::find_if_not(before.rbegin(), before.rend(), is_blank);
        return at == before.rend() ? '\0' : *at;
    }
    /// Word of letters at the place; empty: none.
    std::string_view word() const {
        const auto is_letter = [](char c) {
            return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
        };
        const auto end = std::find_if_not(after.begin(), after.end(), is_letter);
        return after.substr(0, static_cast<std::size_t>(end - after.begin()));
    }
};

/// Typographic quote at the begin of a text; empty: none.
std::string_view typographic_quote(std::string_view text) {
    constexpr std::array<std::string_view, 9> quotes = {
        "\u201c", "\u201d", "\u201e", "\u2018", "\u2019", "\u201a", "\u00ab", "\u00bb", "\u00b4"};
    const auto found = std::find_if(quotes.begin(), quotes.end(), [&](std::string_view quote) {
        return text.starts_with(quote);
    });
    return found == quotes.end() ? "" : *found;
}

/// Hint on what stands behind a value.
std::string_view behind_value(const Place& place) {
    const bool is_comma = place.next() == ',';
    if (is_comma && is_digit(place.last()) && place.after.size() > 1 && is_digit(place.after[1]))
        return "write the decimal point as \".\", and texts and quantities in quotes: \"2.5 m\"";
    if (is_comma) return "there must be no comma after the value of a line";
    const char last = place.last();
    const bool is_closed = last == '"' || last == '\'' || last == ']' || last == '}';
    return is_closed ? "write each KEY = VALUE on its own line"
                     : "texts and quantities need quotes: \"30 mW\"";
}

/// Hint on the probable mistake behind a message of the parser; empty: none.
std::string_view advice_for(std::string_view description, const Place& place) {
    struct Slip {
        std::string_view words, advice;
    };
    constexpr Slip slips[] = {
        {"expected '='", "a line is KEY = VALUE, [TABLE] or [[LIST OF TABLES]]"},
        {"expected comma or closing ']'",
         "a list is [\"2 m\", \"3 m\"]: texts and quantities in quotes, commas between, ] at the "
         "end"},
        {"parsing boolean", "write true and false in small letters"},
        {"dangling comma", "remove the comma before }"},
        {"inline table", "a table in braces { } must end on the line on which it begins"},
        {"invalid utf-8", "save the file as UTF-8"},
    };
    if (contains(description, "expected a comment or whitespace")) return behind_value(place);
    for (const Slip& slip : slips) {
        if (contains(description, slip.words)) return slip.advice;
    }
    return "";
}

/// Message for a bare word, or a typographic quote, where a value is expected; empty: neither is
/// there.
std::string value_message(const Place& place) {
    if (const auto quote = typographic_quote(place.after); !quote.empty())
        return fmt::format("found the typographic quote {}; expected the straight quote \" or '",
                           quote);
    const std::string_view word = place.word();
    if (word.empty()) return "";
    const auto truth = truth_in(word);
    return fmt::format("found {} without quotes; did you mean {}?", word,
                       truth ? fmt::format("{}", *truth) : fmt::format("\"{}\"", word));
}

/// Message for a text without its closing quote; empty: the mistake is a different one.
std::string open_text_message(std::string_view description, const Place& place) {
    const bool is_at_end = contains(description, "encountered end-of-file") ||
                           (contains(description, "control characters") &&
                            (place.next() == '\n' || place.next() == '\r'));
    if (!is_at_end || !contains(description, "string")) return "";
    const char quote = contains(description, "literal string") ? '\'' : '"';
    return fmt::format(
        "not TOML: the closing quote of a text is missing; expected {} at the end of the text",
        quote);
}

}  // namespace

TomlMistake toml_mistake(std::string_view text, int line, int column,
                         std::string_view description) {
    Place place(text, line, column);
    if (line > 1 && is_about_line_above(place.line, place.before.size(), description))
        place = Place(text, --line, column = std::numeric_limits<int>::max());
    if (auto twice = toml_repetition(place.line, place.before.size(), line, column, description))
        return *std::move(twice);
    if (contains(description, "could not determine value type")) {
        const std::string message = value_message(place);
        if (!message.empty()) return {message, line, column};
    }
    if (std::string message = open_text_message(description, place); !message.empty())
        return {std::move(message), line, column};
    const std::string_view advice = advice_for(description, place);
    return {fmt::format("not TOML: {}{}{}", description, advice.empty() ? "" : "; ", advice), line,
            column};
}

}  // namespace rovernet
