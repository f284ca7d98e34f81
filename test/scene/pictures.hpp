// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace rovernet::test {

/// Bytes given by hexadecimal digits.
inline std::string from_hex(std::string_view digits) {
    const auto value = [](char c) { return c <= '9' ? c - '0' : c - 'a' + 10; };
    std::string bytes;
    for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
        bytes += static_cast<char>(16 * value(digits[i]) + value(digits[i + 1]));
    return bytes;
}

/// Gray JPEG of 16 x 8 pixels, the left half black, the right half white (Pillow 9.4, quality 20).
inline std::string gray_jpeg() {
    return from_hex(
        "ffd8ffe000104a46494600010100000100010000ffdb004300281c1e231e19282321232d2b28303c64413c37"
        "373c7b585d4964918099968f808c8aa0b4e6c3a0aadaad8a8cc8ffcbdaeef5ffffff9bc1fffffffaffe6fdff"
        "f8ffc0000b080008001001011100ffc4001500010100000000000000000000000000000506ffc40014100100"
        "000000000000000000000000000000ffda0008010100003f001566ffd9");
}

/// Colour JPEG of 16 x 8 pixels: the left half (200, 30, 40), the right half white. At quality 20,
/// Pillow decodes the left half to (204, 29, 46).
inline std::string color_jpeg() {
    return from_hex(
        "ffd8ffe000104a46494600010100000100010000ffdb004300281c1e231e19282321232d2b28303c64413c37"
        "373c7b585d4964918099968f808c8aa0b4e6c3a0aadaad8a8cc8ffcbdaeef5ffffff9bc1fffffffaffe6fdff"
        "f8ffdb0043012b2d2d3c353c76414176f8a58ca5f8f8f8f8f8f8f8f8f8f8f8f8f8f8f8f8f8f8f8f8f8f8f8f8"
        "f8f8f8f8f8f8f8f8f8f8f8f8f8f8f8f8f8f8f8f8f8f8f8f8f8f8f8f8f8f8ffc0001108000800100301110002"
        "1101031101ffc4001500010100000000000000000000000000000406ffc40014100100000000000000000000"
        "000000000000ffc4001501010100000000000000000000000000000305ffc400141101000000000000000000"
        "00000000000000ffda000c03010002110311003f0030d414444f7fffd9");
}

/// GIF of 3 x 2 pixels: the first row is black, white and (200, 30, 40); the second row has the
/// same colours from right to left.
inline std::string opaque_gif() {
    return from_hex(
        "47494638376103000200810000000000ffffffc81e280000002c000000000300020000080900010410202000"
        "8080003b");
}
/// GIF with the pixels of opaque_gif(), in which white is transparent.
inline std::string transparent_gif() {
    return from_hex(
        "47494638396103000200810000000000ffffffc81e2800000021f90401000001002c00000000030002000008"
        "09000104102020008080003b");
}

/// Header of a BMP with `bits` bits per pixel, without pixels.
/// @param height   negative: the first row is the top row
/// @param colors   colours of the palette, each blue, green, red, 0
inline std::string bmp_header(std::int32_t width, std::int32_t height, int bits,
                              const std::string& colors = "", int compression = 0) {
    std::string bytes = "BM";
    const auto add = [&](std::int64_t value, int size) {
        for (int i = 0; i < size; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xff);
    };
    const auto offset = 54 + static_cast<std::int64_t>(colors.size());
    for (const std::int64_t value : {std::int64_t{0}, std::int64_t{0}, offset}) add(value, 4);
    add(40, 4);
    add(width, 4);
    add(height, 4);
    add(1, 2);
    add(bits, 2);
    for (const std::int64_t value : {compression, 0, 0, 0}) add(value, 4);
    add(static_cast<std::int64_t>(colors.size() / 4), 4);
    add(0, 4);
    return bytes + colors;
}

}  // namespace rovernet::test
