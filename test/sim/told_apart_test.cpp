// SPDX-License-Identifier: MIT
#include "sim/told_apart.hpp"

#include <doctest/doctest.h>

namespace told_apart_test {
using namespace rovernet;

TEST_CASE("rounding beside a limit: the rounded number stays on the same side of the limit") {
    CHECK(told_apart(0.05, 0.1, 3) == "0.050");
    CHECK(told_apart(0.0996, 0.1, 3) == "0.0996");
    CHECK(told_apart(0.00099999, 0.001, 3) == "0.00099999");
    CHECK(told_apart(20.04, 20, 1) == "20.04");
    CHECK(told_apart(20.06, 20, 1) == "20.1");
    CHECK(told_apart(-0.0996, -0.1, 3) == "-0.0996");
}

}  // namespace told_apart_test
