// SPDX-License-Identifier: MIT
#include "mobility/files/xml_tags.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <limits>

namespace rovernet {
namespace {

constexpr std::string_view blanks = " \t\r\n";
constexpr std::size_t longest_tag = 64 * 1024;  // [bytes]
constexpr std::size_t most_attributes = 64;
constexpr std::size_t deepest = 64;

bool is_name_byte(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == ':' || c == '.' || c == '-' || static_cast<unsigned char>(c) >= 0x80;
}
bool begins_name(char c) {
    return is_name_byte(c) && !(c >= '0' && c <= '9') && c != '.' && c != '-';
}

/// Name at the start of `text`; empty if there is none.
std::string_view name_in(std::string_view text) {
    std::size_t n = 0;
    if (!text.empty() && begins_name(text[0])) {
        while (n < text.size() && is_name_byte(text[n])) ++n;
    }
    return text.substr(0, n);
}

std::size_t skip_blanks(std::string_view text, std::size_t at) {
    return std::min(text.find_first_not_of(blanks, at), text.size());
}

/// Position after the `>` that ends the tag at the start of `text`; npos if it is not read yet.
std::size_t past_tag(std::string_view text) {
    for (std::size_t i = 1; i < text.size(); ++i) {
        if (text[i] == '>') return i + 1;
        if (text[i] != '"' && text[i] != '\'') continue;
        i = text.find(text[i], i + 1);
        if (i == text.npos) break;
    }
    return text.npos;
}

/// Code point of `&...;`, given without its & and ;. Empty if it is invalid.
std::optional<char32_t> code_point(std::string_view reference) {
    if (reference == "lt") return U'<';
    if (reference == "gt") return U'>';
    if (reference == "amp") return U'&';
    if (reference == "quot") return U'"';
    if (reference == "apos") return U'\'';
    if (!reference.starts_with('#')) return std::nullopt;
    const bool hexadecimal = reference.starts_with("#x");
    const char* begin = reference.data() + (hexadecimal ? 2 : 1);
    const char* end = reference.data() + reference.size();
    std::uint32_t n = 0;
    const auto [stop, error] = std::from_chars(begin, end, n, hexadecimal ? 16 : 10);
    const bool is_character = n > 0 && n <= 0x10FFFF && !(n >= 0xD800 && n <= 0xDFFF);
    if (error != std::errc{} || stop != end || !is_character) return std::nullopt;
    return n;
}

void append_utf8(std::string& text, char32_t c) {
    const auto byte = [&](std::uint32_t b) { text += static_cast<char>(b); };
    const auto next = [&](unsigned shift) { byte(0x80 | (c >> shift & 0x3F)); };
    if (c < 0x80) return byte(c);
    if (c < 0x800) {
        byte(0xC0 | c >> 6U);
    } else if (c < 0x10000) {
        byte(0xE0 | c >> 12U);
        next(6);
    } else {
        byte(0xF0 | c >> 18U);
        next(12);
        next(6);
    }
    next(0);
}

}  // namespace

/// Part of the window's tag as a word; sets where() to its line.
Word XmlTags::word_at(std::string_view text) {
    const std::string_view before(source_.window().data(),
                                  static_cast<std::size_t>(text.data() - source_.window().data()));
    const auto lines = std::count(before.begin(), before.end(), '\n');
    where_.line = line_ + static_cast<int>(lines);
    std::uint64_t column = before.size() + 1;
    if (lines > 0) {
        column -= before.rfind('\n') + 1;
    } else {
        column += source_.taken() - line_start_;
    }
    constexpr std::uint64_t most = std::numeric_limits<int>::max();
    return {text, static_cast<int>(std::min(column, most))};
}

/// Throws the error for `found`, a part of the window, shown up to its first blank.
void XmlTags::fail(std::string_view found, std::string_view expected) {
    const Word word = word_at(found.substr(0, found.find_first_of(blanks, 1)));  // sets where_
    fail_at(where_, word, expected);
}

void XmlTags::advance(std::size_t bytes) {
    const std::string_view text = source_.window().substr(0, bytes);
    for (std::size_t i = text.find('\n'); i != text.npos; i = text.find('\n', i + 1)) {
        if (line_ < std::numeric_limits<int>::max()) ++line_;
        line_start_ = source_.taken() + i + 1;
    }
    source_.take(bytes);
}

/// Skips past `end`, which must follow, at least `from` bytes ahead.
void XmlTags::skip_past(std::string_view end, std::size_t from) {
    where_.column = word_at(source_.window()).column;
    const Location begin = where_;
    while (true) {
        const std::size_t found = source_.window().find(end, from);
        if (found != std::string_view::npos) return advance(found + end.size());
        const std::size_t whole = source_.window().size();
        if (whole >= from + end.size()) {
            advance(whole - end.size() + 1);
            from = 0;
        }
        if (!source_.more())
            throw InputError(begin, fmt::format("the comment or processing instruction that begins "
                                                "here has no end, expected \"{}\"",
                                                end));
    }
}

/// Stores the start of the comment at the window's start, if no element was before it.
void XmlTags::keep_head_comment() {
    constexpr std::size_t most = 64 * 1024;
    if (had_root_ || head_comments_.size() >= most) return;
    source_.ensure(most);
    const std::string_view text = source_.window().substr(0, most);
    head_comments_ += text.substr(0, text.find("-->"));
}

/// Moves to the next tag of an element. False at the end of the file.
bool XmlTags::find_tag() {
    while (true) {
        const std::size_t n = source_.window().find_first_not_of(blanks);
        advance(std::min(n, source_.window().size()));
        if (n == std::string_view::npos) {
            if (!source_.more()) return false;
            continue;
        }
        constexpr std::string_view comment = "<!--";
        source_.ensure(comment.size());
        const std::string_view text = source_.window();
        if (text.front() != '<') fail(text.substr(0, text.find('<')), "a tag (<)");
        if (text.starts_with(comment)) {
            keep_head_comment();
            skip_past("-->", comment.size());
        } else if (text.starts_with("<?")) {
            skip_past("?>", 2);
        } else if (text.starts_with("<!")) {
            fail(text.substr(0, 9), "an element");
        } else {
            return true;
        }
    }
}

/// Complete tag at the window's start.
std::string_view XmlTags::tag() {
    while (true) {
        const std::size_t n = past_tag(source_.window());
        if (n != std::string_view::npos && n <= longest_tag) return source_.window().substr(0, n);
        const bool too_long = source_.window().size() > longest_tag;
        if (!too_long && source_.more()) continue;
        where_.column = word_at(source_.window()).column;
        throw InputError(where_, too_long
                                     ? fmt::format("a tag is longer than {} bytes, which is the "
                                                   "limit; check that this is the right file",
                                                   longest_tag)
                                     : "the file ends inside a tag, expected \">\"");
    }
}

XmlTags::Kind XmlTags::next() {
    if (empty_) {
        empty_ = false;
        open_.pop_back();
        return Kind::close;
    }
    advance(length_);
    length_ = 0;
    if (!find_tag()) return close_file();
    const std::string_view text = tag();
    length_ = text.size();
    const bool closes = text.starts_with("</");
    if (closes) {
        parse_close(text);
    } else {
        parse_open(text);
    }
    where_.column = word_at(text).column;
    return closes ? Kind::close : Kind::open;
}

XmlTags::Kind XmlTags::close_file() {
    if (open_.empty() && had_root_) return Kind::end_of_file;
    where_.column = word_at(source_.window()).column;
    throw InputError(
        where_, open_.empty()
                    ? "the file ends, expected an element"
                    : fmt::format("the file ends inside <{0}>, expected </{0}>", open_.back()));
}

void XmlTags::parse_close(std::string_view text) {
    name_ = name_in(text.substr(2));
    const std::size_t end = skip_blanks(text, 2 + name_.size());
    if (open_.empty() || name_ != open_.back() || text[end] != '>') {
        fail(text, open_.empty() ? "an element" : fmt::format("</{}>", open_.back()));
    }
    open_.pop_back();
}

void XmlTags::parse_open(std::string_view text) {
    name_ = name_in(text.substr(1));
    if (name_.empty()) fail(text, "the name of an element after <");
    if (open_.empty() && had_root_) fail(text, "the end of the file after the outermost element");
    if (open_.size() == deepest) fail(text, "elements nested at most 64 levels deep");
    attributes_.clear();
    std::size_t at = 1 + name_.size();
    while (true) {
        const std::size_t begin = skip_blanks(text, at);
        empty_ = text.substr(begin) == "/>";
        if (empty_ || text.substr(begin) == ">") break;
        if (begin == at) fail(text.substr(at), "a blank, \"/>\" or \">\"");
        at = parse_attribute(text, begin);
    }
    had_root_ = true;
    open_.emplace_back(name_);
}

/// Parses the attribute at `at`; returns its end.
std::size_t XmlTags::parse_attribute(std::string_view text, std::size_t at) {
    const std::string_view name = name_in(text.substr(at));
    if (name.empty()) fail(text.substr(at), "an attribute, \"/>\" or \">\"");
    if (attributes_.size() == most_attributes) fail(name, "at most 64 attributes");
    for (const Attribute& other : attributes_) {
        if (other.name == name) fail(name, "each attribute once");
    }
    const std::size_t equals = skip_blanks(text, at + name.size());
    if (text[equals] != '=') fail(text.substr(equals), "\"=\" after an attribute's name");
    const std::size_t quote = skip_blanks(text, equals + 1);
    if (text[quote] != '"' && text[quote] != '\'') fail(text.substr(quote), "a value in quotes");
    const std::size_t end = text.find(text[quote], quote + 1);  // there is one: past_tag() saw it
    const std::string_view value = text.substr(quote + 1, end - quote - 1);
    if (value.find('<') != value.npos) fail(value.substr(value.find('<')), "\"&lt;\" in a value");
    attributes_.push_back({name, value});
    return end + 1;
}

std::optional<Word> XmlTags::value(std::string_view attribute) {
    for (const Attribute& a : attributes_) {
        if (a.name != attribute) continue;
        Word word = word_at(a.value);
        if (a.value.find('&') != a.value.npos) word.text = resolved(word);
        return word;
    }
    return std::nullopt;
}

std::string_view XmlTags::resolved(Word value) {
    const std::string_view text = value.text;
    resolved_.clear();
    for (std::size_t at = 0; at < text.size();) {
        if (text[at] != '&') {
            resolved_ += text[at++];
            continue;
        }
        const std::size_t end = std::min(text.find(';', at), text.size());
        const auto c = code_point(text.substr(at + 1, end - at - 1));
        if (!c || end == text.size()) fail(text.substr(at), "a character reference such as &amp;");
        append_utf8(resolved_, *c);
        at = end + 1;
    }
    return resolved_;
}

void XmlTags::skip_element() {
    const std::size_t depth = open_.size();
    while (open_.size() >= depth) next();
}

void XmlTags::rewind() {
    source_.rewind();
    line_ = 1;
    line_start_ = length_ = 0;
    empty_ = had_root_ = false;
    head_comments_.clear();
    open_.clear();
}

}  // namespace rovernet
