// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace rovernet {

/// A colour of sRGB, opaque.
struct Color {
    std::uint8_t red = 0;
    std::uint8_t green = 0;
    std::uint8_t blue = 0;
    friend constexpr bool operator==(Color, Color) = default;
};

/// Text of a colour, as in "#1e90ff".
std::string hex(Color c);

/// Lightness of a colour, 0 (black) to 1 (white): the relative luminance of WCAG 2.1.
double luminance(Color c);

/// Colours that tell things apart for every kind of eyes, also as lines on white; they come again
/// after seven. Source: M. Okabe and K. Ito, Color Universal Design (2008), without the yellow,
/// which is too light for a line.
Color category_color(std::size_t i);

/// `share` of `a` over 1 - share of `b`, sample by sample; share from 0 to 1.
Color blend(Color a, Color b, double share);

/// Colours for numbers, for every kind of eyes and for grey paper: luminance is monotone over
/// the 256 colours at k / 255 (strictly, where they differ), and hue goes its own way from end to
/// end. In finer steps the rounding of a sample may take back one unit.
class ColorScale {
  public:
    /// @param anchors  at least two, equally spaced; they live as long as the program
    constexpr explicit ColorScale(std::span<const Color> anchors) : anchors_(anchors) {}

    /// The colour at x from 0 to 1; held beyond the ends.
    Color at(double x) const;

  private:
    std::span<const Color> anchors_;
};

/// Scale for areas: indigo, blue, teal, green, yellow; the more the lighter.
extern const ColorScale lagoon;
/// Scale for lines on white: amber, red, purple; the more the darker.
extern const ColorScale ember;

}  // namespace rovernet
