// SPDX-License-Identifier: MIT
#include "live/rosbridge/writer.hpp"

#include <bit>
#include <concepts>

namespace rovernet {
namespace {

/// Major types (RFC 8949, 3.1).
enum MajorType : unsigned {
    whole_number = 0,
    negative_number = 1,
    byte_string = 2,
    text_string = 3,
    tagged = 6,
};
// Items that are one byte (RFC 8949, 3.2.2 and 3.3).
constexpr char map_without_length = '\xbf', list_without_length = '\x9f', break_off = '\xff';
constexpr char false_item = '\xf4', true_item = '\xf5', null_item = '\xf6', double_item = '\xfb';
/// Tags of typed arrays (RFC 8746, 2.1).
enum TypedArray : unsigned { int8_array = 72, float32_array = 85, float64_array = 86 };

template <std::unsigned_integral Bits>
void append_big_endian(std::string& out, Bits bits) {
    for (int shift = 8 * (static_cast<int>(sizeof bits) - 1); shift >= 0; shift -= 8) {
        out += static_cast<char>(static_cast<std::uint64_t>(bits) >> shift);
    }
}

}  // namespace

/// Puts the begin of an item: its major type, and a number in as few bytes as it takes.
void RosCborWriter::head(unsigned major, std::uint64_t count) {
    const auto initial = [&](unsigned info) { out_ += static_cast<char>(major << 5U | info); };
    if (count < 24) {
        initial(static_cast<unsigned>(count));
    } else if (count <= 0xff) {
        initial(24);
        append_big_endian(out_, static_cast<std::uint8_t>(count));
    } else if (count <= 0xffff) {
        initial(25);
        append_big_endian(out_, static_cast<std::uint16_t>(count));
    } else if (count <= 0xffffffff) {
        initial(26);
        append_big_endian(out_, static_cast<std::uint32_t>(count));
    } else {
        initial(27);
        append_big_endian(out_, count);
    }
}

void RosCborWriter::open_object() { out_ += map_without_length; }
void RosCborWriter::close_object() { out_ += break_off; }
void RosCborWriter::open_list() { out_ += list_without_length; }
void RosCborWriter::close_list() { out_ += break_off; }

void RosCborWriter::number(double value) {
    out_ += double_item;
    append_big_endian(out_, std::bit_cast<std::uint64_t>(value));
}

void RosCborWriter::whole(std::int64_t value) {
    const bool is_negative = value < 0;
    head(is_negative ? negative_number : whole_number,
         static_cast<std::uint64_t>(is_negative ? -1 - value : value));
}

void RosCborWriter::text(std::string_view value) {
    head(text_string, value.size());
    out_ += value;
}

void RosCborWriter::truth(bool value) { out_ += value ? true_item : false_item; }
void RosCborWriter::null() { out_ += null_item; }

void RosCborWriter::bytes(std::string_view value) {
    head(byte_string, value.size());
    out_ += value;
}

template <class Number>
void RosCborWriter::typed_array(unsigned array_tag, std::span<const Number> values) {
    static_assert(std::endian::native == std::endian::little);
    head(tagged, array_tag);
    bytes({reinterpret_cast<const char*>(values.data()), values.size_bytes()});
}

void RosCborWriter::numbers(std::span<const float> values) { typed_array(float32_array, values); }
void RosCborWriter::numbers(std::span<const double> values) { typed_array(float64_array, values); }
void RosCborWriter::numbers(std::span<const std::int8_t> values) {
    typed_array(int8_array, values);
}

}  // namespace rovernet
