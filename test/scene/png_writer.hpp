// SPDX-License-Identifier: MIT
#pragma once

#include <png.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace rovernet::test {

/// PNG image to be written; rows are packed bytes in the file's format.
struct PngPicture {
    png_uint_32 width = 1;
    png_uint_32 height = 1;
    int depth = 8;
    int color_type = PNG_COLOR_TYPE_GRAY;
    std::vector<std::vector<png_byte>> rows;
    std::vector<png_color> palette{};
    std::vector<png_byte> palette_alpha{};  ///< alpha of the first palette entries
    int transparent_gray = -1;              ///< transparent gray value; -1: none
    bool interlaced = false;
};

inline void on_bytes(png_structp png, png_bytep bytes, png_size_t size) {
    static_cast<std::string*>(png_get_io_ptr(png))
        ->append(reinterpret_cast<const char*>(bytes), size);
}

/// Bytes of the PNG file. The images of the tests must be valid, because errors of libpng are not
/// handled.
inline std::string png_bytes(PngPicture picture) {
    std::string bytes;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(png, &bytes, &on_bytes, nullptr);
    png_set_IHDR(png, info, picture.width, picture.height, picture.depth, picture.color_type,
                 picture.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (!picture.palette.empty())
        png_set_PLTE(png, info, picture.palette.data(), static_cast<int>(picture.palette.size()));
    png_color_16 gray{};
    gray.gray = static_cast<png_uint_16>(picture.transparent_gray);
    if (picture.transparent_gray >= 0) png_set_tRNS(png, info, nullptr, 0, &gray);
    if (!picture.palette_alpha.empty())
        png_set_tRNS(png, info, picture.palette_alpha.data(),
                     static_cast<int>(picture.palette_alpha.size()), nullptr);
    png_write_info(png, info);
    std::vector<png_bytep> rows;
    for (auto& row : picture.rows) rows.push_back(row.data());
    png_write_image(png, rows.data());
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return bytes;
}

}  // namespace rovernet::test
