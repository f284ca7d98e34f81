// SPDX-License-Identifier: MIT
// Any line of a controller is answered, by the state after the step or by what is wrong with it.
#include "live/lockstep/lockstep.hpp"
#include "scenario/document/toml.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>

using namespace rovernet;

namespace {

/// Three robots in a row, of which neighbours hear one another.
constexpr std::string_view three_in_a_row = R"(
scenario = { name = "row", duration = "2 s" }
propagation = { model = "friis" }
radio = { sensitivity = "-70 dBm" }
robot = [
  { name = "A", at = ["0 m", "0 m"] },
  { name = "B", at = ["150 m", "0 m"] },
  { name = "C", at = ["300 m", "0 m"] },
]
)";

/// One controller, whose lines are counted as they are answered.
class Controlled {
  public:
    Controlled()
        : lockstep_({}, {.send = [this](auto, auto) { ++answers_; },
                         .close = [](auto) {},
                         .fingerprint = [] { return std::string(); }}) {
        begin();
    }

    bool is_over() const { return lockstep_.is_done(); }
    void say(std::string_view line) {
        const std::size_t before = answers_;
        lockstep_.received(0, line);
        go_on();
        if (is_over()) lockstep_.ended("", {});
        if (answers_ == before) std::abort();
    }

  private:
    void begin() {
        old_ = std::move(session_);
        session_ = std::make_unique<Session>(scenario_);
        session_->step(start_of_run);
        lockstep_.begin(*session_, scenario_);
    }
    void go_on() {
        for (; lockstep_.next() != never; lockstep_.tell()) session_->step(lockstep_.next());
        if (!lockstep_.new_seed()) return;
        scenario_.scenario.seed = *lockstep_.new_seed();
        begin();
        go_on();
    }

    Scenario scenario_ = read_scenario(parse_toml(three_in_a_row, "row.toml"), "row.toml");
    std::unique_ptr<Session> session_, old_;
    std::size_t answers_ = 0;
    Lockstep lockstep_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    constexpr int most_lines = 30;  // a run of many steps shows no more than one of a few
    std::string_view lines(reinterpret_cast<const char*>(bytes), size);
    Controlled controlled;
    for (int i = 0; i < most_lines && !lines.empty() && !controlled.is_over(); ++i) {
        const std::size_t end = lines.find('\n');
        controlled.say(lines.substr(0, end));
        lines.remove_prefix(end == lines.npos ? lines.size() : end + 1);
    }
    return 0;
}
