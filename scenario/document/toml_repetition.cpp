// SPDX-License-Identifier: MIT
#include "scenario/document/toml_repetition.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace rovernet {
namespace {

constexpr std::string_view white = " \t";
constexpr std::string_view of_header = "parsing table header";  // in messages of the parser

/// First byte of a line from `at` on that is not blank; the size of the line if all are blank.
std::size_t behind_blanks(std::string_view line, std::size_t at) {
    return std::min(line.find_first_not_of(white, at), line.size());
}

/// End of the quoted text that begins at `at`: the byte behind its closing quote.
std::size_t end_of_quoted(std::string_view line, std::size_t at) {
    const char quote = line[at];
    for (std::size_t i = at + 1; i < line.size(); ++i) {
        if (line[i] == '\\' && quote == '"') {
            ++i;
        } else if (line[i] == quote) {
            return i + 1;
        }
    }
    return line.size();
}

bool is_quote(char c) { return c == '"' || c == '\''; }

/// Keys joined by dots that begin at a byte of a line, such as `vary . "a.b"`.
struct KeyPath {
    std::size_t begin = 0;
    int keys = 0;
    std::string text;  ///< as written, without the blanks; a single key without its quotes

    /// @param last  byte at or before which the last key begins
    KeyPath(std::string_view line, std::size_t at, std::size_t last)
        : begin(behind_blanks(line, at)) {
        for (std::size_t key = begin; key < line.size() && key <= last;) {
            const std::size_t end = is_quote(line[key])
                                        ? end_of_quoted(line, key)
                                        : std::min(line.find_first_of(" \t.=]", key), line.size());
            text += (++keys > 1 ? "." : "") + std::string(line.substr(key, end - key));
            const std::size_t dot = behind_blanks(line, end);
            if (dot >= line.size() || line[dot] != '.') break;
            key = behind_blanks(line, dot + 1);
        }
        if (keys == 1 && text.size() > 1 && is_quote(text.front()))
            text = text.substr(1, text.size() - 2);
    }
};

/// Begin of the key of a line before a byte: behind the last comma or brace that is not in quotes.
std::size_t begin_of_key(std::string_view line, std::size_t before) {
    std::size_t begin = 0;
    for (std::size_t i = 0; i < before;) {
        if (line[i] == ',' || line[i] == '{') begin = i + 1;
        i = is_quote(line[i]) ? end_of_quoted(line, i) : i + 1;
    }
    return begin;
}

/// Column of a byte of a line, in characters from 1.
int column_of(std::string_view line, std::size_t byte) {
    const auto begins = [](char c) { return (static_cast<unsigned char>(c) & 0xc0U) != 0x80; };
    return 1 + static_cast<int>(std::count_if(
                   line.begin(), line.begin() + static_cast<std::ptrdiff_t>(byte), begins));
}

/// Message for a header [NAME] or [[NAME]].
/// @param what    kind of the value that has the name
/// @param inside  true: the value is that of a key before the last dot of the name
std::string header_message(const KeyPath& name, std::string_view what, bool inside) {
    if (what.empty()) {
        return fmt::format(
            "[{}]: this name begins with a table that is written in braces, so no keys can be "
            "added to that table; write all keys of that table inside the braces, or all of them "
            "under a header [NAME], without braces",
            name.text);
    }
    if (inside) {
        return fmt::format(
            "[{}]: this name begins with a key that already has a value, so no keys can be added "
            "to that key; give this table a different name, or remove that key",
            name.text);
    }
    if (name.text == "robot" || name.text == "traffic") {
        return fmt::format(
            "[{0}] occurs a second time; in a list of tables, write [[{0}]] before each table",
            name.text);
    }
    if (!what.starts_with("table"))
        return fmt::format("the key \"{}\" occurs a second time; expected the key once", name.text);
    return fmt::format(
        "[{0}] occurs a second time; expected one header [{0}], and all keys of this table below "
        "it",
        name.text);
}

/// Message for a key, of which `what` is the first value's kind.
std::string key_message(const KeyPath& name, std::string_view what) {
    return fmt::format(
        "the key \"{}\" occurs a second time; expected {}", name.text,
        what.starts_with("table") ? "all keys of this table in one place" : "the key once");
}

}  // namespace

bool is_about_line_above(std::string_view line, std::size_t at, std::string_view description) {
    if (at > 0 || description.find(of_header) == description.npos) return false;
    const std::size_t begin = description.find('\'') + 1, end = description.find('\'', begin);
    if (end == description.npos) return false;
    std::string named = KeyPath(line, line.find_first_not_of(" \t["), line.size()).text;
    std::erase_if(named, is_quote);
    return named != description.substr(begin, end - begin);
}

std::optional<TomlMistake> toml_repetition(std::string_view line, std::size_t at, int number,
                                           int column, std::string_view description) {
    constexpr std::string_view twice = "cannot redefine existing ";
    const std::size_t found = description.find(twice);
    const bool is_inline = description.find("into existing inline table") != description.npos;
    if (found == description.npos && !is_inline) return std::nullopt;
    const std::string_view what =
        is_inline ? std::string_view() : description.substr(found + twice.size());

    const std::size_t first = behind_blanks(line, 0);
    if (description.find(of_header) != description.npos) {
        const std::size_t brackets = std::min(line.find_first_not_of('[', first), line.size());
        const KeyPath name(line, brackets, line.size());
        // The parser stops at the bracket if the last key of the name has a value.
        const bool inside = at > first;
        return TomlMistake{header_message(name, what, inside), number, column_of(line, first)};
    }
    // The parser stops at the key that has a value, or behind the sign = of the last key.
    const bool is_last = description.find("as dotted key-value pair") == description.npos;
    const KeyPath name(line, begin_of_key(line, at), at);
    if (name.keys == 0)
        return TomlMistake{"a key occurs a second time; expected the key once", number, column};
    return TomlMistake{key_message(name, what), number, column_of(line, is_last ? name.begin : at)};
}

}  // namespace rovernet
