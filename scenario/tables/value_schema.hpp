// SPDX-License-Identifier: MIT
#pragma once

#include "models/access/access.hpp"
#include "models/access/csma.hpp"
#include "scenario/tables/read_value.hpp"
#include "sim/fields.hpp"

#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

// JSON Schema (draft 4) of keys and tables of a scenario file, made of the descriptions that their
// readers use. Editors complete and check files by it.

namespace rovernet {

/// Schema of values of a JSON type, such as "string".
Table schema_of_type(std::string_view type);
/// Schema of a word that is one of `words`.
Table schema_of_words(const Array& words);
/// Schema of a list. @param most  largest number of items; 0: any number
Table schema_of_list(Table items, int least = 0, int most = 0);
/// Schema of a text with a quantity, see quantity_pattern().
Table schema_of_quantity(Dimension dimension, bool any_sign);
/// Schema that accepts every value that at least one of two schemas accepts.
Table schema_of_either(Table one, Table other);
/// Adds the limits of a range to the schema of a number.
void add_limits(Table& schema, const Range& range);

/// Names as values.
inline Array listed(const std::vector<std::string>& names) {
    return Array(names.begin(), names.end());
}
/// Names of an enumeration in files, as values.
template <class E>
Array words_of() {
    return Array(EnumNames<E>::values.begin(), EnumNames<E>::values.end());
}

/// Schema of the values that read_value() reads into a T. A type that gets an overload of
/// read_value() gets its schema here.
/// @param range  of the number, or of a quantity in its base unit: a quantity that must not be
/// negative has no minus sign
template <class T>
Table value_schema([[maybe_unused]] const Range& range) {
    [[maybe_unused]] const bool any_sign = range.low < 0;
    if constexpr (requires(T v) { v.has_value(); }) {
        return value_schema<typename T::value_type>(range);
    } else if constexpr (std::same_as<T, bool>) {
        return schema_of_type("boolean");
    } else if constexpr (std::same_as<T, std::string>) {
        return schema_of_type("string");
    } else if constexpr (std::is_arithmetic_v<T>) {
        Table schema = schema_of_type(std::floating_point<T> ? "number" : "integer");
        add_limits(schema, std::unsigned_integral<T> && any_sign ? non_negative : range);
        return schema;
    } else if constexpr (std::same_as<T, EifsRule>) {
        return schema_of_either(schema_of_words(words_of<T>()), schema_of_type("boolean"));
    } else if constexpr (std::is_enum_v<T>) {
        return schema_of_words(words_of<T>());
    } else if constexpr (std::same_as<T, Duration>) {
        return schema_of_quantity(Dimension::time, any_sign);
    } else if constexpr (std::same_as<T, Bytes>) {
        return schema_of_quantity(Dimension::size, false);
    } else if constexpr (std::same_as<T, Vec3>) {
        return schema_of_list(schema_of_quantity(Dimension::length, true), 2, 3);
    } else if constexpr (std::same_as<T, PatternPoint>) {
        return schema_of_list(schema_of_either(schema_of_type("number"), schema_of_type("string")),
                              2, 2);
    } else if constexpr (IsQuantity<T>) {
        return schema_of_quantity(dimension_of(T{}), any_sign);
    } else {
        return schema_of_list(value_schema<typename T::value_type>(any));
    }
}

/// Adds the schema of a key to the properties of a table. If the table already has the key, from
/// another model, the two schemas are joined: the key then accepts every value that one of them
/// accepts.
/// @param owner  model that has the key, for the description; empty: the table
void add_key(Table& properties, std::string_view key, Table schema, std::string_view meaning,
             std::string_view owner = {});

/// Adds the keys of a struct with fields() to the properties of a table: all keys, or only the keys
/// for which is_wanted returns true.
template <Described T, class Wanted>
void add_keys_if(Table& properties, std::string_view owner, Wanted&& is_wanted) {
    for_each_field<T>([&]<class S, class V>(const Field<S, V>& f) {
        if (is_wanted(f.name))
            add_key(properties, f.name, value_schema<V>(f.range), f.meaning, owner);
    });
}
template <Described T>
void add_keys(Table& properties, std::string_view owner = {}) {
    add_keys_if<T>(properties, owner, [](std::string_view) { return true; });
}

/// Schema of a table with these keys and no others.
Table schema_of_table(Table properties, const Array& required = {});

/// Schema of the table of a struct with fields().
template <Described T>
Table table_schema(const Array& required = {}) {
    Table properties;
    add_keys<T>(properties);
    return schema_of_table(std::move(properties), required);
}

}  // namespace rovernet
