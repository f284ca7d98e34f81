// SPDX-License-Identifier: MIT
// Any text is a scenario or an InputError.
#include "scenario/document/toml.hpp"
#include "scenario/scenario.hpp"
#include "sim/error.hpp"

#include <cstddef>
#include <cstdint>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(bytes), size);
    try {
        rovernet::read_scenario(rovernet::parse_toml(text, "fuzz.toml"), "fuzz.toml");
    } catch (const rovernet::InputError&) {
    }
    return 0;
}
