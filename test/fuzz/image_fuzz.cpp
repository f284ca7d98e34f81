// SPDX-License-Identifier: MIT
// Any file is a picture or an InputError, and a picture is a map.
#include "scene/occupancy.hpp"
#include "sim/error.hpp"
#include "test/fuzz/fuzz_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    const rovernet::test::FuzzFile file(bytes, size);
    try {
        rovernet::image_map(file.path(), rovernet::Meters{48}, rovernet::Meters{24});
    } catch (const rovernet::InputError&) {
    }
    return 0;
}
