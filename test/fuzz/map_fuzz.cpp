// SPDX-License-Identifier: MIT
// Any file is a map.yaml or an InputError. The picture that it should name lies beside it.
#include "scene/occupancy.hpp"
#include "sim/error.hpp"
#include "test/scene/temporary_folder.hpp"

#include <cstddef>
#include <cstdint>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    static const rovernet::test::TemporaryFolder folder;
    static const auto picture = folder.write("office.png", "P2 3 2 255 0 1 127 128 254 255");
    const auto map = folder.write("map.yaml", {reinterpret_cast<const char*>(bytes), size});
    try {
        rovernet::read_ros_map(map);
    } catch (const rovernet::InputError&) {
    }
    return 0;
}
