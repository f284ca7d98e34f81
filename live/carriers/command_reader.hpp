// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/command_keys.hpp"
#include "experiment/robot_command.hpp"
#include "live/carriers/json_object.hpp"
#include "network/network.hpp"

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>

// Reader of robot commands from JSON. The function fields() of a command lists its keys.

namespace rovernet {

/// Reader of the fields of robot commands from JSON. All functions throw RequestError for an
/// invalid value.
class CommandReader {
  public:
    using Member = std::optional<JsonElement>;

    virtual ~CommandReader() = default;

    /// Reads the fields of a robot command into `command`. The height of a place and the heading
    /// keep their previous values if the JSON object does not give them.
    /// @param in       JSON object of the command, for error messages
    /// @param keys     keys of the command's first fields, for error messages; other fields are
    ///                 not read
    /// @param members  JSON value of each key; none if the object lacks the key
    template <class Command>
    void read(Command& command, const JsonElement& in, std::span<const std::string_view> keys,
              std::span<const Member> members) const {
        std::size_t i = 0;
        for_each_field<Command>([&](const auto& f) {
            if (i == keys.size()) return;
            using Held = std::remove_cvref_t<decltype(command.*f.member)>;
            if (members[i]) {
                read_value(command.*f.member, *members[i], f.range);
            } else if constexpr (std::same_as<Held, Vec3> || std::same_as<Held, std::string>) {
                fail_missing_key(in.path, keys[i], example(keys[i], std::same_as<Held, Vec3>));
            }
            ++i;
        });
        if (i == 0 && members[0]) check_true(*members[0], keys[0]);
    }

  protected:
    /// Robot with the given name.
    virtual NodeId robot(const JsonElement& name) const = 0;
    /// Duration > 0, read from a text such as "100 ms".
    virtual Duration time(const JsonElement& element) const;
    virtual bool truth(const JsonElement& element) const { return element.truth(); }
    /// Bytes, decoded from a text in base64.
    virtual std::string bytes(const JsonElement& element) const;

  private:
    template <class Value>
    void read_value(Value& value, const JsonElement& element, const Range& range) const {
        if constexpr (std::same_as<Value, std::optional<NodeId>>) {
            value = element.text() == "*" ? std::nullopt : std::optional(robot(element));
        } else if constexpr (requires { value.has_value(); }) {
            read_value(value.emplace(), element, range);
        } else if constexpr (std::same_as<Value, Duration>) {
            value = time(element);
        } else if constexpr (std::same_as<Value, Vec3>) {
            read_place(value, element, range);
        } else if constexpr (std::same_as<Value, std::string>) {
            value = bytes_within(element, range);
        } else if constexpr (std::same_as<Value, bool>) {
            value = truth(element);
        } else if constexpr (std::unsigned_integral<Value>) {
            constexpr double largest = std::numeric_limits<Value>::max();
            const double high = std::min(range.high, largest);
            value = static_cast<Value>(element.whole_number(0, static_cast<std::uint64_t>(high)));
        } else {
            value = Value{element.number(range)};
        }
    }
    static void read_place(Vec3& place, const JsonElement& element, const Range& range);
    std::string bytes_within(const JsonElement& element, const Range& sizes) const;
    static std::string example(std::string_view key, bool is_place);
    static void check_true(const JsonElement& element, std::string_view key);
};

/// Range of indices in a list of keys: the keys of one robot command.
struct KeyPart {
    std::size_t first, size;
};
/// Index in `parts` of the robot command whose keys a JSON object has; none if the object has no
/// key of any command.
/// @param parts  for each robot command, the range of its keys in `keys`
/// @throws RequestError if the object has keys of several commands
std::optional<std::size_t> find_given(const JsonElement& object,
                                      std::span<const std::string_view> keys,
                                      std::span<const CommandReader::Member> members,
                                      std::span<const KeyPart> parts);

/// Reads a robot command from a JSON object, whose keys determine the type of the command; none for
/// the empty object {}.
/// @param commands  list of the possible types
template <class... Commands>
std::optional<RobotCommand> read_one_of(std::tuple<std::type_identity<Commands>...> /*commands*/,
                                        const CommandReader& reader, const JsonElement& object,
                                        const Network& network, NodeId robot) {
    static constexpr auto keys = keys_of<Commands...>();
    static constexpr auto parts = [] {
        std::array all{KeyPart{0, number_of_keys<Commands>()}...};
        for (std::size_t i = 1; i < all.size(); ++i)
            all[i].first = all[i - 1].first + all[i - 1].size;
        return all;
    }();
    const auto found = members(object, keys);
    const auto given = find_given(object, keys, found, parts);
    if (!given) return std::nullopt;
    const auto given_part = parts[*given];
    std::optional<RobotCommand> result;
    std::size_t i = 0;
    const auto read = [&]<class Command>(std::type_identity<Command>) {
        if (i++ != *given) return;
        auto command = command_at<Command>(network, robot);
        reader.read(command, object, std::span(keys).subspan(given_part.first, given_part.size),
                    std::span(found).subspan(given_part.first, given_part.size));
        result = std::move(command);
    };
    (read(std::type_identity<Commands>{}), ...);
    return result;
}

}  // namespace rovernet
