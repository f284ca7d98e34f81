// SPDX-License-Identifier: MIT
#include "scene/images/image.hpp"

#include "files/input_file.hpp"
#include "sim/error.hpp"

#include <fmt/format.h>
#include <png.h>

#include <array>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string_view>

namespace rovernet {
namespace {

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

[[noreturn]] void fail(const std::string& path, const std::string& message) {
    throw InputError(Location{path}, message);
}

File open(const std::string& path) {
    const InputKind kind = input_kind(path);
    if (is_no_path(kind))
        fail(path, fmt::format("{}; expected a PNG or PGM image; check the path", fault_of(kind)));
    if (kind == InputKind::folder)
        fail(path, "is a directory; expected a PNG or PGM image; name a file in it");
    if (kind != InputKind::file)
        fail(path, "is not a regular file; expected a PNG or PGM image; copy it to a file");
    File file(std::fopen(path.c_str(), "rb"));
    if (!file) fail(path, "cannot be opened; expected a readable image; check its permissions");
    return file;
}

void check_size(const std::string& path, std::int64_t width, std::int64_t height) {
    if (width < 1 || height < 1)
        fail(path,
             fmt::format("image of {} x {} pixels; expected at least one pixel; save it again",
                         width, height));
    if (width > max_image_pixels / height)
        fail(path, fmt::format("image of {} x {} pixels; expected at most {} million pixels; "
                               "scale it down or cut it",
                               width, height, max_image_pixels / 1'000'000));
}

void allocate(Image& image) {
    image.samples.resize(static_cast<std::size_t>(image.width) *
                         static_cast<std::size_t>(image.height) *
                         static_cast<std::size_t>(image.channels));
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

/// Reads up to the pixels. False: see reader.error.
bool read_header(PngReader& reader, std::FILE* file) {
    if (setjmp(png_jmpbuf(reader.png))) return false;
    png_init_io(reader.png, file);
    png_set_user_limits(reader.png, 0x7fffffff, 0x7fffffff);  // check_size says it better
    png_read_info(reader.png, reader.info);
    return true;
}

/// Asks for 8 bits a sample and plain channels; returns the bytes per row, or 0: see reader.error.
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
        fail(path,
             fmt::format("damaged or truncated PNG ({}); expected a whole image; save it again",
                         reader.error.data()));
    };
    if (!read_header(reader, file)) damaged();
    const auto width = png_get_image_width(reader.png, reader.info);
    const auto height = png_get_image_height(reader.png, reader.info);
    check_size(path, width, height);
    const std::size_t row_bytes = prepare_pixels(reader);
    if (row_bytes == 0) damaged();
    Image image{static_cast<int>(width),
                static_cast<int>(height),
                png_get_channels(reader.png, reader.info),
                {}};
    allocate(image);
    std::vector<png_bytep> rows(height);
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = image.samples.data() + i * row_bytes;
    if (!read_pixels(reader, rows.data())) damaged();
    return image;
}

// PGM. Source: the Netpbm manual, "PGM Format Specification".

class PgmReader {
  public:
    PgmReader(const std::string& path, std::FILE* file) : path_(path), file_(file) {}

    Image read(bool plain) {
        Image image;
        image.width = number("a width", 1'000'000'000);
        image.height = number("a height", 1'000'000'000);
        check_size(path_, image.width, image.height);
        max_value_ = number("a maxval from 1 to 65535", 65535);
        if (max_value_ == 0) fail(path_, "PGM maxval 0; expected 1 to 65535; save it again");
        allocate(image);
        for (std::uint8_t& sample : image.samples) sample = scaled(plain ? number_sample() : raw());
        return image;
    }

  private:
    int next() { return std::getc(file_); }

    [[noreturn]] void truncated() {
        fail(path_, "truncated PGM; expected one sample per pixel; save it again");
    }

    /// The next character; a comment counts as the end of its line.
    int next_outside_comment() {
        int c = next();
        if (c == '#')
            while (c != '\n' && c != '\r' && c != EOF) c = next();
        return c;
    }
    static bool white(int c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

    /// Skips white space, reads a decimal number and the one white space after it.
    int number(const char* what, int limit) {
        int c = next_outside_comment();
        while (white(c)) c = next_outside_comment();
        if (c == EOF) truncated();
        std::int64_t value = 0;
        bool digits = false;
        for (; c >= '0' && c <= '9'; c = next_outside_comment()) {
            digits = true;
            value = 10 * value + (c - '0');
            if (value > limit)
                fail(path_, fmt::format("number above {} in PGM; expected {}; save it again", limit,
                                        what));
        }
        if (!digits || !(white(c) || c == EOF))
            fail(path_, fmt::format("byte 0x{:02x} in PGM; expected {}; save it again", c, what));
        return static_cast<int>(value);
    }
    int number_sample() { return number("a sample up to the maxval", max_value_); }

    int byte() {
        const int c = next();
        if (c == EOF) truncated();
        return c;
    }
    /// One byte, or two with the higher first if the maxval needs them.
    int raw() {
        const int high = max_value_ > 255 ? byte() : 0;
        const int value = 256 * high + byte();
        if (value > max_value_)
            fail(path_, fmt::format("PGM sample {} above the maxval {}; expected at most that; "
                                    "save it again",
                                    value, max_value_));
        return value;
    }
    std::uint8_t scaled(int value) const {
        return static_cast<std::uint8_t>((2 * 255 * value + max_value_) / (2 * max_value_));
    }

    const std::string& path_;
    std::FILE* file_;
    int max_value_ = 255;
};

}  // namespace

Image read_image(const std::string& path) {
    const File file = open(path);
    std::array<char, 8> bytes{};
    const std::size_t count = std::fread(bytes.data(), 1, bytes.size(), file.get());
    const std::string_view start(bytes.data(), count);
    std::rewind(file.get());
    if (start == "\x89PNG\r\n\x1a\n") return read_png(path, file.get());
    if (start.starts_with("P2") || start.starts_with("P5")) {
        std::fseek(file.get(), 2, SEEK_SET);
        return PgmReader(path, file.get()).read(start[1] == '2');
    }
    fail(path, fmt::format("{}; expected a PNG or PGM image; convert it to PNG",
                           count == 0 ? "an empty file" : "neither a PNG nor a PGM"));
}

}  // namespace rovernet
