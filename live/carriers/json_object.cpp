// SPDX-License-Identifier: MIT
#include "live/carriers/json_object.hpp"

#include "scenario/document/quantity.hpp"
#include "sim/error.hpp"

#include <algorithm>
#include <cstring>

namespace rovernet {

using simdjson::dom::element_type;

namespace {

/// What was found, in the words of an error.
std::string found(const simdjson::dom::element& value) {
    switch (value.type()) {
        case element_type::NULL_VALUE: return "null";
        case element_type::BOOL: return value.get_bool().value_unsafe() ? "true" : "false";
        case element_type::STRING: return "a text";
        case element_type::ARRAY: return "a list";
        case element_type::OBJECT: return "an object";
        default: return fmt::format("{}", value.get_double().value_unsafe());
    }
}

constexpr std::size_t deepest = 32;  // levels of brackets

[[noreturn]] void fail_text(simdjson::error_code error) {
    switch (error) {
        case simdjson::DEPTH_ERROR:
            throw RequestError("too_deep", "",
                               fmt::format("expected {} levels of brackets at most", deepest));
        case simdjson::UTF8_ERROR: throw RequestError("bad_utf8", "", "the text is not UTF-8");
        default:
            throw RequestError(
                "bad_json", "",
                fmt::format("expected one JSON object: {}", simdjson::error_message(error)));
    }
}

}  // namespace

simdjson::dom::element JsonParser::parse(std::string_view text) {
    constexpr std::size_t first_capacity = 4096;
    if (parser_.capacity() == 0) (void)!parser_.allocate(first_capacity, deepest);
    padded_.resize(std::max(padded_.size(), text.size() + simdjson::SIMDJSON_PADDING));
    std::memcpy(padded_.data(), text.data(), text.size());
    simdjson::dom::element document;
    const auto error = parser_.parse(padded_.data(), text.size(), false).get(document);
    if (error != simdjson::SUCCESS) fail_text(error);
    return document;
}

std::string JsonPath::text() const {
    if (!above) return std::string(key);
    const std::string outer = above->text();
    if (key.data() == nullptr) return fmt::format("{}[{}]", outer, index);
    return outer.empty() ? std::string(key) : fmt::format("{}.{}", outer, key);
}

void JsonElement::expected(std::string_view what) const {
    fail("bad_type", fmt::format("found {}; expected {}", found(value), what));
}

double JsonElement::number(const Range& range) const {
    double number = 0;
    if (value.get_double().get(number) != simdjson::SUCCESS) expected("a number");
    if (!range.contains(number)) {
        fail("out_of_range", fmt::format("found {}; expected a number {}", number, range.text));
    }
    return number;
}

std::uint64_t JsonElement::whole_number(std::uint64_t lowest, std::uint64_t highest) const {
    std::uint64_t number = 0;
    const bool is_whole = value.get_uint64().get(number) == simdjson::SUCCESS;
    if (is_whole && number >= lowest && number <= highest) return number;
    const std::string limits = fmt::format("a whole number from {} to {}", lowest, highest);
    if (!value.is_number()) expected(limits);
    fail("out_of_range", fmt::format("found {}; expected {}",
                                     is_whole ? std::to_string(number) : found(value), limits));
}

bool JsonElement::truth() const {
    bool is_true = false;
    if (value.get_bool().get(is_true) != simdjson::SUCCESS) expected("true or false");
    return is_true;
}

std::string_view JsonElement::text() const {
    std::string_view text;
    if (value.get_string().get(text) != simdjson::SUCCESS) expected("a text");
    return text;
}

double JsonElement::seconds() const {
    if (!value.is_string()) expected("a time in quotes with its unit, such as \"0.5 s\"");
    const std::string quantity(text());
    try {
        return read_quantity(Value(quantity), path.key, Dimension::time);
    } catch (const InputError& fault) {
        fail("bad_value", fault.message());
    }
}

simdjson::dom::object JsonElement::object() const {
    simdjson::dom::object object;
    if (value.get_object().get(object) != simdjson::SUCCESS) expected("an object { ... }");
    return object;
}

simdjson::dom::array JsonElement::array() const {
    simdjson::dom::array array;
    if (value.get_array().get(array) != simdjson::SUCCESS) expected("a list [ ... ]");
    return array;
}

void fail_unknown_key(const JsonPath& object, std::string_view key,
                      std::vector<std::string> known) {
    const std::string meant = did_you_mean(key, known);
    const std::string message = fmt::format(
        "unknown key \"{}\"; {}", key,
        meant.empty() ? fmt::format("known keys are {}", fmt::join(known, ", ")) : meant);
    throw RequestError("unknown_key", JsonPath{.above = &object, .key = key}.text(), message);
}

void fail_missing_key(const JsonPath& object, std::string_view key, std::string_view example) {
    throw RequestError("missing_key", JsonPath{.above = &object, .key = key}.text(),
                       fmt::format("\"{}\" is missing; expected a value such as {}", key, example));
}

void fail_repeated_key(const JsonPath& object, std::string_view key) {
    throw RequestError("repeated_key", JsonPath{.above = &object, .key = key}.text(),
                       fmt::format("\"{}\" is given twice", key));
}

}  // namespace rovernet
