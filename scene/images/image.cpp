// SPDX-License-Identifier: MIT
#include "scene/images/image.hpp"

#include "files/input_file.hpp"
#include "files/kept_inputs.hpp"
#include "scene/images/image_reader.hpp"
#include "sim/error.hpp"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string_view>

namespace rovernet {
namespace {

constexpr std::string_view expected_kinds =
    "a PNG, JPEG, BMP, GIF or Netpbm (PGM, PPM, PBM) picture";
constexpr std::array<std::string_view, 9> image_endings{".png", ".pgm",  ".ppm", ".pbm", ".pnm",
                                                        ".jpg", ".jpeg", ".bmp", ".gif"};

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

File open(const std::string& path) {
    const InputKind kind = input_kind(path);
    const auto fail = [&](std::string_view found, std::string_view mend) {
        image_error(path, fmt::format("{}; expected {}; {}", found, expected_kinds, mend));
    };
    if (is_no_path(kind)) fail(fault_of(kind), "check the path");
    if (kind == InputKind::folder) fail("is a directory", "name a file in it");
    if (kind != InputKind::file) fail("is not a regular file", "copy it to a file");
    File file(std::fopen(path.c_str(), "rb"));
    if (!file)
        image_error(
            path, "cannot be opened; expected a readable image; check the permissions of the file");
    note_input(path);
    return file;
}

// PNG. libpng reports errors by longjmp, which must not skip a destructor: read_header and
// read_pixels hold plain values only, and what owns memory lives in their caller.

struct PngReader {
    png_structp png = nullptr;
    png_infop info = nullptr;
    std::array<char, 200> error{};

    PngReader() {
        png = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, &on_error, &on_warning);
        if (png) info = png_create_info_struct(png);
    }
    ~PngReader() { png_destroy_read_struct(&png, &info, nullptr); }
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;

    [[noreturn]] static void on_error(png_structp png, png_const_charp message) {
        auto& error = static_cast<PngReader*>(png_get_error_ptr(png))->error;
        std::strncpy(error.data(), message, error.size() - 1);
        png_longjmp(png, 1);
    }
    static void on_warning(png_structp, png_const_charp) {}
};

/// Reads the file up to the pixels. False on an error, see reader.error.
bool read_header(PngReader& reader, std::FILE* file) {
    if (setjmp(png_jmpbuf(reader.png))) return false;
    png_init_io(reader.png, file);
    png_set_user_limits(reader.png, 0x7fffffff, 0x7fffffff);  // check_size says it better
    png_read_info(reader.png, reader.info);
    return true;
}

/// Requests 8 bits per sample and plain channels; returns the bytes per row, or 0 on an error, see
/// reader.error.
std::size_t prepare_pixels(PngReader& reader) {
    if (setjmp(png_jmpbuf(reader.png))) return 0;
    png_set_expand(reader.png);  // palettes, small grays, transparent colours
    png_set_scale_16(reader.png);
    png_set_interlace_handling(reader.png);
    png_read_update_info(reader.png, reader.info);
    return png_get_rowbytes(reader.png, reader.info);
}

bool read_pixels(PngReader& reader, png_bytepp rows) {
    if (setjmp(png_jmpbuf(reader.png))) return false;
    png_read_image(reader.png, rows);
    png_read_end(reader.png, nullptr);
    return true;
}

Image read_png(const std::string& path, std::FILE* file) {
    PngReader reader;
    if (!reader.info) throw std::bad_alloc();
    const auto damaged = [&] {
        image_error(
            path,
            fmt::format(
                "damaged or truncated PNG ({}); expected a whole image; save the picture again",
                reader.error.data()));
    };
    if (!read_header(reader, file)) damaged();
    const auto width = png_get_image_width(reader.png, reader.info);
    const auto height = png_get_image_height(reader.png, reader.info);
    check_image_size(path, width, height);
    const std::size_t row_bytes = prepare_pixels(reader);
    if (row_bytes == 0) damaged();
    Image image = sized_image(path, width, height, png_get_channels(reader.png, reader.info));
    std::vector<png_bytep> rows(height);
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = image.samples.data() + i * row_bytes;
    if (!read_pixels(reader, rows.data())) damaged();
    return image;
}

}  // namespace

void image_error(const std::string& path, const std::string& message) {
    throw InputError(Location{path}, message);
}

void check_image_size(const std::string& path, std::int64_t width, std::int64_t height) {
    if (width < 1 || height < 1)
        image_error(
            path,
            fmt::format(
                "image of {} x {} pixels; expected at least one pixel; save the picture again",
                width, height));
    if (width > max_image_pixels / height)
        image_error(path, fmt::format("image of {} x {} pixels; expected at most {} million "
                                      "pixels; scale the picture down, or cut a part out of it",
                                      width, height, max_image_pixels / 1'000'000));
}

Image sized_image(const std::string& path, std::int64_t width, std::int64_t height, int channels) {
    check_image_size(path, width, height);
    Image image{static_cast<int>(width), static_cast<int>(height), channels, {}};
    image.samples.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                         static_cast<std::size_t>(channels));
    return image;
}

bool is_image_name(const std::string& path) {
    std::string ending = std::filesystem::path(path).extension().string();
    for (char& c : ending)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c + ('a' - 'A'));
    return std::find(image_endings.begin(), image_endings.end(), ending) != image_endings.end();
}

Image read_image(const std::string& path) {
    const File file = open(path);
    std::array<char, 8> bytes{};
    const std::size_t count = std::fread(bytes.data(), 1, bytes.size(), file.get());
    const std::string_view start(bytes.data(), count);
    std::rewind(file.get());
    if (start == "\x89PNG\r\n\x1a\n") return read_png(path, file.get());
    if (count > 2 && start[0] == 'P' && start[1] >= '1' && start[1] <= '6') {
        std::fseek(file.get(), 2, SEEK_SET);
        return read_netpbm(path, file.get(), start[1]);
    }
    if (start.starts_with("\xff\xd8\xff")) return read_by_library(path, file.get(), "JPEG");
    if (start.starts_with("BM")) return read_by_library(path, file.get(), "BMP");
    if (start.starts_with("GIF8")) return read_by_library(path, file.get(), "GIF");
    image_error(path,
                fmt::format("{}; expected {}; convert the file to PNG",
                            count == 0 ? "an empty file" : "not a picture in a supported format",
                            expected_kinds));
}

}  // namespace rovernet
