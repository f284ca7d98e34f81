// SPDX-License-Identifier: MIT
#include "files/base64.hpp"
#include "live/rosbridge/writer.hpp"
#include "scenario/document/json.hpp"

#include <charconv>
#include <cmath>
#include <type_traits>

namespace rovernet {
namespace {

template <class Number>
void append(std::string& out, Number value) {
    if constexpr (std::is_floating_point_v<Number>) {
        if (!std::isfinite(value)) {
            out += "null";
            return;
        }
    }
    char digits[32];
    out.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

}  // namespace

/// Puts a comma between two values, and between a value and the next key.
void RosJsonWriter::separate() {
    constexpr std::string_view begins = "{[:";
    if (!out_.empty() && begins.find(out_.back()) == begins.npos) out_ += ',';
}

void RosJsonWriter::open_object() {
    separate();
    out_ += '{';
}

void RosJsonWriter::open_list() {
    separate();
    out_ += '[';
}

void RosJsonWriter::key(std::string_view name) {
    text(name);
    out_ += ':';
}

void RosJsonWriter::number(double value) {
    separate();
    append(out_, value);
}

void RosJsonWriter::whole(std::int64_t value) {
    separate();
    append(out_, value);
}

void RosJsonWriter::text(std::string_view value) {
    separate();
    out_ += to_json_line(Value(value));
}

void RosJsonWriter::truth(bool value) {
    separate();
    out_ += value ? "true" : "false";
}

void RosJsonWriter::null() {
    separate();
    out_ += "null";
}

void RosJsonWriter::bytes(std::string_view value) {
    separate();
    out_ += '"';
    out_ += base64(value);
    out_ += '"';
}

template <class Number>
void RosJsonWriter::list(std::span<const Number> values) {
    open_list();
    for (const Number value : values) {
        separate();
        append(out_, value);
    }
    close_list();
}

void RosJsonWriter::numbers(std::span<const float> values) { list(values); }
void RosJsonWriter::numbers(std::span<const double> values) { list(values); }
void RosJsonWriter::numbers(std::span<const std::int8_t> values) { list(values); }

}  // namespace rovernet
