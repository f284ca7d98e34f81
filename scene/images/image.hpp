// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace rovernet {

/// Image with 8 bits per channel; row 0 is the top row.
///
/// The samples of a pixel are consecutive. The channels are gray (1 channel), gray and alpha (2),
/// red, green and blue (3), or red, green, blue and alpha (4). Alpha 255 is opaque. Values are as
/// stored in the file: no gamma correction.
struct Image {
    int width = 0;                      ///< width [pixels]
    int height = 0;                     ///< height [pixels]
    int channels = 1;                   ///< samples per pixel, 1 to 4
    std::vector<std::uint8_t> samples;  ///< samples of all pixels: width * height * channels

    bool has_alpha() const { return channels == 2 || channels == 4; }
    /// Sum of red, green and blue of a pixel, 0 to 765; three times the sample of a gray image.
    int rgb_sum(int column, int row) const {
        const std::uint8_t* p = pixel(column, row);
        return channels <= 2 ? 3 * p[0] : p[0] + p[1] + p[2];
    }
    /// Opacity of a pixel, 0 (transparent) to 255 (opaque); 255 without an alpha channel.
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

/// Largest image that is read [pixels]; the header is checked before memory is allocated.
inline constexpr std::int64_t max_image_pixels = 256'000'000;

/// Whether the name has an extension of an image file: .png, .jpg, .bmp, .gif, .pgm and others.
bool is_image_name(const std::string& path);

/// Reads a PNG, JPEG, BMP, GIF (its first frame), PGM, PPM or PBM.
///
/// The format is detected from the file's first bytes, not from its name. 16-bit samples and other
/// maxvals are scaled to 0..255 and rounded to nearest; palettes are expanded; transparent colours
/// become alpha. JPEG samples are as decoded by stb_image; decoders may differ by about 1.
/// @throws InputError if the file is missing, not a regular file, of another format, damaged or too
///         large
Image read_image(const std::string& path);

}  // namespace rovernet
