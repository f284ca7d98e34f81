// SPDX-License-Identifier: MIT
#include "files/base64.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace rovernet {
namespace {

constexpr std::string_view digits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::uint32_t no_digit = 64;

constexpr auto values = [] {
    std::array<std::uint8_t, 256> table{};
    table.fill(no_digit);
    for (std::size_t i = 0; i < digits.size(); ++i) {
        table[static_cast<unsigned char>(digits[i])] = static_cast<std::uint8_t>(i);
    }
    return table;
}();

}  // namespace

std::string base64(std::string_view bytes) {
    const auto byte = [&](std::size_t i) -> std::uint32_t {
        return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0;
    };
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::uint32_t bits = byte(i) << 16U | byte(i + 1) << 8U | byte(i + 2);
        out += digits[bits >> 18U];
        out += digits[bits >> 12U & 63U];
        out += i + 1 < bytes.size() ? digits[bits >> 6U & 63U] : '=';
        out += i + 2 < bytes.size() ? digits[bits & 63U] : '=';
    }
    return out;
}

std::optional<std::string> from_base64(std::string_view text) {
    if (text.size() % 4 != 0) return std::nullopt;
    const std::size_t padding = text.ends_with("==") ? 2 : text.ends_with('=') ? 1 : 0;
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3);
    for (std::size_t i = 0; i < text.size(); i += 4) {
        const bool is_last = i + 4 == text.size();
        const std::size_t given = is_last ? 4 - padding : 4;
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            const std::uint32_t value =
                k < given ? values[static_cast<unsigned char>(text[i + k])] : 0;
            if (value == no_digit) return std::nullopt;
            bits = bits << 6U | value;
        }
        const std::size_t made = given - 1;
        // Bits that belong to no byte are 0, so that each text has one meaning.
        if ((bits & (0xffffffU >> 8U * made)) != 0) return std::nullopt;
        for (std::size_t k = 0; k < made; ++k) {
            bytes += static_cast<char>(bits >> (16U - 8U * k) & 0xffU);
        }
    }
    return bytes;
}

}  // namespace rovernet
