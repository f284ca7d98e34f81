// SPDX-License-Identifier: MIT
#include "scene/images/image.hpp"
#include "sim/error.hpp"
#include "test/scene/images/read_bytes.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

// What PGM files are read as stands in image_test.cpp.
namespace netpbm_test {
using namespace rovernet;
using test::picture_error;
using test::read_bytes;
using test::TemporaryFolder;

namespace {

using Samples = std::vector<std::uint8_t>;
using namespace std::string_literals;

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("PPM: plain (P3) and raw (P6) colours are read, for any maxval") {
    const Image plain = read_bytes("P3 2 1 255  1 2 3  4 5 6");
    CHECK(plain.channels == 3);
    CHECK(plain.samples == Samples{1, 2, 3, 4, 5, 6});
    CHECK(read_bytes("P6 # by hand\n2 1 255\n\1\2\3\4\5\6"s).samples == plain.samples);
    CHECK(read_bytes("P3 1 1 100 0 50 100").samples == Samples{0, 128, 255});
    CHECK(read_bytes("P6 1 1 65535\n\0\200\0\201\377\377"s).samples == Samples{0, 1, 255});
}

TEST_CASE("PBM: 1 is black; plain digits need no spaces, and raw rows are padded to whole bytes") {
    const Samples expected{0, 255, 0, 255, 255, 0};
    CHECK(read_bytes("P1\n3 2\n1 0 1\n0 0 1\n").samples == expected);
    CHECK(read_bytes("P1 3 2 101001").samples == expected);
    CHECK(read_bytes("P4 3 2\n\240\040"s).samples == expected);
    CHECK(read_bytes("P4 9 1\n\200\200"s).samples ==
          Samples{0, 255, 255, 255, 255, 255, 255, 255, 0});
}

TEST_CASE("PPM and PBM: error messages name the format of the file") {
    CHECK(contains(picture_error("P6 1 1 255\nab"), "truncated PPM"));
    CHECK(contains(picture_error("P3 1 1 255 1 2"), "truncated PPM"));
    CHECK(contains(picture_error("P4 9 1\n\200"s), "truncated PBM"));
    CHECK(contains(picture_error("P1 2 1 1"), "truncated PBM"));
    CHECK(contains(picture_error("P1 2 1 12"), "byte 0x32 in PBM; expected 0 or 1"));
    CHECK(contains(picture_error("P6 30000 30000 255\n"), "at most 256 million"));
    CHECK(contains(picture_error("P7\nWIDTH 1\n"), "not a picture in a supported format"));
}

}  // namespace netpbm_test
