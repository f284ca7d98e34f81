// SPDX-License-Identifier: MIT
#include "scene/stage/world_scanner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

namespace rovernet {
namespace {

using Kind = WorldToken::Kind;

// Functions of the C library depend on the locale.
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_numeric(char c) { return is_digit(c) || c == '+' || c == '-' || c == '.'; }
bool is_word(char c) {
    return is_letter(c) || is_digit(c) || c == '.' || c == '-' || c == '_' || c == '[' || c == ']';
}

/// Reads the number at the start of `text`; returns the rest, or empty if there is no number.
std::optional<std::string_view> read_number(std::string_view text, double& out) {
    if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
    if (error != std::errc{} || !std::isfinite(out)) return std::nullopt;
    return text.substr(static_cast<std::size_t>(end - text.data()));
}

/// Number without an exponent, or "" if that would be long.
std::string decimals(double value) {
    if (value != 0 && (std::abs(value) < 1e-12 || std::abs(value) > 1e12)) return "";
    char digits[64];
    const auto [end, error] =
        std::to_chars(digits, digits + sizeof digits, value, std::chars_format::fixed);
    return error == std::errc{} ? std::string(digits, end) : "";
}

/// Length of the UTF-8 character at the start of `text`, or 0 if it is invalid. Surrogates and
/// overlong forms are not detected.
std::size_t character_length(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned lead = byte(0);
    const std::size_t length = lead < 0x80                   ? 1
                               : lead >= 0xC2 && lead < 0xE0 ? 2
                               : lead >= 0xE0 && lead < 0xF0 ? 3
                               : lead >= 0xF0 && lead < 0xF5 ? 4
                                                             : 0;
    if (length > text.size()) return 0;
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xC0) != 0x80) return 0;
    }
    return length;
}

/// Position of the first invalid character in `text`; npos if there is none.
std::size_t first_bad(std::string_view text) {
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = character_length(text.substr(i));
        const auto byte = static_cast<unsigned char>(text[i]);
        const bool control = (byte < 0x20 && byte != '\t') || byte == 0x7F;
        if (length == 0 || control) return i;
        i += length;
    }
    return text.npos;
}

}  // namespace

WorldScanner::WorldScanner(std::string_view text, int file, std::string source)
    : text_(text), source_(std::move(source)), file_(file) {
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    if (text_.starts_with(byte_order_mark)) at_ = line_begin_ = byte_order_mark.size();
}

WorldToken WorldScanner::next() {
    skip_blanks();
    if (at_ == text_.size()) return piece(Kind::file_end, 0);
    const char c = here();
    if (c == '\n' || c == '\r') {
        WorldToken token = piece(Kind::line_end, 1);
        const char second = here();
        if ((second == '\n' || second == '\r') && second != c) ++at_;
        end_line();
        return token;
    }
    if (c == '(') return piece(Kind::open, 1);
    if (c == ')') return piece(Kind::close, 1);
    if (c == '[') return piece(Kind::open_tuple, 1);
    if (c == ']') return piece(Kind::close_tuple, 1);
    if (c == '"') return quoted();
    if (is_letter(c)) return word();
    if (is_numeric(c)) return number();
    reject_character();
}

void WorldScanner::skip_blanks() {
    while (here() == ' ' || here() == '\t') ++at_;
    if (here() != '#') return;
    at_ = std::min(text_.find_first_of("\r\n", at_), text_.size());
}

void WorldScanner::end_line() {
    ++line_;
    line_begin_ = at_;
}

WorldToken WorldScanner::piece(Kind kind, std::size_t length) {
    WorldToken token{.kind = kind,
                     .text = std::string(text_.substr(at_, length)),
                     .file = file_,
                     .line = line_,
                     .column = static_cast<int>(at_ - line_begin_) + 1};
    at_ += length;
    return token;
}

WorldToken WorldScanner::word() {
    std::size_t end = at_;
    int open = 0;  // brackets; one that closes none belongs to the tuple around the word
    for (; end < text_.size() && is_word(text_[end]); ++end) {
        if (text_[end] == '[') ++open;
        if (text_[end] == ']' && --open < 0) break;
    }
    const std::string_view found = text_.substr(at_, end - at_);
    check_length(found);
    if (open > 0) {
        fail(at_, fmt::format("found \"{}\"; expected a key and its value with a blank between "
                              "them; write {} [...]",
                              found, found.substr(0, found.find('['))));
    }
    return piece(Kind::word, found.size());
}

