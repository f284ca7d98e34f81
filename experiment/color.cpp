// SPDX-License-Identifier: MIT
#include "experiment/color.hpp"

#include "sim/math.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace rovernet {
namespace {

// About equal steps of lightness in the OKLCH space, from 0.30 to 0.935, hue from 303 to 103
// degrees by way of blue, chroma as large as sRGB holds; moved by a few units so that luminance
// rises at each of the 255 steps.
constexpr std::array lagoon_anchors{
    Color{0x3a, 0x1a, 0x5a}, Color{0x3f, 0x2a, 0x71}, Color{0x46, 0x39, 0x8d},
    Color{0x3c, 0x4c, 0x9f}, Color{0x3a, 0x64, 0xa6}, Color{0x2d, 0x7b, 0xb4},
    Color{0x31, 0x92, 0xb1}, Color{0x1a, 0xa7, 0xb3}, Color{0x32, 0xbe, 0xa9},
    Color{0x50, 0xd5, 0x9e}, Color{0x7a, 0xe3, 0x94}, Color{0xc1, 0xea, 0x73},
    Color{0xff, 0xee, 0x51}};

constexpr std::array ember_anchors{Color{0xf3, 0xb3, 0x4c}, Color{0xee, 0x8c, 0x3a},
                                   Color{0xdd, 0x63, 0x35}, Color{0xbd, 0x3e, 0x45},
                                   Color{0x90, 0x28, 0x58}, Color{0x60, 0x1b, 0x59},
                                   Color{0x33, 0x12, 0x45}};

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

std::string hex(Color c) { return fmt::format("#{:02x}{:02x}{:02x}", c.red, c.green, c.blue); }

double luminance(Color c) {
    return 0.2126 * linear(c.red) + 0.7152 * linear(c.green) + 0.0722 * linear(c.blue);
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
