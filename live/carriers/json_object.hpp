// SPDX-License-Identifier: MIT
#pragma once

#include "live/carriers/request.hpp"
#include "sim/fields.hpp"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <optional>
#include <simdjson.h>
#include <string>
#include <string_view>
#include <vector>

// Parsing of JSON from external programs, by simdjson. Every error is a RequestError with the path
// of the wrong element. Only request readers include this header.

namespace rovernet {

/// Parser of JSON documents that reuses its memory.
class JsonParser {
  public:
    /// Parses a text. The document is valid until the next call.
    /// @throws RequestError "bad_json", "bad_utf8"; "too_deep" beyond 32 nesting levels
    simdjson::dom::element parse(std::string_view text);

  private:
    simdjson::dom::parser parser_;
    std::vector<char> padded_;  // copy with padding: simdjson reads beyond the end
};

/// Path of an element in a JSON document: keys and indices, converted to text only for errors.
struct JsonPath {
    const JsonPath* above = nullptr;
    std::string_view key = {};
    std::size_t index = 0;  ///< index of the element in a list, from 0, if `key` is empty

    std::string text() const;
};

/// Element of a JSON document, with its path for error messages.
struct JsonElement {
    simdjson::dom::element value;
    JsonPath path;

    [[noreturn]] void fail(const char* code, const std::string& message) const {
        throw RequestError(code, path.text(), message);
    }
    /// Throws RequestError "bad_type" for this element. @param what  expected type
    [[noreturn]] void expected(std::string_view what) const;

    /// Number of the element. @throws RequestError "bad_type" for any other type, "out_of_range"
    /// if the number is outside the range
    double number(const Range& range) const;
    std::uint64_t whole_number(std::uint64_t lowest, std::uint64_t highest) const;
    bool truth() const;
    std::string_view text() const;
    /// Duration [s], read from a text such as "100 ms".
    double seconds() const;
    simdjson::dom::object object() const;
    simdjson::dom::array array() const;
};

inline constexpr std::size_t most_items = 100'000;  ///< largest length of a JSON list

/// Calls use(element) for each item of a JSON list.
/// @throws RequestError "bad_type" if `list` is no list, "too_many" above `most_items`
template <class Use>
void for_each_item(const JsonElement& list, Use use) {
    const simdjson::dom::array items = list.array();
    if (items.size() > most_items) {
        list.fail("too_many", fmt::format("found more than {} items", most_items));
    }
    std::size_t index = 0;
    for (const simdjson::dom::element& item : items) {
        use(JsonElement{item, {.above = &list.path, .index = index++}});
    }
}

/// Throws RequestError "unknown_key" for a key of a JSON object, with a suggestion.
[[noreturn]] void fail_unknown_key(const JsonPath& object, std::string_view key,
                                   std::vector<std::string> known);
/// Throws RequestError "missing_key" for a key that a JSON object lacks.
[[noreturn]] void fail_missing_key(const JsonPath& object, std::string_view key,
                                   std::string_view example);
[[noreturn]] void fail_repeated_key(const JsonPath& object, std::string_view key);

/// Values of a JSON object for the allowed `keys`, in their order; none for a missing key.
/// @throws RequestError "bad_type" if the element is no object, "unknown_key", "repeated_key"
template <std::size_t N>
std::array<std::optional<JsonElement>, N> members(const JsonElement& element,
                                                  const std::array<std::string_view, N>& keys) {
    std::array<std::optional<JsonElement>, N> found;
    for (const auto& [key, value] : element.object()) {
        std::size_t i = 0;
        while (i < N && keys[i] != key) ++i;
        if (i == N) fail_unknown_key(element.path, key, {keys.begin(), keys.end()});
        if (found[i]) fail_repeated_key(element.path, key);
        found[i] = {value, {.above = &element.path, .key = keys[i]}};
    }
    return found;
}

/// Returns `member`, the value of the required `key` of the JSON object `in`.
/// @throws RequestError "missing_key" if `member` is empty
inline const JsonElement& needed(const std::optional<JsonElement>& member, const JsonElement& in,
                                 std::string_view key, std::string_view example) {
    if (!member) fail_missing_key(in.path, key, example);
    return *member;
}

}  // namespace rovernet
