// SPDX-License-Identifier: MIT
#include "scenario/document/value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rovernet {

// Members of Table are defined here, where Entry is complete.
Table::Table() = default;
Table::Table(const Table&) = default;
Table::Table(Table&&) noexcept = default;
Table& Table::operator=(const Table&) = default;
Table& Table::operator=(Table&&) noexcept = default;
Table::~Table() = default;

Value::Value() = default;
Value::Value(bool v) : data(v) {}
Value::Value(int v) : data(std::int64_t{v}) {}
Value::Value(std::int64_t v) : data(v) {}
Value::Value(std::uint64_t v) : data(static_cast<std::int64_t>(v)) {}
Value::Value(std::uint32_t v) : data(std::int64_t{v}) {}
Value::Value(double v) : data(v) {}
Value::Value(const std::optional<double>& v) {
    if (v) data = *v;
}
Value::Value(const std::optional<std::uint64_t>& v) {
    if (v) *this = Value(*v);
}
Value::Value(const char* v) : data(std::string(v)) {}
Value::Value(std::string_view v) : data(std::string(v)) {}
Value::Value(std::string v) : data(std::move(v)) {}
Value::Value(Array v) : data(std::move(v)) {}
Value::Value(Table v) : data(std::move(v)) {}

Value placed(Value value, const Location& where) {
    value.where = where;
    return value;
}

const Value* Table::find(std::string_view key) const {
    const auto found = std::find_if(entries.begin(), entries.end(),
                                    [&](const Entry& entry) { return entry.key == key; });
    return found == entries.end() ? nullptr : &found->value;
}

Value* Table::find(std::string_view key) {
    return const_cast<Value*>(std::as_const(*this).find(key));
}

void Table::set(std::string_view key, Value value) {
    const Location where = value.where;
    if (Value* old = find(key)) {
        *old = std::move(value);
    } else {
        entries.push_back({std::string(key), std::move(value), where});
    }
}

std::string Value::description() const {
    struct Describe {
        std::string operator()(std::monostate) const { return "nothing"; }
        std::string operator()(bool v) const { return v ? "true" : "false"; }
        std::string operator()(std::int64_t v) const { return fmt::format("the number {}", v); }
        std::string operator()(double v) const {
            const bool whole = v == std::floor(v) && std::abs(v) < 1e15;
            return fmt::format("the number {}{}", v, whole ? ".0" : "");
        }
        std::string operator()(const std::string& v) const {
            constexpr std::size_t longest = 60;
            if (v.size() <= longest) return fmt::format("\"{}\"", v);
            return fmt::format("\"{}...\"", v.substr(0, longest));
        }
        std::string operator()(const Array&) const { return "a list"; }
        std::string operator()(const Table&) const { return "a table"; }
    };
    return std::visit(Describe{}, data);
}

}  // namespace rovernet
