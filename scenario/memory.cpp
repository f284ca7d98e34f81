// SPDX-License-Identifier: MIT
#include "scenario/memory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <sys/resource.h>
#include <unistd.h>

namespace rovernet {
namespace {

// Bytes per robot, measured with a Release build on x86-64: peak memory of `run` minus that of an
// empty scenario.
constexpr std::uint64_t of_standing = 280;
constexpr std::uint64_t of_moving = 1000;

std::uint64_t memory_of(const RobotTable& robot) {
    const bool stands = std::holds_alternative<FixedTable>(robot.move.model);
    return static_cast<std::uint64_t>(robot.count.value_or(1)) * (stands ? of_standing : of_moving);
}

double gigabytes(std::uint64_t bytes) { return static_cast<double>(bytes) / 1e9; }

}  // namespace

std::uint64_t available_memory() {
    const auto pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGESIZE);
    std::uint64_t bytes = std::numeric_limits<std::uint64_t>::max();
    if (pages > 0 && size > 0) {
        bytes = static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(size);
    }
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) {
        bytes = std::min<std::uint64_t>(bytes, limit.rlim_cur);
    }
    return bytes;
}

std::uint64_t robots_memory(const Scenario& scenario) {
    std::uint64_t bytes = of_moving * scenario.movement.robots.size();
    for (const RobotTable& robot : scenario.robots) bytes += memory_of(robot);
    return bytes;
}

void check_memory(Scenario& scenario, std::uint64_t available) {
    constexpr std::uint64_t many = 1'000'000'000;  // [bytes]
    const std::uint64_t bytes = robots_memory(scenario);
    if (scenario.robots.empty() || bytes <= std::min(many, available)) return;
    const auto most = std::max_element(
        scenario.robots.begin(), scenario.robots.end(),
        [](const RobotTable& a, const RobotTable& b) { return memory_of(a) < memory_of(b); });
    const std::string need =
        fmt::format("the robots take about {:.1f} GB of memory", gigabytes(bytes));
    if (bytes > available) {
        throw InputError(
            most->where,
            fmt::format("count: {}, but this process may use only {:.1f} GB; expected fewer robots",
                        need, gigabytes(available)));
    }
    scenario.notices.push_back(fmt::format("{}: {}", most->where.text(), need));
}

}  // namespace rovernet
