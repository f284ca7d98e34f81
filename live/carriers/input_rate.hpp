// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>

namespace rovernet {

/// Limit of what one client may say to a run that goes by the clock: 5,000 messages and 16 MiB a
/// second. What a second allows may come at once. Whoever has said more is not read for a while,
/// and TCP holds it back.
class InputRate {
  public:
    using Clock = std::chrono::steady_clock;

    /// Takes note of what came in.
    void add(std::size_t messages, std::size_t bytes, Clock::time_point now) {
        messages_paid_ = std::max(messages_paid_, now) + messages * time_a_message;
        bytes_paid_ = std::max(bytes_paid_, now) + bytes * time_a_byte;
    }
    /// Time from which on the client may be read again.
    Clock::time_point read_again() const {
        return std::max(messages_paid_, bytes_paid_) - std::chrono::seconds(1);
    }

  private:
    static constexpr std::chrono::microseconds time_a_message{200};
    static constexpr std::chrono::nanoseconds time_a_byte{60};  // 16 MiB in 1.007 s

    // Times by which everything that came in would have come at that rate.
    Clock::time_point messages_paid_{}, bytes_paid_{};
};

}  // namespace rovernet
