// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/draw/color.hpp"

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rovernet {

/// A number as pictures write it: at most two decimals, no needless zeros, never "-0". What is not
/// finite or beyond 1e9 is written as the nearest number that is not.
std::string svg_number(double v);

/// Text for XML: markup characters are escaped; what XML cannot hold (control characters, bytes
/// that are no UTF-8) becomes U+FFFD.
std::string xml_text(std::string_view text);

/// `text` cut to at most `most` >= 1 characters, the last of which is then an ellipsis.
std::string shortened(std::string_view text, std::size_t most);

/// About how wide a text is [px] in the picture's font; an estimate from above.
double text_width(std::string_view text, double size);

/// An attribute of an element: a number, a colour or a text.
struct SvgAttribute {
    std::string_view name;
    std::string value;

    SvgAttribute(std::string_view n, double v) : name(n), value(svg_number(v)) {}
    SvgAttribute(std::string_view n, Color v) : name(n), value(hex(v)) {}
    SvgAttribute(std::string_view n, std::string v) : name(n), value(std::move(v)) {}
    SvgAttribute(std::string_view n, const char* v) : name(n), value(v) {}
};
using SvgAttributes = std::initializer_list<SvgAttribute>;

/// The data of a <path>, in pixels. Equal coordinates are equal texts, so that shapes which share
/// an edge share it exactly.
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

/// Anchor of a text: where it begins, or ends, or has its middle.
enum class TextAnchor { start, middle, end };

/// Style of a text.
struct TextStyle {
    double size = 12;  ///< [px]
    TextAnchor anchor = TextAnchor::start;
    bool bold = false;
    bool halo = false;  ///< a white seam that keeps it readable on anything
    Color color{0x22, 0x22, 0x22};
};

/// Writes a Scalable Vector Graphics document, element by element. The same calls make the same
/// bytes everywhere.
class Svg {
  public:
    /// @param width, height  > 0, of the document in its own units
    /// @param scale          [px] of a unit, > 0
    Svg(double width, double height, double scale = 1);

    /// An element without content.
    void add(std::string_view element, SvgAttributes attributes);
    /// A line of text with its baseline at y.
    void text(double x, double y, std::string_view text, const TextStyle& style = {});
    /// The <title> of what is open: what a viewer shows for it.
    void title(std::string_view text);
    /// Opens an element; what follows is inside until close().
    void open(std::string_view element, SvgAttributes attributes);
    void close();

    /// The whole document; everything that is open is closed.
    std::string finish();

  private:
    void begin(std::string_view element, SvgAttributes attributes);

    std::string out_;
    std::vector<std::string> open_;
};

}  // namespace rovernet