WorldToken WorldScanner::number() {
    std::size_t end = at_;
    while (end < text_.size() && is_numeric(text_[end])) ++end;
    const bool glued = end < text_.size() && (is_letter(text_[end]) || text_[end] == '_');
    while (glued && end < text_.size() && (is_word(text_[end]) || is_numeric(text_[end])) &&
           text_[end] != '[' && text_[end] != ']') {
        ++end;
    }
    const std::string_view found = text_.substr(at_, end - at_);
    double value = 0;
    const auto behind = glued ? std::nullopt : read_number(found, value);
    if (!behind) reject_number(found);
    WorldToken token = piece(Kind::number, found.size());
    token.number = value;
    token.is_cut = !behind->empty();
    return token;
}

WorldToken WorldScanner::quoted() {
    const std::size_t begin = at_ + 1;
    const std::size_t end = text_.find_first_of("\"\r\n", begin);
    if (end == text_.npos || text_[end] != '"') {
        fail(at_,
             "found a text without its end; expected \" at both ends of a text, on one line; add "
             "the second \"");
    }
    const std::string_view found = text_.substr(begin, end - begin);
    if (const std::size_t bad = first_bad(found); bad != found.npos) {
        fail(begin + bad, fmt::format("found the byte 0x{:02X} in a text; expected UTF-8 without "
                                      "control characters; save the file as UTF-8",
                                      static_cast<unsigned char>(found[bad])));
    }
    check_length(found);
    WorldToken token = piece(Kind::text, found.size() + 2);
    token.text = found;
    return token;
}

void WorldScanner::check_length(std::string_view found) const {
    constexpr std::size_t longest = 4096;
    if (found.size() <= longest) return;
    fail(at_, fmt::format("found a word or text of {} bytes; expected at most {}; is this a world "
                          "file?",
                          found.size(), longest));
}

void WorldScanner::fail(std::size_t at, const std::string& message) const {
    throw InputError(Location{source_, line_, static_cast<int>(at - line_begin_) + 1}, message);
}

void WorldScanner::reject_number(std::string_view found) const {
    double value = 0;
    const bool exponent =
        found.find_first_of("eE") != found.npos && read_number(found, value) == "";
    const std::string plain = exponent ? decimals(value) : "";
    if (exponent) {
        fail(at_, fmt::format("found \"{}\"; expected a number without an exponent; write {}",
                              found, plain.empty() ? "all its digits" : plain));
    }
    constexpr std::size_t longest = 60;
    fail(at_, fmt::format("found \"{}{}\"; expected a number, such as -0.5; {}",
                          found.substr(0, longest), found.size() > longest ? "..." : "",
                          is_letter(found.back())
                              ? "numbers in a world file have no units: remove the letters"
                              : "check its signs, points and digits"));
}

void WorldScanner::reject_character() const {
    const char c = here();
    switch (c) {
        case ',':
            fail(at_, "found \",\"; expected blanks between values; write for example [1 2 3]");
        case ';': fail(at_, "found \";\"; expected a blank or a new line; remove the \";\"");
        case '\'': fail(at_, "found \"'\"; expected a text in double quotes; write \"...\"");
        case '=':
            fail(at_,
                 "found \"=\"; expected a key and its value with only a blank between them; write "
                 "for example power 30");
        case '{':
        case '}': fail(at_, fmt::format("found \"{}\"; expected ( and ); write model ( ... )", c));
        case '<':
            fail(at_,
                 "found \"<\"; expected a world of Stage; is this XML, such as a world of "
                 "Gazebo? rovernet cannot read XML worlds");
        case '/': fail(at_, "found \"/\"; expected a key or a value; a comment begins with #");
        default: break;
    }
    const auto byte = static_cast<unsigned char>(c);
    fail(at_, fmt::format("found {}; expected a key or a value; is this a world file?",
                          byte > 0x20 && byte < 0x7F ? fmt::format("\"{}\"", c)
                                                     : fmt::format("the byte 0x{:02X}", byte)));
}

}  // namespace rovernet
