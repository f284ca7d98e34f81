// SPDX-License-Identifier: MIT
#include "pictures/draw/color.hpp"

#include "sim/math.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace rovernet {
namespace {

// About equal steps of lightness in the OKLCH space, from 0.40 to 0.95, hue from 303 to 104 degrees
// by way of blue, chroma as large as sRGB holds; moved by a few units so that luminance rises at
// each of the 255 steps. The dark end leaves room for walls that are darker still.
constexpr std::array lagoon_anchors{
    Color{0x58, 0x2e, 0x84}, Color{0x5a, 0x3f, 0x98}, Color{0x5b, 0x51, 0xac},
    Color{0x53, 0x67, 0xb9}, Color{0x4c, 0x7c, 0xc1}, Color{0x41, 0x91, 0xc4},
    Color{0x43, 0xa4, 0xc3}, Color{0x28, 0xba, 0xc2}, Color{0x2f, 0xce, 0xb6},
    Color{0x51, 0xdf, 0xa8}, Color{0x80, 0xed, 0x93}, Color{0xc4, 0xf3, 0x72},
    Color{0xff, 0xf3, 0x77}};

constexpr std::array ember_anchors{Color{0xf3, 0xb3, 0x4c}, Color{0xee, 0x8c, 0x3a},
                                   Color{0xdd, 0x63, 0x35}, Color{0xbd, 0x3e, 0x45},
                                   Color{0x90, 0x28, 0x58}, Color{0x60, 0x1b, 0x59},
                                   Color{0x33, 0x12, 0x45}};

constexpr std::array balance_anchors{Color{0x00, 0x5a, 0x9c}, Color{0x6f, 0xb1, 0xdc},
                                     Color{0xff, 0xff, 0xff}, Color{0xf0, 0xa8, 0x5c},
                                     Color{0xc0, 0x50, 0x00}};

std::uint8_t sample(double v) {
    return static_cast<std::uint8_t>(std::floor(std::clamp(v, 0.0, 255.0) + 0.5));
}

/// A sample without its gamma. Source: IEC 61966-2-1.
double linear(std::uint8_t v) {
    const double s = v / 255.0;
    return s <= 0.04045 ? s / 12.92 : math::exp2(2.4 * math::log2((s + 0.055) / 1.055));
}

}  // namespace

const ColorScale lagoon{lagoon_anchors};
const ColorScale ember{ember_anchors};
const ColorScale balance{balance_anchors};

std::string hex(Color c) { return fmt::format("#{:02x}{:02x}{:02x}", c.red, c.green, c.blue); }

double luminance(Color c) {
    return 0.2126 * linear(c.red) + 0.7152 * linear(c.green) + 0.0722 * linear(c.blue);
}

Color category_color(std::size_t i) {
    constexpr std::array colors{Color{0x00, 0x72, 0xb2}, Color{0xd5, 0x5e, 0x00},
                                Color{0x00, 0x9e, 0x73}, Color{0xcc, 0x79, 0xa7},
                                Color{0x00, 0x00, 0x00}, Color{0xe6, 0x9f, 0x00},
                                Color{0x56, 0xb4, 0xe9}};
    return colors[i % colors.size()];
}

Color blend(Color a, Color b, double share) {
    const auto mixed = [&](std::uint8_t of_a, std::uint8_t of_b) {
        return sample(of_b + share * (of_a - of_b));
    };
    return {mixed(a.red, b.red), mixed(a.green, b.green), mixed(a.blue, b.blue)};
}

Color ColorScale::at(double x) const {
    const double last = static_cast<double>(anchors_.size() - 1);
    const double place = x > 0 ? std::min(x, 1.0) * last : 0;
    const auto i = std::min(static_cast<std::size_t>(place), anchors_.size() - 2);
    return blend(anchors_[i + 1], anchors_[i], place - static_cast<double>(i));
}

}  // namespace rovernet
