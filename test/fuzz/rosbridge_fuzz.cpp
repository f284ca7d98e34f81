// SPDX-License-Identifier: MIT
// Any messages of a ROS client, one a line, are survived, and leave another client its clock.
#include "live/rosbridge/front.hpp"
#include "scenario/document/toml.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

using namespace rovernet;

namespace {

constexpr std::string_view two_robots = R"(
scenario = { name = "two", duration = "1 s" }
propagation = { model = "friis" }
robot = [
  { name = "A", at = ["0 m", "0 m"], scan = [{ beams = 3 }, { beams = 2, name = "rear" }] },
  { name = "B", at = ["15 m", "0 m"] },
]
)";

/// Two clients: one that is fuzzed, and one that is told the time.
class Served {
  public:
    Served()
        : front_({.send = [this](auto to, auto) { told_ += to == bystander ? 1 : 0; },
                  .close = [](auto) { std::abort(); },
                  .send_binary =
                      [](auto to, auto) {
                          if (to == bystander) std::abort();
                      }}) {
        session_.step(start_of_run);
        front_.begin(session_, scenario_);
        for (const auto client : {fuzzed, bystander}) front_.opened(client, {0, 9090});
        front_.received(bystander, R"({"op":"subscribe","topic":"/clock"})");
    }

    void say(std::string_view message) {
        front_.received(fuzzed, message);
        const std::size_t before = told_;
        const Time until = std::min(now() + ros_tick, session_.end());
        while (now() < std::min(until, front_.limit())) {
            session_.step(std::min({front_.next(), front_.limit(), until}));
            if (front_.next() <= now()) front_.tell();
        }
        if (now() == until && until < session_.end() && told_ == before) std::abort();
    }
    void leave() {
        front_.closed(fuzzed);
        if (front_.next() <= now()) std::abort();
    }

  private:
    static constexpr Front::Connection fuzzed = 0, bystander = 1;
    Time now() { return session_.network().now(); }

    Scenario scenario_ = read_scenario(parse_toml(two_robots, "two.toml"), "two.toml");
    Session session_{scenario_};
    std::size_t told_ = 0;
    RosbridgeFront front_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    constexpr int most = 64;  // messages
    std::string_view rest(reinterpret_cast<const char*>(bytes), size);
    Served served;
    for (int i = 0; i < most && !rest.empty(); ++i) {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        served.say(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    served.leave();
    return 0;
}
