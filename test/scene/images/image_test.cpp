// SPDX-License-Identifier: MIT
#include "scene/images/image.hpp"

#include "sim/error.hpp"
#include "test/scene/images/read_bytes.hpp"
#include "test/scene/png_writer.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace image_test {
using namespace rovernet;
using test::picture_error;
using test::png_bytes;
using test::PngPicture;
using test::read_bytes;
using test::TemporaryFolder;

namespace {

using Samples = std::vector<std::uint8_t>;

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

std::string bytes_of(std::initializer_list<int> values) {
    std::string bytes;
    for (const int value : values) bytes += static_cast<char>(value);
    return bytes;
}

}  // namespace

TEST_CASE("PNG: gray values of every bit depth are scaled to 0..255") {
    const Image one = read_bytes(png_bytes({.width = 4, .depth = 1, .rows = {{0b01010000}}}));
    CHECK(one.width == 4);
    CHECK(one.height == 1);
    CHECK(one.channels == 1);
    CHECK(one.samples == Samples{0, 255, 0, 255});
    CHECK(read_bytes(png_bytes({.width = 4, .depth = 2, .rows = {{0b00011011}}})).samples ==
          Samples{0, 85, 170, 255});
    CHECK(read_bytes(png_bytes({.width = 2, .depth = 4, .rows = {{0x3f}}})).samples ==
          Samples{51, 255});
    CHECK(read_bytes(png_bytes({.width = 2, .rows = {{7, 205}}})).samples == Samples{7, 205});
}

TEST_CASE("PNG: 16-bit samples are rounded to the nearest 8-bit value") {
    // 0x0080 = 128 of 65535 is 0.498 of 255: 0; 0x0081 is 0.502: 1; 0xff7f: 254.50: 255.
    const Image image = read_bytes(png_bytes(
        {.width = 4, .depth = 16, .rows = {{0x00, 0x80, 0x00, 0x81, 0xff, 0x7f, 0x80, 0x80}}}));
    CHECK(image.samples == Samples{0, 1, 255, 128});
}

TEST_CASE("PNG: gray with alpha, colour, and colour with alpha are read with all their channels") {
    const Image gray = read_bytes(png_bytes(
        {.width = 2, .color_type = PNG_COLOR_TYPE_GRAY_ALPHA, .rows = {{10, 0, 20, 255}}}));
    CHECK(gray.channels == 2);
    CHECK(gray.has_alpha());
    CHECK(gray.rgb_sum(1, 0) == 60);
    CHECK(gray.alpha(0, 0) == 0);
    CHECK(gray.alpha(1, 0) == 255);
    const Image rgb =
        read_bytes(png_bytes({.color_type = PNG_COLOR_TYPE_RGB, .rows = {{10, 20, 40}}}));
    CHECK(rgb.channels == 3);
    CHECK_FALSE(rgb.has_alpha());
    CHECK(rgb.rgb_sum(0, 0) == 70);
    CHECK(rgb.alpha(0, 0) == 255);
    const Image rgba =
        read_bytes(png_bytes({.color_type = PNG_COLOR_TYPE_RGBA, .rows = {{10, 20, 40, 77}}}));
    CHECK(rgba.channels == 4);
    CHECK(rgba.rgb_sum(0, 0) == 70);
    CHECK(rgba.alpha(0, 0) == 77);
}

TEST_CASE("PNG: palette colours are looked up, with their alpha") {
    const std::vector<png_color> palette{{255, 0, 0}, {0, 128, 0}, {1, 2, 3}};
    const Image opaque = read_bytes(png_bytes({.width = 3,
                                               .depth = 2,
                                               .color_type = PNG_COLOR_TYPE_PALETTE,
                                               .rows = {{0b00011000}},
                                               .palette = palette}));
    CHECK(opaque.samples == Samples{255, 0, 0, 0, 128, 0, 1, 2, 3});
    const Image clear = read_bytes(png_bytes({.width = 2,
                                              .color_type = PNG_COLOR_TYPE_PALETTE,
                                              .rows = {{1, 2}},
                                              .palette = palette,
                                              .palette_alpha = {255, 0}}));
    CHECK(clear.samples == Samples{0, 128, 0, 0, 1, 2, 3, 255});
}

