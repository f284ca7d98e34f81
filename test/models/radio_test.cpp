// SPDX-License-Identifier: MIT
#include "models/radio.hpp"

#include "test/models/vectors.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <stdexcept>

namespace radio_test {
using namespace rovernet;
using test::near;

TEST_CASE("radio: the default power is 45 mW") {
    CHECK(near(Radio{}.power.value, to_dbm({45}).value, 1e-4));  // [dB]: 1 uW of 45 mW
}

TEST_CASE("radio: noise floors equal the test vectors") {
    const test::Vectors vectors("noise_floor.csv");
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        const Hertz bandwidth{vectors.number(i, "bandwidth_Hz")};
        const Db figure{vectors.number(i, "NF_dB")};
        CAPTURE(bandwidth.value);
        CHECK(near(noise_floor(bandwidth, figure).value,
                   vectors.number(i, "kTB_dBm(CODATA k,290K)"), test::vector_tolerance));
        CHECK(noise_floor({.bandwidth = bandwidth, .noise_figure = figure}) ==
              noise_floor(bandwidth, figure));
    }
}

}  // namespace radio_test
