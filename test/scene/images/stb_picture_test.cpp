// SPDX-License-Identifier: MIT
#include "scene/images/image.hpp"
#include "scene/occupancy.hpp"
#include "sim/error.hpp"
#include "test/scene/pictures.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

namespace stb_picture_test {
using namespace rovernet;
using test::bmp_header;
using test::TemporaryFolder;

namespace {

constexpr int white = 253;  // 255 at quality 20: Pillow 9.4 with libjpeg-turbo 2.1
using Samples = std::vector<std::uint8_t>;
using namespace std::string_literals;

Image read_bytes(const std::string& bytes) {
    const TemporaryFolder folder;
    return read_image(folder.write("image", bytes));
}

std::string error_of(const std::string& bytes) {
    const TemporaryFolder folder;
    const std::string path = folder.write("image", bytes);
    try {
        read_image(path);
    } catch (const InputError& error) {
        CHECK(error.where().source == path);
        return error.message();
    }
    return "";
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// Pictures of every kind that the library reads.
std::vector<std::string> all_kinds() {
    return {test::gray_jpeg(), test::color_jpeg(), test::opaque_gif(),
            bmp_header(2, 2, 24) + "\1\2\3\4\5\6\0\0"s + "\7\10\11\12\13\14\0\0"s};
}

}  // namespace

TEST_CASE("JPEG: gray blocks differ by at most 1 (of 255) from those of another decoder") {
    const Image image = read_bytes(test::gray_jpeg());
    CHECK(image.width == 16);
    CHECK(image.height == 8);
    CHECK(image.channels == 1);
    for (int row = 0; row < 8; ++row)
        for (int column = 0; column < 16; ++column)
            CHECK(std::abs(image.rgb_sum(column, row) - 3 * (column < 8 ? 0 : white)) <= 3);
}

TEST_CASE("JPEG: colours differ by at most 1 (of 255) from those of another decoder") {
    const Image image = read_bytes(test::color_jpeg());
    CHECK(image.channels == 3);
    const int expected[] = {204, 29, 46};  // as `white`
    for (std::size_t i = 0; i < 3; ++i) CHECK(std::abs(image.samples[i] - expected[i]) <= 1);
    CHECK(std::abs(image.rgb_sum(15, 7) - 3 * white) <= 3);
}

TEST_CASE("BMP: files with rows from the top or the bottom, 24-bit colours or palettes are read") {
    const std::string red_then_blue = "\0\0\377\377\0\0\0\0"s, gray = "\5\5\5\6\6\6\0\0"s;
    const Samples expected{255, 0, 0, 0, 0, 255, 5, 5, 5, 6, 6, 6};
    CHECK(read_bytes(bmp_header(2, 2, 24) + gray + red_then_blue).samples == expected);
    CHECK(read_bytes(bmp_header(2, -2, 24) + red_then_blue + gray).samples == expected);
    const std::string palette = "\1\1\1\0\310\310\310\0"s;
    const Samples levels{200, 200, 200, 1, 1, 1};
    CHECK(read_bytes(bmp_header(2, 1, 1, palette) + "\200\0\0\0"s).samples == levels);
    CHECK(read_bytes(bmp_header(2, 1, 4, palette) + "\20\0\0\0"s).samples == levels);
    CHECK(read_bytes(bmp_header(2, 1, 8, palette) + "\1\0\0\0"s).samples == levels);
}

TEST_CASE("GIF: the first frame is read, with an alpha channel only if a pixel is transparent") {
    const Image opaque = read_bytes(test::opaque_gif());
    CHECK(opaque.channels == 3);
    CHECK(opaque.samples ==
          Samples{0, 0, 0, 255, 255, 255, 200, 30, 40, 200, 30, 40, 255, 255, 255, 0, 0, 0});
    const Image clear = read_bytes(test::transparent_gif());
    CHECK(clear.channels == 4);
    CHECK(clear.alpha(0, 0) == 255);
    CHECK(clear.alpha(1, 0) == 0);
    CHECK(clear.rgb_sum(2, 0) == 270);
}

TEST_CASE("JPEG, BMP, GIF: a file whose pixels are cut off is refused, wherever it is cut") {
    for (const std::string& bytes : all_kinds()) {
        CHECK(error_of(bytes) == "");
        for (std::size_t size = 6; size < bytes.size(); ++size) {
            // What may be missing: the trailer of a GIF, and what fills the last row of a BMP.
            const bool may_be_missing = bytes[0] != '\xff' && size + 3 > bytes.size();
            const std::string error = error_of(bytes.substr(0, size));
            CHECK_MESSAGE((error != "" || may_be_missing), bytes.substr(0, 3), " cut at ", size);
            if (error != "") CHECK_MESSAGE(contains(error, "truncated"), error, " at ", size);
        }
    }
}

TEST_CASE("JPEG, BMP, GIF: a file with a changed byte is refused or read, without a crash") {
    for (const std::string& bytes : all_kinds()) {
        for (std::size_t i = 3; i < bytes.size(); ++i) {
            for (const int flip : {0x01, 0x41, 0x80}) {
                std::string changed = bytes;
                changed[i] = static_cast<char>(changed[i] ^ flip);
                CHECK_NOTHROW(error_of(changed));
            }
        }
    }
}

TEST_CASE("JPEG, BMP, GIF: an image of 1e9 pixels is refused from its header alone") {
    const std::string jpeg = test::from_hex("ffd8ffc0000b08") + "\234\100\234\100"s +
                             test::from_hex("01011100");  // 40,000 x 40,000
    const std::string gif = "GIF89a" + "\100\234\100\234\0\0\0\54"s;
    CHECK(contains(error_of(jpeg), "40000 x 40000 pixels; expected at most 256 million"));
    CHECK(contains(error_of(gif), "40000 x 40000 pixels; expected at most 256 million"));
    CHECK(contains(error_of(bmp_header(100'000, 10'000, 24)), "at most 256 million"));
    CHECK(contains(error_of(bmp_header(2'000'000'000, -1, 24)), "at most 256 million"));
    CHECK(contains(error_of(bmp_header(3, 1 << 31, 24)), "pixels; expected"));
    CHECK(contains(error_of(bmp_header(-5, 3, 24)), "at least one pixel"));
    CHECK(contains(error_of(bmp_header(0, 0, 24)), "at least one pixel"));
}

TEST_CASE("BMP: a BMP of an unsupported kind is refused, and the error names the kind") {
    const std::string packed = bmp_header(4, 1, 8, std::string(8, '\0'), 1) + "\4\1\0\1"s;
    CHECK(contains(error_of(packed), "a kind of BMP that is not supported (BMP RLE)"));
    CHECK(contains(error_of(packed), "save the picture as PNG"));
}

TEST_CASE("maps: the same image gives the same map as JPEG and as PGM") {
    const TemporaryFolder folder;
    folder.write("room.jpg", test::gray_jpeg());
    std::string row = "P2 16 8 255 ";
    for (int i = 0; i < 16; ++i) row += i < 8 ? "0 " : "255 ";
    std::string rows = row;
    for (int i = 1; i < 8; ++i) rows += row.substr(12);
    folder.write("room.pgm", rows);
    const auto map = [&](const std::string& picture) {
        return read_ros_map(folder.write(
            "map.yaml", "image: " + picture + "\nresolution: 0.5\norigin: [0, 0, 0]\n"));
    };
    const OccupancyGrid jpeg = map("room.jpg"), pgm = map("room.pgm");
    CHECK(jpeg.cells == pgm.cells);
    CHECK(std::count(jpeg.cells.begin(), jpeg.cells.end(), Cell::occupied) == 64);
}

}  // namespace stb_picture_test
