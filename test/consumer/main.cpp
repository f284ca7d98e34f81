// SPDX-License-Identifier: MIT
#include "sim/error.hpp"
#include "sim/time.hpp"

#include <cstdio>

int main() {
    const rovernet::Time end = rovernet::start_of_run + rovernet::from_seconds(1.5);
    const rovernet::InputError error({.source = "rescue.toml", .line = 9, .column = 1}, "example");
    std::printf("%.1f s, %s\n", rovernet::seconds(end), error.what());
}
