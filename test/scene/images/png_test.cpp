// SPDX-License-Identifier: MIT
#include "scene/images/png.hpp"

#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <stdexcept>
#include <string>

namespace png_test {
using namespace rovernet;

TEST_CASE("png: a written image is read back, for every number of channels") {
    for (int channels = 1; channels <= 4; ++channels) {
        Image image{7, 5, channels, {}};
        for (int i = 0; i < 7 * 5 * channels; ++i) {
            image.samples.push_back(static_cast<std::uint8_t>(i * 37));
        }
        test::TemporaryFolder folder;
        const std::string path = folder.write("a.png", to_png(image));
        const Image back = read_image(path);
        CHECK(back.width == 7);
        CHECK(back.height == 5);
        CHECK(back.channels == channels);
        CHECK(back.samples == image.samples);
    }
}

TEST_CASE("png: equal images give equal bytes") {
    const Image image{2, 1, 3, {1, 2, 3, 4, 5, 6}};
    CHECK(to_png(image) == to_png(image));
}

TEST_CASE("png: writing a wrong number of samples throws std::invalid_argument") {
    CHECK_THROWS_AS(to_png({2, 2, 1, {0, 0, 0}}), std::invalid_argument);
    CHECK_THROWS_AS(to_png({0, 0, 1, {}}), std::invalid_argument);
    CHECK_THROWS_AS(to_png({1, 1, 5, {0, 0, 0, 0, 0}}), std::invalid_argument);
}

}  // namespace png_test
