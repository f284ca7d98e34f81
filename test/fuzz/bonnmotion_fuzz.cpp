// SPDX-License-Identifier: MIT
// Any file is a movement file of BonnMotion, zipped or not, or an InputError, strictly read or not.
#include "test/fuzz/played_movements.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    rovernet::test::play_movements(bytes, size);
    return 0;
}
