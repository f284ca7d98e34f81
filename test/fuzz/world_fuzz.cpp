// SPDX-License-Identifier: MIT
// Any file is a Stage world or an InputError, and so are its walls and its robots.
#include "scenario/stage/stage_world.hpp"
#include "scene/stage/stage_walls.hpp"
#include "scene/stage/worldfile.hpp"
#include "sim/error.hpp"
#include "test/fuzz/fuzz_file.hpp"

#include <string>
#include <vector>

extern "C" int LLVMFuzzerInitialize(int*, char***) {
    unsetenv("STAGEPATH");
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    const rovernet::test::FuzzFile file(bytes, size);
    const rovernet::WorldOptions options{.lenient = size % 2 == 1};
    try {
        const rovernet::WorldFile world = rovernet::read_worldfile(file.path(), options);
        std::vector<std::string> notices;
        try {
            rovernet::stage_document(world, notices);
        } catch (const rovernet::InputError&) {  // the walls are looked at all the same
        }
        rovernet::stage_walls(world, options);
    } catch (const rovernet::InputError&) {
    }
    return 0;
}
