// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/session.hpp"
#include "live/carriers/front.hpp"

#include <algorithm>

namespace rovernet::test {

/// Advances a session with a front to `end` like run_paced(), but without a clock.
inline void run_front(Session& session, Front& front, Time end) {
    for (;;) {
        const Time now = session.network().now();
        const Time stop = std::min({end, front.next(), front.limit()});
        if (stop > now) session.step(stop);
        if (front.next() <= session.network().now()) {
            front.tell();
        } else if (stop <= now || stop == end) {
            return;
        }
    }
}

}  // namespace rovernet::test
