// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace rovernet {

/// A picture with 8 bits per channel; row 0 is the top row.
///
/// The samples of a pixel stand together: gray; gray, alpha; red, green, blue; or red, green, blue,
/// alpha. Alpha 255 is opaque. Values are as stored: no gamma correction.
struct Image {
    int width = 0;                      ///< pixels
    int height = 0;                     ///< pixels
    int channels = 1;                   ///< samples per pixel, 1 to 4
    std::vector<std::uint8_t> samples;  ///< width * height * channels

    bool has_alpha() const { return channels == 2 || channels == 4; }
    /// Sum of red, green and blue, 0 to 765; three times the sample of a gray picture.
    int rgb_sum(int column, int row) const {
        const std::uint8_t* p = pixel(column, row);
        return channels <= 2 ? 3 * p[0] : p[0] + p[1] + p[2];
    }
    /// Opacity, 0 (transparent) to 255 (opaque); 255 without an alpha channel.
    int alpha(int column, int row) const {
        return has_alpha() ? pixel(column, row)[channels - 1] : 255;
    }

  private:
    const std::uint8_t* pixel(int column, int row) const {
        const auto index = static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                           static_cast<std::size_t>(column);
        return samples.data() + index * static_cast<std::size_t>(channels);
    }
};

/// The largest picture that is read, in pixels; the header is checked before anything is allocated.
inline constexpr std::int64_t max_image_pixels = 64'000'000;

/// Reads a PNG (any colour type, depth and interlacing) or a PGM (P2 or P5, maxval 1 to 65535).
///
/// The file's first bytes decide the kind, not its name. 16-bit samples and other maxvals are
/// scaled to 0..255 and rounded to nearest; palettes are expanded; transparent colours become
/// alpha.
/// @throws InputError if the file is missing, no regular file, neither kind, damaged or too large
Image read_image(const std::string& path);

}  // namespace rovernet
