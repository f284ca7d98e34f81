// SPDX-License-Identifier: MIT
// An ns-2 trace, written to a function in place of a file: a message that is relayed once.
#include "rovernet.hpp"

#include <fmt/format.h>

using namespace rovernet;
using namespace std::chrono_literals;

int main() {
    Network net{{.propagation = Disc{.range = {50}}}};
    const auto a = net.add({.name = "a", .at = {0, 0}});
    net.add({.name = "b", .at = {40, 0}});
    net.add({.name = "c", .at = {80, 0}, .move = ToGoal{.to = {90, 0}, .speed = {1}}});
    net.route(Flood{.ttl = 2});
    net.add_sink(
        Ns2Trace{[](std::string_view lines) { fmt::print("{}", lines); }, Ns2Format::old_format});
    net.at(start_of_run + 1s, [&] { net.send(a, everyone, "hello"); });
    net.run_for(2s);
    net.finish();
}
