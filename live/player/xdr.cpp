// SPDX-License-Identifier: MIT
#include "live/player/xdr.hpp"

#include <bit>
#include <cmath>

namespace rovernet {
namespace {

/// Zeros after so many bytes, up to a multiple of 4.
std::size_t padding(std::size_t size) { return (4 - size % 4) % 4; }

/// Number of the bytes, the highest first.
std::uint64_t number_in(std::string_view bytes) {
    std::uint64_t number = 0;
    for (const char byte : bytes) number = number << 8U | static_cast<unsigned char>(byte);
    return number;
}

void append_number(std::string& out, std::uint64_t number, unsigned bytes) {
    for (unsigned i = bytes; i-- > 0;) out += static_cast<char>(number >> (8 * i) & 0xFFU);
}

}  // namespace

XdrWriter& XdrWriter::u32(std::uint32_t value) {
    append_number(bytes_, value, 4);
    return *this;
}

XdrWriter& XdrWriter::f32(float value) { return u32(std::bit_cast<std::uint32_t>(value)); }

XdrWriter& XdrWriter::f64(double value) {
    append_number(bytes_, std::bit_cast<std::uint64_t>(value), 8);
    return *this;
}

XdrWriter& XdrWriter::f64s(std::span<const double> values) {
    for (const double value : values) f64(value);
    return *this;
}

XdrWriter& XdrWriter::count(std::size_t elements) {
    return u32(static_cast<std::uint32_t>(elements)).u32(static_cast<std::uint32_t>(elements));
}

XdrWriter& XdrWriter::bytes(std::string_view bytes) {
    count(bytes.size());
    bytes_ += bytes;
    return zeros(padding(bytes.size()));
}

XdrWriter& XdrWriter::text(std::string_view text) { return bytes(std::string(text) + '\0'); }

XdrWriter& XdrWriter::zeros(std::size_t size) {
    bytes_.append(size, '\0');
    return *this;
}

std::string_view XdrReader::take(std::size_t size) {
    if (size > rest_.size()) throw MalformedMessage("the message is too short");
    const std::string_view taken = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return taken;
}

std::uint32_t XdrReader::u32() { return static_cast<std::uint32_t>(number_in(take(4))); }
double XdrReader::f64() { return std::bit_cast<double>(number_in(take(8))); }

double XdrReader::f64_within(double most) {
    const double number = f64();
    if (!(std::abs(number) <= most))
        throw MalformedMessage("a number in the message is outside of the allowed range");
    return number;
}

std::string_view XdrReader::bytes() {
    const std::uint32_t elements = u32();
    if (u32() != elements)
        throw MalformedMessage(
            "the message gives the length of an array twice, and the two lengths differ");
    const std::string_view bytes = take(elements);
    take(padding(elements));
    return bytes;
}

std::string_view XdrReader::text() {
    const std::string_view text = bytes();
    return text.substr(0, text.find('\0'));
}

}  // namespace rovernet
