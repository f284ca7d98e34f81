// SPDX-License-Identifier: MIT
#include "scene/images/png.hpp"

#include <png.h>

#include <array>
#include <csetjmp>
#include <new>
#include <stdexcept>

namespace rovernet {
namespace {

// libpng reports errors by longjmp, which must not skip a destructor: write_pixels holds plain
// values only, and what owns memory lives in its caller.

struct PngWriter {
    png_structp png = nullptr;
    png_infop info = nullptr;
    std::string out;

    PngWriter() {
        png = png_create_write_struct(PNG_LIBPNG_VER_STRING, this, &on_error, &on_warning);
        if (png) info = png_create_info_struct(png);
    }
    ~PngWriter() { png_destroy_write_struct(&png, &info); }
    PngWriter(const PngWriter&) = delete;
    PngWriter& operator=(const PngWriter&) = delete;

    [[noreturn]] static void on_error(png_structp png, png_const_charp) { png_longjmp(png, 1); }
    static void on_warning(png_structp, png_const_charp) {}
    /// No exception may pass through libpng: lack of memory ends the program.
    static void append(png_structp png, png_bytep bytes, std::size_t count) noexcept {
        static_cast<PngWriter*>(png_get_io_ptr(png))
            ->out.append(reinterpret_cast<const char*>(bytes), count);
    }
    static void flush(png_structp) {}
};

constexpr std::array color_types{PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                                 PNG_COLOR_TYPE_RGB_ALPHA};
constexpr int compression_level = 9;

bool write_pixels(PngWriter& writer, const Image& image) {
    if (setjmp(png_jmpbuf(writer.png))) return false;
    png_set_write_fn(writer.png, &writer, &PngWriter::append, &PngWriter::flush);
    png_set_compression_level(writer.png, compression_level);
    png_set_filter(writer.png, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
    png_set_IHDR(writer.png, writer.info, static_cast<png_uint_32>(image.width),
                 static_cast<png_uint_32>(image.height), 8,
                 color_types[static_cast<std::size_t>(image.channels - 1)], PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(writer.png, writer.info);
    const std::size_t row_bytes =
        static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.channels);
    for (int row = 0; row < image.height; ++row) {
        png_write_row(writer.png, image.samples.data() + static_cast<std::size_t>(row) * row_bytes);
    }
    png_write_end(writer.png, nullptr);
    return true;
}

}  // namespace

std::string to_png(const Image& image) {
    const bool sizes_fit = image.width >= 1 && image.height >= 1 && image.channels >= 1 &&
                           image.channels <= 4 &&
                           image.samples.size() == static_cast<std::size_t>(image.width) *
                                                       static_cast<std::size_t>(image.height) *
                                                       static_cast<std::size_t>(image.channels);
    if (!sizes_fit)
        throw std::invalid_argument(
            "to_png: the number of samples does not match the width and the height");
    PngWriter writer;
    if (!writer.info) throw std::bad_alloc();
    if (!write_pixels(writer, image)) {
        throw std::invalid_argument(
            "to_png: libpng cannot write a picture of this width and height");
    }
    return std::move(writer.out);
}

}  // namespace rovernet
