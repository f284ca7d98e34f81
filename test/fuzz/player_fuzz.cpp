// SPDX-License-Identifier: MIT
// Any bytes of a Player client are survived, and leave another client its data.
#include "live/player/front.hpp"
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
  { name = "A", at = ["0 m", "0 m"], scan = { kind = "laser", beams = 3 } },
  { name = "B", at = ["15 m", "0 m"], scan = [
    { kind = "ranger", beams = 3 },
    { kind = "ranger", angles = ["0 deg", "90 deg"], places = [["0 m", "0 m"], ["1 m", "0 m"]] },
  ] },
]
)";

/// Two clients: one that is fuzzed, and one that is told where robot A is.
class Served {
  public:
    Served()
        : front_({.places = {{"A", 0, 0}, {"B", 0, 1}}},
                 {.send = [this](auto to, auto) { told_ += to == bystander ? 1 : 0; },
                  .close = [this](auto which) { is_closed_ |= which == fuzzed; }}) {
        session_.step(start_of_run);
        front_.begin(session_, scenario_);
        for (const auto client : {fuzzed, bystander}) front_.opened(client, {0, 6665});
        PlayerAddress position{PlayerInterface::position2d, 0};
        XdrWriter open;
        put_address(open, position, 6665).u32(1).count(0);
        front_.received(
            bystander,
            encode({{PlayerInterface::player, 0}, PlayerType::request, 3, 0, 0, open.take()}, 0));
    }

    bool is_closed() const { return is_closed_; }
    void say(std::string_view bytes) {
        front_.received(fuzzed, bytes);
        const std::size_t before = told_;
        const Time until = session_.network().now() + std::chrono::milliseconds(100);
        while (session_.network().now() < std::min(until, session_.end())) {
            session_.step(std::min(front_.next(), until));
            if (front_.next() <= session_.network().now()) front_.tell();
        }
        if (session_.network().now() == until && told_ == before) std::abort();
    }
    void leave() { front_.closed(fuzzed); }

  private:
    static constexpr Front::Connection fuzzed = 0, bystander = 1;

    Scenario scenario_ = read_scenario(parse_toml(two_robots, "two.toml"), "two.toml");
    Session session_{scenario_};
    std::size_t told_ = 0;
    bool is_closed_ = false;
    PlayerFront front_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    constexpr std::size_t pieces = 4;
    const std::string_view all(reinterpret_cast<const char*>(bytes), size);
    Served served;
    for (std::size_t i = 0; i < pieces && !served.is_closed(); ++i) {
        const std::size_t begin = size * i / pieces;
        served.say(all.substr(begin, size * (i + 1) / pieces - begin));
    }
    served.leave();
    return 0;
}
