// SPDX-License-Identifier: MIT
// Any file is an ns-2 trace or an InputError, and its metrics can be computed.
#include "sim/error.hpp"
#include "test/fuzz/fuzz_file.hpp"
#include "traces/ns2/ns2_reader.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    const rovernet::test::FuzzFile file(bytes, size);
    try {
        rovernet::trace_metrics(file.path());
    } catch (const rovernet::InputError&) {
    }
    return 0;
}