TEST_CASE("PNG: the gray value that a file declares as transparent gets alpha 0") {
    const Image image =
        read_bytes(png_bytes({.width = 2, .rows = {{9, 10}}, .transparent_gray = 9}));
    CHECK(image.samples == Samples{9, 0, 10, 255});
}

TEST_CASE("PNG: an interlaced image gives the same pixels as the image without interlacing") {
    PngPicture picture{.width = 9, .height = 11, .rows = {}};
    for (int row = 0; row < 11; ++row) {
        picture.rows.emplace_back();
        for (int i = 0; i < 9; ++i)
            picture.rows.back().push_back(static_cast<png_byte>(9 * row + i));
    }
    const Image plain = read_bytes(png_bytes(picture));
    picture.interlaced = true;
    CHECK(read_bytes(png_bytes(picture)).samples == plain.samples);
    CHECK(plain.samples[98] == 98);
}

TEST_CASE("PNG: a file cut off anywhere is refused, without a crash") {
    PngPicture picture{.width = 40, .height = 40, .rows = {}};
    for (int row = 0; row < 40; ++row) {
        picture.rows.emplace_back();
        for (int i = 0; i < 40; ++i)
            picture.rows.back().push_back(static_cast<png_byte>(row * row * 7 + i * i * 3));
    }
    const std::string bytes = png_bytes(picture);
    for (std::size_t size = 0; size < bytes.size(); size += size < 100 ? 1 : 37)
        CHECK_MESSAGE(picture_error(bytes.substr(0, size)) != "", "cut at ", size);
    CHECK(contains(picture_error(bytes.substr(0, 200)), "truncated PNG"));
}

TEST_CASE("PNG: a file with a changed byte is refused or read, without a crash") {
    const std::string bytes = png_bytes(
        {.width = 8, .height = 2, .rows = {{1, 2, 3, 4, 5, 6, 7, 8}, {8, 7, 6, 5, 4, 3, 2, 1}}});
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        std::string changed = bytes;
        changed[i] = static_cast<char>(changed[i] ^ 0x41);
        CHECK_NOTHROW(picture_error(changed));
    }
}

TEST_CASE("PNG: 30,000 x 30,000 pixels are refused from the header alone") {
    // A valid header chunk (8 bits, gray) with its check sum, and nothing behind it.
    png_uint_32 side = 30'000;
    std::string chunk = "IHDR";
    for (int twice = 0; twice < 2; ++twice)
        for (int shift = 24; shift >= 0; shift -= 8) chunk += static_cast<char>(side >> shift);
    chunk += bytes_of({8, 0, 0, 0, 0});
    png_uint_32 sum = 0xffffffff;  // PNG specification, annex D
    for (const char c : chunk) {
        sum ^= static_cast<unsigned char>(c);
        for (int bit = 0; bit < 8; ++bit) sum = sum & 1 ? 0xedb88320u ^ (sum >> 1) : sum >> 1;
    }
    sum = ~sum;
    std::string bytes = "\x89PNG\r\n\x1a\n" + bytes_of({0, 0, 0, 13}) + chunk;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(sum >> shift);
    bytes += bytes_of({0, 0, 0, 0}) + "IDAT" + bytes_of({0x35, 0xaf, 0x06, 0x1e});
    CHECK(contains(picture_error(bytes), "30000 x 30000 pixels; expected at most 256 million"));
}

TEST_CASE("PGM: plain (P2) and raw (P5) files of the same image give the same samples") {
    CHECK(read_bytes("P2\n3 2\n255\n0 1 2\n253 254 255\n").samples ==
          Samples{0, 1, 2, 253, 254, 255});
    CHECK(read_bytes("P5 3 2 255\n" + bytes_of({0, 1, 2, 253, 254, 255})).samples ==
          Samples{0, 1, 2, 253, 254, 255});
}

