// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace rovernet {

/// Opaque sRGB colour.
struct Color {
    std::uint8_t red = 0;
    std::uint8_t green = 0;
    std::uint8_t blue = 0;
    friend constexpr bool operator==(Color, Color) = default;
};

/// Text of a colour, such as "#1e90ff".
std::string hex(Color c);

/// Lightness of a colour, 0 (black) to 1 (white): the relative luminance of WCAG 2.1.
double luminance(Color c);

/// Colour of category i, distinguishable for colour-blind people, also as lines on white. Colours
/// repeat after seven. Source: M. Okabe and K. Ito, Color Universal Design (2008), without yellow,
/// which is too light for lines.
Color category_color(std::size_t i);

/// Mix of two colours, channel by channel: share a + (1 - share) b; share from 0 to 1.
Color blend(Color a, Color b, double share);

/// Colour scale for numbers, readable for colour-blind people and in grey: luminance is monotone
/// over the 256 colours at x = k / 255 (strictly, where colours differ), while hue varies. In finer
/// steps, rounding may reverse a channel by one unit.
class ColorScale {
  public:
    /// @param anchors  at least two colours, equally spaced; must live until the program ends
    constexpr explicit ColorScale(std::span<const Color> anchors) : anchors_(anchors) {}

    /// Colour at x from 0 to 1; clamped beyond the ends.
    Color at(double x) const;

  private:
    std::span<const Color> anchors_;
};

/// Scale for areas: indigo, blue, teal, green, yellow; larger values are lighter.
extern const ColorScale lagoon;
/// Scale for lines on white: amber, red, purple; larger values are darker.
extern const ColorScale ember;
/// Scale for differences: blue below, white in the middle (no difference), orange above.
extern const ColorScale balance;

}  // namespace rovernet
