// SPDX-License-Identifier: MIT
#include "live/carriers/command_reader.hpp"

#include "files/base64.hpp"

#include <vector>

namespace rovernet {
namespace {

/// Keys of commands in words: "v and w, or stop".
std::string in_words(std::span<const std::string_view> keys, std::span<const KeyPart> parts) {
    std::string text;
    for (const KeyPart& part : parts) {
        const auto own = keys.subspan(part.first, part.size);
        if (part.first > 0) text += ", or ";
        for (std::size_t i = 0; i < own.size(); ++i) {
            if (i > 0) text += i + 1 == own.size() ? " and " : ", ";
            text += own[i];
        }
    }
    return text;
}

}  // namespace

Duration CommandReader::time(const JsonElement& element) const {
    const double s = element.seconds();
    if (!(s > 0)) element.fail("out_of_range", "expected a time above 0 s");
    return std::max(from_seconds(s), Duration{1});
}

std::string CommandReader::bytes(const JsonElement& element) const {
    auto bytes = from_base64(element.text());
    if (!bytes) element.fail("bad_base64", "expected base64 with its padding, such as \"Rg==\"");
    return std::move(*bytes);
}

void CommandReader::read_place(Vec3& place, const JsonElement& element, const Range& range) {
    std::vector<double> at;
    for_each_item(element, [&](const JsonElement& item) { at.push_back(item.number(range)); });
    if (at.size() != 2 && at.size() != 3) {
        element.fail(
            "bad_value",
            fmt::format("found {} numbers; expected [x, y] or [x, y, z] in metres", at.size()));
    }
    place = {at[0], at[1], at.size() == 3 ? at[2] : place.z};
}

std::string CommandReader::bytes_within(const JsonElement& element, const Range& sizes) const {
    std::string found = bytes(element);
    if (sizes.contains(static_cast<double>(found.size()))) return found;
    element.fail("out_of_range",
                 fmt::format("found {} bytes; expected {}", found.size(), sizes.text));
}

std::string CommandReader::example(std::string_view key, bool is_place) {
    return fmt::format("\"{}\":{}", key, is_place ? "[1,12]" : "\"Rg==\"");
}

void CommandReader::check_true(const JsonElement& element, std::string_view key) {
    if (!element.truth()) element.fail("bad_value", fmt::format("expected \"{}\":true", key));
}

std::optional<std::size_t> find_given(const JsonElement& object,
                                      std::span<const std::string_view> keys,
                                      std::span<const CommandReader::Member> members,
                                      std::span<const KeyPart> parts) {
    std::optional<std::size_t> given;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto own = members.subspan(parts[i].first, parts[i].size);
        if (std::none_of(own.begin(), own.end(),
                         [](const auto& each) { return each.has_value(); })) {
            continue;
        }
        if (given) {
            object.fail("bad_value", "expected one command only: " + in_words(keys, parts));
        }
        given = i;
    }
    return given;
}

}  // namespace rovernet
