// SPDX-License-Identifier: MIT
// Any file is a log of inputs that is replayed, the same every time, or an InputError.
#include "live/input_replay.hpp"
#include "sim/error.hpp"
#include "test/scene/temporary_folder.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

namespace {

/// Two robots that hear one another; time is short, as each input may make events until its end.
constexpr const char* two_robots = R"([scenario]
name = "two"
duration = "1 s"
[propagation]
model = "friis"
[[robot]]
name = "A"
at = ["0 m", "0 m"]
[[robot]]
name = "B"
at = ["15 m", "0 m"]
)";

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    static const rovernet::test::TemporaryFolder folder;
    static const auto scenario = folder.write("scenario.toml", two_robots);
    const auto log = folder.write("inputs.jsonl", {reinterpret_cast<const char*>(bytes), size});
    try {
        const auto first = rovernet::replay_inputs(log, {});
        if (rovernet::replay_inputs(log, {}).now != first.now) std::abort();
    } catch (const rovernet::InputError&) {
    }
    return 0;
}