TEST_CASE("PGM: comments are accepted between any two numbers of the header") {
    const Image image =
        read_bytes("P5 # made by map_saver\n#\n2# wide\n 1\n# 9\n255\n" + bytes_of({'#', 7}));
    CHECK(image.width == 2);
    CHECK(image.height == 1);
    CHECK(image.samples == Samples{'#', 7});
    CHECK(read_bytes("P2 2 1 # sizes\n255 5 # five\n6").samples == Samples{5, 6});
}

TEST_CASE("PGM: samples are scaled from 0..maxval to 0..255 and rounded to the nearest number") {
    CHECK(read_bytes("P2 4 1 100 0 50 99 100").samples == Samples{0, 128, 252, 255});
    CHECK(read_bytes("P5 2 1 1\n" + bytes_of({0, 1})).samples == Samples{0, 255});
    CHECK(read_bytes("P5 4 1 65535\n" + bytes_of({0x00, 0x80, 0x00, 0x81, 0xff, 0x7f, 0xff, 0xff}))
              .samples == Samples{0, 1, 255, 255});
    CHECK(read_bytes("P5 1 1 256\n" + bytes_of({0x01, 0x00})).samples == Samples{255});
}

TEST_CASE("PGM: errors name what is wrong in the file") {
    CHECK(contains(picture_error("P5 2 2 255\nabc"), "truncated PGM"));
    CHECK(contains(picture_error("P2 2 2 255\n1 2 3"), "truncated PGM"));
    CHECK(contains(picture_error("P5 2"), "truncated PGM"));
    CHECK(contains(picture_error("P2 1 1 255\n256"), "above 255"));
    CHECK(contains(picture_error("P5 1 1 100\n" + bytes_of({101})),
                   "sample 101, which is above the maxval 100"));
    CHECK(contains(picture_error("P2 1 1 255\n-1"), "expected a sample"));
    CHECK(contains(picture_error("P2 x 1 255\n1"), "expected a width"));
    CHECK(contains(picture_error("P2 1x 1 255\n1"), "expected a width"));
    CHECK(contains(picture_error("P2 1 1 0\n0"), "maxval 0"));
    CHECK(contains(picture_error("P2 1 1 65536\n0"), "maxval from 1 to 65535"));
    CHECK(contains(picture_error("P2 0 1 255\n"), "at least one pixel"));
    CHECK(contains(picture_error("P5 30000 30000 255\n"), "at most 256 million"));
    CHECK(!contains(picture_error("P5 9000 9000 255\n"), "at most"));  // it has no pixels
    CHECK(contains(picture_error("P5 99999999999999999999 1 255\n"), "number above"));
}

TEST_CASE("images: a missing file, a folder and files of other kinds cause different errors") {
    const TemporaryFolder folder;
    const auto fails = [](const std::string& path, const std::string& part) {
        try {
            read_image(path);
        } catch (const InputError& error) {
            return error.where().source == path && contains(error.what(), path + ": ") &&
                   contains(error.message(), part);
        }
        return false;
    };
    CHECK(fails(folder.path("absent.png"), "no such file"));
    CHECK(fails(folder.path("."), "is a directory"));
    CHECK(fails("/dev/zero", "not a regular file"));
    CHECK(fails(folder.write("empty.png", ""), "an empty file"));
    CHECK(fails(folder.write("page.png", "<html></html>"), "not a picture in a supported format"));
    CHECK(fails(folder.write("page.png", "<html></html>"), "expected a PNG, JPEG, BMP, GIF or"));
}

TEST_CASE("images: extensions of image files are recognised in upper and lower case") {
    for (const char* name : {"a.png", "maps/b.JPG", "c.jpeg", "d.bmp", "e.Gif", "f.ppm", "g.pbm"})
        CHECK_MESSAGE(is_image_name(name), name);
    for (const char* name : {"a.yaml", "png", "b.png.toml", ""}) CHECK_FALSE(is_image_name(name));
}

}  // namespace image_test
