// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

// Encoding of numbers as bytes. Integers of a fixed size are little endian. A varint has 7 bits per
// byte, lowest first, with the high bit set in all bytes but the last (LEB128). A signed number is
// first folded into an unsigned one: 0, -1, 1, -2, ... become 0, 1, 2, 3, ...

namespace rovernet {

/// Length of the longest varint (integer of variable length) [bytes].
inline constexpr std::size_t longest_varint = 10;

/// Writes a varint (integer of variable length) at `at`. @return position after the varint
inline char* write_varint(char* at, std::uint64_t value) {
    while (value >= 0x80) {
        *at++ = static_cast<char>(value | 0x80);
        value >>= 7;
    }
    *at++ = static_cast<char>(value);
    return at;
}
/// Unsigned number that encodes a signed number: 0, -1, 1, -2 become 0, 1, 2, 3.
constexpr std::uint64_t folded(std::int64_t value) {
    return (static_cast<std::uint64_t>(value) << 1) ^ static_cast<std::uint64_t>(value >> 63);
}
/// Signed number encoded by an unsigned number, see folded().
constexpr std::int64_t unfolded(std::uint64_t value) {
    return static_cast<std::int64_t>((value >> 1) ^ (~(value & 1) + 1));
}

/// Buffer to which numbers and texts are appended.
class ByteWriter {
  public:
    /// Reserves `size` bytes at the end of the buffer. @return pointer to these bytes, valid until
    /// the next call
    char* room(std::size_t size) {
        if (used_ + size > bytes_.size()) bytes_.resize(2 * bytes_.size() + size);
        return bytes_.data() + used_;
    }
    /// Sets the end of the bytes written into room().
    void end_at(const char* end) { used_ = static_cast<std::size_t>(end - bytes_.data()); }

    /// Appends an integer of a fixed size, little endian.
    template <class Integer>
    void fixed(Integer value) {
        char* at = room(sizeof value);
        put(at, value);
        used_ += sizeof value;
    }
    /// Appends a number as a varint.
    void varint(std::uint64_t value) { end_at(write_varint(room(longest_varint), value)); }
    void signed_varint(std::int64_t value) { varint(folded(value)); }
    /// Appends the 8 bytes of an IEEE 754 number.
    void real(double value) { fixed(std::bit_cast<std::uint64_t>(value)); }
    /// Appends bytes unchanged.
    void bytes(std::string_view text);
    /// Appends a text after its length, which takes 4 bytes.
    void text(std::string_view text) {
        fixed(static_cast<std::uint32_t>(text.size()));
        bytes(text);
    }
    /// Overwrites an integer at the position `place` [bytes].
    template <class Integer>
    void overwrite(std::size_t place, Integer value) {
        put(bytes_.data() + place, value);
    }

    std::size_t size() const { return used_; }
    std::string_view view() const { return {bytes_.data(), used_}; }
    void clear() { used_ = 0; }

  private:
    template <class Integer>
    static void put(char* at, Integer value) {
        auto rest = static_cast<std::uint64_t>(value);
        for (std::size_t i = 0; i < sizeof value; ++i, rest >>= 8) at[i] = static_cast<char>(rest);
    }

    std::vector<char> bytes_;
    std::size_t used_ = 0;
};

/// Reader of numbers and texts from bytes, in order. Reading beyond the end returns 0 or empty, and
/// sets failed().
class ByteReader {
  public:
    explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

    template <class Integer>
    Integer fixed() {
        const std::string_view bytes = take(sizeof(Integer));
        std::uint64_t value = 0;
        for (std::size_t i = bytes.size(); i-- > 0;) {
            value = value << 8 | static_cast<unsigned char>(bytes[i]);
        }
        return static_cast<Integer>(value);
    }
    std::uint64_t varint();
    std::int64_t signed_varint() { return unfolded(varint()); }
    double real() { return std::bit_cast<double>(fixed<std::uint64_t>()); }
    /// Next `size` bytes; empty if there are fewer.
    std::string_view take(std::uint64_t size);
    /// Next text, which is preceded by its length [bytes] as a 4-byte integer.
    std::string_view text() { return take(fixed<std::uint32_t>()); }

    std::size_t left() const { return rest_.size(); }
    /// Whether a function tried to read beyond the end, or a varint was longer than 64 bits.
    bool failed() const { return failed_; }
    /// Whether all bytes were read, without failure.
    bool is_done() const { return !failed_ && rest_.empty(); }

  private:
    void fail() {
        failed_ = true;
        rest_ = {};
    }

    std::string_view rest_;
    bool failed_ = false;
};

}  // namespace rovernet
