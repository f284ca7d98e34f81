// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

// XDR (RFC 4506) as Player's messages use it: every number takes 4 or 8 bytes, the highest first,
// and arrays have their number of elements in front of them twice.

namespace rovernet {

/// Message of a Player client that is not what it should be.
class MalformedMessage : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Writer of a message's bytes, one element after the other.
class XdrWriter {
  public:
    XdrWriter& u32(std::uint32_t value);
    XdrWriter& i32(std::int32_t value) { return u32(static_cast<std::uint32_t>(value)); }
    XdrWriter& f32(float value);
    XdrWriter& f64(double value);
    /// Several numbers, without a count.
    XdrWriter& f64s(std::span<const double> values);
    /// Number of elements of an array that follow, in front of it.
    XdrWriter& count(std::size_t elements);
    /// Array of bytes, filled up with zeros to a multiple of 4.
    XdrWriter& bytes(std::string_view bytes);
    /// Array of the bytes of a text and the zero at its end.
    XdrWriter& text(std::string_view text);
    /// `size` zeros, a multiple of 4.
    XdrWriter& zeros(std::size_t size);

    std::string take() { return std::exchange(bytes_, {}); }

  private:
    std::string bytes_;
};

/// Reader of a message's bytes. Counts are checked against what is there before anything is made of
/// them.
class XdrReader {
  public:
    /// @param bytes  have to live as long
    explicit XdrReader(std::string_view bytes) : rest_(bytes) {}

    /// The next element. @throws MalformedMessage if it is not whole
    std::uint32_t u32();
    double f64();
    /// Number that is no larger than `most`, nor smaller than -`most`. @throws MalformedMessage
    double f64_within(double most);
    /// Array of bytes. @throws MalformedMessage, also if its two counts differ
    std::string_view bytes();
    /// Text, without the zero at its end. @throws MalformedMessage
    std::string_view text();

  private:
    std::string_view take(std::size_t size);

    std::string_view rest_;
};

}  // namespace rovernet
