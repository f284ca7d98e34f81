// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/draw/color.hpp"

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rovernet {

/// Text of a number in an SVG: at most two decimals, no trailing zeros, never "-0". Numbers beyond
/// +-1e9 and infinities are clamped to +-1e9; NaN becomes 0.
std::string svg_number(double v);

/// Text converted for XML: markup characters are escaped. Characters that XML forbids (control
/// characters, invalid UTF-8) become U+FFFD.
std::string xml_text(std::string_view text);

/// Text, shortened to at most `most` >= 1 characters; a shortened text ends in an ellipsis.
std::string shortened(std::string_view text, std::size_t most);

/// Estimated width of a text [px] in the picture's font; an upper bound.
double text_width(std::string_view text, double size);

/// Attribute of an SVG element: a number, a colour or a text.
struct SvgAttribute {
    std::string_view name;
    std::string value;

    SvgAttribute(std::string_view n, double v) : name(n), value(svg_number(v)) {}
    SvgAttribute(std::string_view n, Color v) : name(n), value(hex(v)) {}
    SvgAttribute(std::string_view n, std::string v) : name(n), value(std::move(v)) {}
    SvgAttribute(std::string_view n, const char* v) : name(n), value(v) {}
};
using SvgAttributes = std::initializer_list<SvgAttribute>;

/// Data of an SVG <path> [px]. Equal coordinates give equal texts, so that shapes with a common
/// edge meet exactly.
class SvgPath {
  public:
    SvgPath& move(double x, double y);
    SvgPath& line(double x, double y);
    SvgPath& horizontal(double x);
    SvgPath& vertical(double y);
    SvgPath& close();

    bool empty() const { return text_.empty(); }
    const std::string& text() const { return text_; }

  private:
    void append(char command, std::initializer_list<double> numbers);

    std::string text_;
};

/// Anchor of a text: the part of the text (start, middle or end) that lies at the given point.
enum class TextAnchor { start, middle, end };

/// Style of a text in an SVG.
struct TextStyle {
    double size = 12;  ///< text size [px]
    TextAnchor anchor = TextAnchor::start;
    bool bold = false;
    bool halo = false;  ///< white outline around the letters, readable on any background
    Color color{0x22, 0x22, 0x22};
};

/// Writer of an SVG document, element by element. Equal calls give equal bytes on every machine.
class Svg {
  public:
    /// @param width, height  size of the document in units of its coordinates, > 0
    /// @param scale          pixels for each unit [px], > 0
    Svg(double width, double height, double scale = 1);

    /// Adds an SVG element without content.
    void add(std::string_view element, SvgAttributes attributes);
    /// Adds a line of text with its baseline at y.
    void text(double x, double y, std::string_view text, const TextStyle& style = {});
    /// Adds a <title> to the open element, which viewers show as its tooltip.
    void title(std::string_view text);
    /// Opens an SVG element; it contains all further elements until close().
    void open(std::string_view element, SvgAttributes attributes);
    void close();

    /// Closes all open SVG elements and returns the document.
    std::string finish();

  private:
    void begin(std::string_view element, SvgAttributes attributes);

    std::string out_;
    std::vector<std::string> open_;
};

}  // namespace rovernet
