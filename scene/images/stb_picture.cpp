// SPDX-License-Identifier: MIT
#include "scene/images/image_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <memory>

// SIMD is off, so that an image has the same pixels on every machine. Size limits and readers of
// text formats are implemented here instead.
#define STBI_NO_SIMD
#define STBI_NO_STDIO
#define STBI_ONLY_JPEG
#define STBI_ONLY_BMP
#define STBI_ONLY_GIF
#define STBI_MAX_DIMENSIONS 256000000  // that of max_image_pixels in a row
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#include <stb_image.h>

namespace rovernet {
namespace {

/// File for the library, which reads missing bytes at the end as zeros, that is as walls; `ended`
/// is set then.
struct Source {
    std::FILE* file;
    bool ended = false;  ///< more was asked for than there is

    static int read(void* source, char* bytes, int size) {
        auto& self = *static_cast<Source*>(source);
        const auto count = std::fread(bytes, 1, static_cast<std::size_t>(size), self.file);
        self.ended |= count == 0;
        return static_cast<int>(count);
    }
    static void skip(void* source, int count) {
        std::fseek(static_cast<Source*>(source)->file, count, SEEK_CUR);
    }
    /// Not feof, which is reset by skipping beyond the end; the library would then search the next
    /// marker for ever.
    static int at_end(void* source) { return static_cast<Source*>(source)->ended ? 1 : 0; }
};
constexpr stbi_io_callbacks callbacks{&Source::read, &Source::skip, &Source::at_end};

struct FreePixels {
    void operator()(stbi_uc* pixels) const { stbi_image_free(pixels); }
};
using Pixels = std::unique_ptr<stbi_uc, FreePixels>;

bool is_opaque(const Image& image) {
    for (std::size_t i = 3; i < image.samples.size(); i += 4)
        if (image.samples[i] != 255) return false;
    return true;
}

void drop_alpha(Image& image) {
    std::size_t to = 0;
    for (std::size_t i = 0; i < image.samples.size(); ++i)
        if (i % 4 != 3) image.samples[to++] = image.samples[i];
    image.samples.resize(to);
    image.channels = 3;
}

}  // namespace

Image read_by_library(const std::string& path, std::FILE* file, std::string_view kind) {
    Source source{file};
    int width = 0, height = 0, channels = 0;
    const bool known =
        stbi_info_from_callbacks(&callbacks, &source, &width, &height, &channels) != 0;
    const std::int64_t rows = std::abs(std::int64_t{height});  // of a BMP below 0: from the top
    if (known && !source.ended) check_image_size(path, width, rows);
    // A file without a known size has no pixels either: the library reports the reason.
    Pixels pixels;
    if (!source.ended) {
        std::rewind(file);
        pixels.reset(stbi_load_from_callbacks(&callbacks, &source, &width, &height, &channels, 0));
    }
    if (source.ended)
        image_error(
            path,
            fmt::format("truncated {}; expected a whole image; save the picture again", kind));
    if (!known || !pixels)
        image_error(path, fmt::format("damaged {0}, or a kind of {0} that is not supported ({1}); "
                                      "expected a whole image; save the picture as PNG",
                                      kind, stbi_failure_reason()));
    Image image = sized_image(path, width, height, channels);
    std::copy_n(pixels.get(), image.samples.size(), image.samples.begin());
    if (kind == "GIF" && is_opaque(image)) drop_alpha(image);
    return image;
}

}  // namespace rovernet
