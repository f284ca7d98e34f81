// SPDX-License-Identifier: MIT
#pragma once

#include "sim/message.hpp"

namespace rovernet {

/// Control frames of IEEE 802.11: name, and size [bytes] with the frame check sequence;
/// 802.11-2020, 9.3.1.
inline constexpr ControlFrame wifi_rts{"RTS", 20};
inline constexpr ControlFrame wifi_cts{"CTS", 14};
inline constexpr ControlFrame wifi_ack{"ACK", 14};

}  // namespace rovernet
