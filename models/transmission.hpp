// SPDX-License-Identifier: MIT
#pragma once

#include "sim/time.hpp"
#include "sim/units.hpp"

#include <cstdint>
#include <optional>

namespace rovernet {

/// Modulation and coding, as a number within a physical layer.
enum class Coding : std::uint8_t {};

/// How a frame is transmitted. The physical layer makes one for each frame; the medium, the
/// reception model and records use it.
struct Transmission {
    /// Bit rate of the payload [bit/s].
    BitRate rate;
    /// Modulation and coding of the payload; 0 if the layer does not know the rate.
    Coding coding{};
    /// Bandwidth of the signal [Hz].
    Hertz bandwidth;
    /// Duration of the preamble [ns], and of the payload after it.
    Duration preamble, payload;
    /// Size of the frame [bytes], including the bytes that the access model adds.
    std::uint32_t bytes;

    /// Time on air [ns].
    Duration airtime() const { return preamble + payload; }
};

/// Rule for the detection of a preamble.
struct PreambleDetection {
    /// Time from the start of the preamble at which its level counts [ns].
    Duration after{4'000};
    /// Smallest SINR [dB] at which it is detected; none: that of the reception model.
    std::optional<Db> threshold = std::nullopt;
};

}  // namespace rovernet
