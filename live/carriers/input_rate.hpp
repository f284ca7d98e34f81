// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>

namespace rovernet {

/// Rate limit for the input of one client in a paced run: 5,000 messages and 16 MiB per second,
/// with bursts of one second. Beyond the limit the client's input is not read for a while, so that
/// TCP flow control slows the client down.
class InputRate {
  public:
    using Clock = std::chrono::steady_clock;

    /// Counts input that the client has sent.
    void add(std::size_t messages, std::size_t bytes, Clock::time_point now) {
        messages_paid_ = std::max(messages_paid_, now) + messages * time_a_message;
        bytes_paid_ = std::max(bytes_paid_, now) + bytes * time_a_byte;
    }
    /// Earliest time at which input of the client may be read again.
    Clock::time_point read_again() const {
        return std::max(messages_paid_, bytes_paid_) - std::chrono::seconds(1);
    }

  private:
    static constexpr std::chrono::microseconds time_a_message{200};
    static constexpr std::chrono::nanoseconds time_a_byte{60};  // 16 MiB in 1.007 s

    // Times at which the input so far would have arrived if the client had sent it at the allowed
    // rate of messages, and of bytes.
    Clock::time_point messages_paid_{}, bytes_paid_{};
};

}  // namespace rovernet
