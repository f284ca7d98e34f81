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

// Reading of JSON that a program outside has written, by simdjson: every fault is a RequestError
// with its place. Only the readers of lines include it.

namespace rovernet {

/// Parser of JSON documents, which keeps its memory.
class JsonParser {
  public:
    /// Document that a text is. Good until the next one.
    /// @throws RequestError "bad_json", "bad_utf8"; "too_deep" beyond 32 levels of brackets
    simdjson::dom::element parse(std::string_view text);

  private:
    simdjson::dom::parser parser_;
    std::vector<char> padded_;  // simdjson reads beyond the end
};

/// Place in a JSON document: a chain of keys and indices, of which a text is made for errors only.
struct JsonPath {
    const JsonPath* above = nullptr;
    std::string_view key = {};
    std::size_t index = 0;  ///< in a list, if there is no key

    std::string text() const;
};

/// Element of a document and where it stands.
struct JsonElement {
    simdjson::dom::element value;
    JsonPath path;

    [[noreturn]] void fail(const char* code, const std::string& message) const {
        throw RequestError(code, path.text(), message);
    }
    /// Tells that another type was expected.
    [[noreturn]] void expected(std::string_view what) const;

    /// @throws RequestError "bad_type" for any other type, "out_of_range"
    double number(const Range& range) const;
    std::uint64_t whole_number(std::uint64_t lowest, std::uint64_t highest) const;
    bool truth() const;
    std::string_view text() const;
    simdjson::dom::object object() const;
    simdjson::dom::array array() const;
};

/// Fault of a key that nobody knows, with what was meant.
[[noreturn]] void fail_unknown_key(const JsonPath& object, std::string_view key,
                                   std::vector<std::string> known);
/// Element as a reader finds it in an object, by key.
[[noreturn]] void fail_missing_key(const JsonPath& object, std::string_view key,
                                   std::string_view example);
[[noreturn]] void fail_repeated_key(const JsonPath& object, std::string_view key);

/// Values of an object under the keys that it may have, in their order.
/// @throws RequestError "bad_type" if it is none, "unknown_key", "repeated_key"
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

/// Element that has to be there. @throws RequestError "missing_key"
inline const JsonElement& needed(const std::optional<JsonElement>& member, const JsonElement& in,
                                 std::string_view key, std::string_view example) {
    if (!member) fail_missing_key(in.path, key, example);
    return *member;
}

}  // namespace rovernet
