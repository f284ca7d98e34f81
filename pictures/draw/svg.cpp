// SPDX-License-Identifier: MIT
#include "pictures/draw/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>

namespace rovernet {
namespace {

constexpr std::string_view replacement = "\xef\xbf\xbd";  // U+FFFD

/// Character of a text: its code point, or none for bytes that are no UTF-8, and its length.
struct Character {
    std::uint32_t code = 0;
    std::size_t bytes = 1;
    bool valid = false;
};

/// The shortest code point that needs so many bytes; longer forms of it are not UTF-8.
constexpr std::uint32_t least_code[] = {0, 0, 0x80, 0x800, 0x10000};

Character first_character(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned lead = byte(0);
    if (lead < 0x80) return {lead, 1, true};
    const std::size_t bytes = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
    if (lead < 0xc0 || lead > 0xf4 || text.size() < bytes) return {};
    std::uint32_t code = lead & (0x7fU >> bytes);
    for (std::size_t i = 1; i < bytes; ++i) {
        if ((byte(i) & 0xc0U) != 0x80U) return {};
        code = code << 6U | (byte(i) & 0x3fU);
    }
    const bool surrogate = code >= 0xd800 && code <= 0xdfff;
    if (code < least_code[bytes] || code > 0x10ffff || surrogate) return {};
    return {code, bytes, true};
}

/// Source: XML 1.0, production 2 (Char).
bool allowed_in_xml(const Character& c) {
    if (!c.valid || c.code == 0xfffe || c.code == 0xffff) return false;
    return c.code >= 0x20 || c.code == '\t' || c.code == '\n' || c.code == '\r';
}

template <class Visit>
void for_each_character(std::string_view text, Visit visit) {
    while (!text.empty()) {
        const Character c = first_character(text);
        visit(c, text.substr(0, c.bytes));
        text.remove_prefix(c.bytes);
    }
}

/// Advance widths of DejaVu Sans from " " to "~", rounded up [em / 100].
constexpr std::array<unsigned char, 95> ascii_widths{
    32, 41, 46, 84, 64, 95, 78, 28, 39,  39, 50, 84, 32, 37, 32, 34, 64, 64, 64, 64, 64, 64, 64, 64,
    64, 64, 34, 34, 84, 84, 84, 54, 100, 69, 69, 70, 77, 64, 58, 78, 76, 30, 30, 66, 56, 87, 75, 79,
    61, 79, 70, 64, 62, 74, 69, 99, 69,  62, 69, 39, 34, 39, 84, 50, 50, 62, 64, 55, 64, 62, 36, 64,
    64, 28, 28, 58, 28, 98, 64, 62, 64,  64, 42, 53, 40, 64, 60, 82, 60, 60, 53, 64, 34, 64, 84};

double character_width(const Character& c) {
    constexpr double wide = 1.05, usual = 0.7;  // beyond ASCII
    if (!c.valid || c.code >= 0x1100) return wide;
    return c.code >= 0x20 && c.code < 0x7f ? ascii_widths[c.code - 0x20] / 100.0 : usual;
}

std::string_view name_of(TextAnchor anchor) {
    return anchor == TextAnchor::start ? "start" : anchor == TextAnchor::middle ? "middle" : "end";
}

}  // namespace

std::string svg_number(double v) {
    constexpr double most = 1e9;
    const double bounded = v == v ? std::clamp(v, -most, most) : 0;
    std::string text = fmt::format("{:.2f}", bounded);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text == "-0" ? "0" : text;
}

std::string xml_text(std::string_view text) {
    std::string out;
    for_each_character(text, [&](const Character& c, std::string_view bytes) {
        if (!allowed_in_xml(c)) {
            out += replacement;
            return;
        }
        switch (c.code) {
            case '&': out += "&amp;"; break;
            case '<': out += "&lt;"; break;
            case '>': out += "&gt;"; break;
            case '"': out += "&quot;"; break;
            case '\'': out += "&#39;"; break;
            default: out += bytes;
        }
    });
    return out;
}

std::string shortened(std::string_view text, std::size_t most) {
    std::size_t characters = 0, kept_bytes = 0;
    for_each_character(text, [&](const Character&, std::string_view bytes) {
        if (++characters < most) kept_bytes += bytes.size();
    });
    if (characters <= most) return std::string(text);
    return std::string(text.substr(0, kept_bytes)) + "\xe2\x80\xa6";
}

double text_width(std::string_view text, double size) {
    double em = 0;
    for_each_character(text,
                       [&](const Character& c, std::string_view) { em += character_width(c); });
    return em * size;
}

SvgPath& SvgPath::move(double x, double y) {
    append('M', {x, y});
    return *this;
}

SvgPath& SvgPath::line(double x, double y) {
    append('L', {x, y});
    return *this;
}

SvgPath& SvgPath::horizontal(double x) {
    append('H', {x});
    return *this;
}

SvgPath& SvgPath::vertical(double y) {
    append('V', {y});
    return *this;
}

SvgPath& SvgPath::close() {
    text_ += 'Z';
    return *this;
}

void SvgPath::append(char command, std::initializer_list<double> numbers) {
    char between = command;
    for (const double v : numbers) {
        text_ += between;
        text_ += svg_number(v);
        between = ' ';
    }
}

Svg::Svg(double width, double height, double scale) {
    const std::string w = svg_number(width), h = svg_number(height);
    out_ = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
    open("svg", {{"xmlns", "http://www.w3.org/2000/svg"},
                 {"xmlns:xlink", "http://www.w3.org/1999/xlink"},
                 {"width", scale * width},
                 {"height", scale * height},
                 {"viewBox", fmt::format("0 0 {} {}", w, h)},
                 {"font-family", "DejaVu Sans, Verdana, Helvetica, Arial, sans-serif"}});
}

void Svg::begin(std::string_view element, SvgAttributes attributes) {
    out_.append(open_.size(), ' ');
    fmt::format_to(std::back_inserter(out_), "<{}", element);
    for (const auto& each : attributes) {
        fmt::format_to(std::back_inserter(out_), " {}=\"{}\"", each.name, xml_text(each.value));
    }
}

void Svg::add(std::string_view element, SvgAttributes attributes) {
    begin(element, attributes);
    out_ += "/>\n";
}

void Svg::open(std::string_view element, SvgAttributes attributes) {
    begin(element, attributes);
    out_ += ">\n";
    open_.emplace_back(element);
}

void Svg::close() {
    const std::string element = std::move(open_.back());
    open_.pop_back();
    out_.append(open_.size(), ' ');
    fmt::format_to(std::back_inserter(out_), "</{}>\n", element);
}

void Svg::title(std::string_view text) {
    out_.append(open_.size(), ' ');
    fmt::format_to(std::back_inserter(out_), "<title>{}</title>\n", xml_text(text));
}

void Svg::text(double x, double y, std::string_view text, const TextStyle& style) {
    begin("text", {{"x", x}, {"y", y}, {"font-size", style.size}, {"fill", style.color}});
    if (style.anchor != TextAnchor::start) {
        fmt::format_to(std::back_inserter(out_), " text-anchor=\"{}\"", name_of(style.anchor));
    }
    if (style.bold) out_ += " font-weight=\"bold\"";
    if (style.halo) {
        out_ +=
            " paint-order=\"stroke\" stroke=\"#ffffff\" stroke-width=\"3\""
            " stroke-linejoin=\"round\"";
    }
    fmt::format_to(std::back_inserter(out_), ">{}</text>\n", xml_text(text));
}

std::string Svg::finish() {
    while (!open_.empty()) close();
    return std::move(out_);
}

}  // namespace rovernet
