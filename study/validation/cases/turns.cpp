// SPDX-License-Identifier: MIT
#include "study/validation/cases/turns.hpp"

#include <algorithm>
#include <cstddef>
#include <ctime>

namespace rovernet {
namespace {

double cpu_s_of_thread() {
    std::timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Passes that fill a turn; one more before them warms the caches.
double ns_per_operation(const TimedMethod& method, double least_s) {
    volatile double sink = method.pass();
    const double begin = cpu_s_of_thread();
    double passes = 0, spent = 0;
    do {
        sink = method.pass();
        ++passes;
        spent = cpu_s_of_thread() - begin;
    } while (spent < least_s);
    static_cast<void>(sink);
    return 1e9 * spent / (passes * method.operations);
}

}  // namespace

std::vector<TurnCost> costs_in_turns(std::span<const TimedMethod> methods, const Turns& turns) {
    std::vector<std::vector<double>> seen(methods.size());
    for (int turn = 0; turn < turns.turns; ++turn) {
        for (std::size_t i = 0; i < methods.size(); ++i) {
            seen[i].push_back(ns_per_operation(methods[i], turns.least_s));
        }
    }
    std::vector<TurnCost> out;
    for (auto& each : seen) {
        std::sort(each.begin(), each.end());
        out.push_back({each[each.size() / 2], each.front(), each.back()});
    }
    return out;
}

}  // namespace rovernet
