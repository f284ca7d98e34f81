// SPDX-License-Identifier: MIT
#include "live/rosbridge/clock.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace rovernet {

void RosClock::begin(Step step) {
    limit_ = limit_ == never ? step.until : std::max(limit_, step.until);
    holders_.insert(step.client);
    steps_.push_back(std::move(step));
}

std::size_t RosClock::steps(Connection client) const {
    return static_cast<std::size_t>(std::count_if(
        steps_.begin(), steps_.end(), [&](const Step& each) { return each.client == client; }));
}

std::vector<RosClock::Step> RosClock::pause(Connection client, Time now) {
    limit_ = now;
    holders_.insert(client);
    of_nobody_.reset();
    return std::exchange(steps_, {});
}

std::vector<RosClock::Step> RosClock::unpause() {
    limit_ = never;
    holders_.clear();
    of_nobody_.reset();
    return std::exchange(steps_, {});
}

std::vector<RosClock::Step> RosClock::left(Connection client) {
    for (const Step& each : steps_) {
        if (each.client == client)
            of_nobody_ = std::max(of_nobody_.value_or(each.until), each.until);
    }
    std::erase_if(steps_, [&](const Step& each) { return each.client == client; });
    const bool was_last = holders_.erase(client) > 0 && holders_.empty();
    return was_last ? unpause() : std::vector<Step>{};
}

std::vector<RosClock::Step> RosClock::end_steps(Time now) {
    const auto is_over = [&](const Step& each) { return each.until <= now; };
    std::vector<Step> over;
    std::copy_if(steps_.begin(), steps_.end(), std::back_inserter(over), is_over);
    std::erase_if(steps_, is_over);
    if (of_nobody_ && *of_nobody_ <= now) of_nobody_.reset();
    return over;
}

bool RosClock::is_step_end(Time now) const {
    return of_nobody_ == now || std::any_of(steps_.begin(), steps_.end(),
                                            [&](const Step& each) { return each.until == now; });
}

Time RosClock::next() const {
    Time first = of_nobody_.value_or(never);
    for (const Step& each : steps_) first = std::min(first, each.until);
    return first;
}

}  // namespace rovernet
