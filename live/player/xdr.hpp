// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

// XDR encoding (RFC 4506) of Player messages: numbers of 4 or 8 bytes, big-endian; arrays are
// preceded by their number of elements, twice.

namespace rovernet {

/// Exception for an invalid message of a Player client.
class MalformedMessage : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Writer of XDR elements, one after the other.
class XdrWriter {
  public:
    XdrWriter& u32(std::uint32_t value);
    XdrWriter& i32(std::int32_t value) { return u32(static_cast<std::uint32_t>(value)); }
    XdrWriter& f32(float value);
    XdrWriter& f64(double value);
    /// Writes several 8-byte numbers, without a count.
    XdrWriter& f64s(std::span<const double> values);
    /// Writes the number of elements that precedes an array, twice.
    XdrWriter& count(std::size_t elements);
    /// Writes an array of bytes, padded with zeros to a multiple of 4.
    XdrWriter& bytes(std::string_view bytes);
    /// Writes a text as an array of bytes, with a terminating zero.
    XdrWriter& text(std::string_view text);
    /// Writes zeros. @param size  number of zero bytes, a multiple of 4
    XdrWriter& zeros(std::size_t size);

    std::string take() { return std::exchange(bytes_, {}); }

  private:
    std::string bytes_;
};

/// Reader of XDR elements. Counts are checked against the available bytes before memory is
/// allocated.
class XdrReader {
  public:
    /// @param bytes  must outlive the reader
    explicit XdrReader(std::string_view bytes) : rest_(bytes) {}

    /// Next 4-byte number. @throws MalformedMessage if fewer bytes are left
    std::uint32_t u32();
    double f64();
    /// Next 8-byte number, which must lie between -`most` and `most`. @throws MalformedMessage
    double f64_within(double most);
    /// Next array of bytes. @throws MalformedMessage if bytes are missing, or if the two counts
    /// before the array differ
    std::string_view bytes();
    /// Next text, without its terminating zero. @throws MalformedMessage
    std::string_view text();

  private:
    std::string_view take(std::size_t size);

    std::string_view rest_;
};

}  // namespace rovernet
