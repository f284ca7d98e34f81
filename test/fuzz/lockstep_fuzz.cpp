// SPDX-License-Identifier: MIT
// Any line of a controller is answered, by the state after the step or by what is wrong with it.
#include "live/lockstep/lockstep.hpp"
#include "scenario/document/toml.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
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
    Controlled() : lockstep_({}, [this](auto, auto) { ++answers_; }) { begin(); }

    bool is_over() const { return lockstep_.state() == Lockstep::State::over; }
    void say(std::string_view line) {
        const std::size_t before = answers_;
        lockstep_.receive(0, line);
        go_on();
        if (is_over()) lockstep_.tell_end("", {});
        if (answers_ == before) std::abort();
    }

  private:
    void begin() {
        old_ = std::move(session_);
        session_ = std::make_unique<Session>(scenario_);
        lockstep_.begin(*session_, scenario_, [] { return ""; });
    }
    void go_on() {
        while (lockstep_.is_due()) lockstep_.advance([] { return true; });
        if (lockstep_.state() != Lockstep::State::restarts) return;
        scenario_.scenario.seed = lockstep_.seed();
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
