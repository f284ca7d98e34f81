// SPDX-License-Identifier: MIT
#include "scenario/document/toml.hpp"

#include "files/input_file.hpp"
#include "scenario/document/toml_mistake.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <charconv>
#include <iostream>
#include <vector>

namespace rovernet {
namespace {

constexpr std::size_t largest_file = 64U << 20;

Location location(const std::string& source, const toml::source_region& region) {
    return {source, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

Value convert(const toml::node& node, const std::string& source);

Table convert(const toml::table& table, const std::string& source) {
    Table out;
    for (const auto& [key, node] : table) {
        out.entries.push_back(
            {std::string(key.str()), convert(node, source), location(source, key.source())});
    }
    // toml++ keeps keys sorted by name; errors and printing follow the file's own order.
    std::stable_sort(out.entries.begin(), out.entries.end(), [](const Entry& a, const Entry& b) {
        return std::pair(a.key_where.line, a.key_where.column) <
               std::pair(b.key_where.line, b.key_where.column);
    });
    return out;
}

Value convert(const toml::node& node, const std::string& source) {
    Value out;
    if (const auto* table = node.as_table()) {
        out = convert(*table, source);
    } else if (const auto* array = node.as_array()) {
        Array list;
        for (const auto& item : *array) list.push_back(convert(item, source));
        out = std::move(list);
    } else if (const auto* text = node.as_string()) {
        out = text->get();
    } else if (const auto* integer = node.as_integer()) {
        out = integer->get();
    } else if (const auto* number = node.as_floating_point()) {
        out = number->get();
    } else if (const auto* truth = node.as_boolean()) {
        out = truth->get();
    } else {
        throw InputError(location(source, node.source()),
                         "found a date or a time of day, but no key has such a value; expected a "
                         "number, true, false, a list, or a text in quotes, such as \"10 s\"");
    }
    out.where = location(source, node.source());
    return out;
}

bool is_bare_key(std::string_view key) {
    return !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '_' || c == '-';
    });
}

std::string quoted_text(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            out += '\\';
            out += c;
        } else if (byte < 0x20 || byte == 0x7f) {
            out += fmt::format("\\u{:04x}", byte);
        } else {
            out += c;
        }
    }
    return out + '"';
}

std::string key_text(std::string_view key) {
    return is_bare_key(key) ? std::string(key) : quoted_text(key);
}

std::string inline_text(const Value& value);

struct InlineText {
    std::string operator()(std::monostate) const { return "\"\""; }
    std::string operator()(bool v) const { return v ? "true" : "false"; }
    std::string operator()(std::int64_t v) const { return fmt::format("{}", v); }
    std::string operator()(double v) const {
        std::string text = fmt::format("{}", v);
        if (text.find_first_of(".en") == std::string::npos) text += ".0";
        return text;
    }
    std::string operator()(const std::string& v) const { return quoted_text(v); }
    std::string operator()(const Array& v) const {
        std::string text = "[";
        for (const auto& item : v) {
            if (text.size() > 1) text += ", ";
            text += inline_text(item);
        }
        return text + "]";
    }
    std::string operator()(const Table& v) const {
        std::string text = "{";
        for (const auto& entry : v.entries) {
            text += text.size() > 1 ? ", " : " ";
            text += key_text(entry.key) + " = " + inline_text(entry.value);
        }
        return text + " }";
    }
};

std::string inline_text(const Value& value) { return std::visit(InlineText{}, value.data); }

void append_entries(std::string& text, const Table& table) {
    for (const auto& entry : table.entries) {
        text += fmt::format("{} = {}\n", key_text(entry.key), inline_text(entry.value));
    }
}

bool is_list_of_tables(const Value& value) {
    const Array* list = value.array();
    return list && !list->empty() &&
           std::all_of(list->begin(), list->end(), [](const Value& v) { return v.table(); });
}

/// Reports that no item of a list has the name `step` of a path.
[[noreturn]] void fail_unnamed(const std::string& step, const std::vector<std::string>& names,
                               const Location& option) {
    std::string near = did_you_mean(step, names);
    const auto dotted = std::find_if(names.begin(), names.end(), [&](const std::string& name) {
        return name.starts_with(step + ".");
    });
    if (dotted != names.end())
        near = fmt::format("a name that contains dots needs quotes: \"{}\"", *dotted);
    throw InputError(option, fmt::format("no item of the list is named \"{}\"{}{}", step,
                                         near.empty() ? "" : "; ", near));
}

/// Name of an item of a list: its key "name"; null if it has none.
const std::string* name_of(const Value& item) {
    const Value* name = item.table() ? item.table()->find("name") : nullptr;
    return name ? name->string() : nullptr;
}

/// Item of a list by its number, or by its name.
/// @param is_name  whether the step is in quotes, and so never a number
Value& item_at(Array& list, const std::string& step, bool is_name, const Location& option) {
    const auto named = std::find_if(list.begin(), list.end(), [&](const Value& item) {
        const std::string* name = name_of(item);
        return name && *name == step;
    });
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(step.data(), step.data() + step.size(), index);
    const bool is_number = !is_name && error == std::errc{} && end == step.data() + step.size();
    if (is_number && index < list.size()) {
        Value& item = list[index];
        if (named == list.end() || &*named == &item) return item;
        throw InputError(
            option,
            fmt::format("{0} is the number of one item of the list, and also the name of a "
                        "different item; for the item with this name, write \"{0}\" in quotes; for "
                        "the item with this number, write the name of that item",
                        step));
    }
    if (named != list.end()) return *named;
    if (is_number) {
        throw InputError(
            option,
            fmt::format("there is no item {}; the list has {} items, and the first is item 0",
                        index, list.size()));
    }
    std::vector<std::string> names;
    for (const Value& item : list) {
        if (const std::string* name = name_of(item)) names.push_back(*name);
    }
    if (names.empty()) {
        throw InputError(option, fmt::format("\"{}\" is a key of the items of a list; write the "
                                             "number of an item before this key, from 0 to {}",
                                             step, list.size() - 1));
    }
    fail_unnamed(step, names, option);
}

/// Value at `step` of a path (a key, or in a list an index or name), created if missing.
/// @param is_name  whether the step is in quotes
Value& descend(Value& at, const std::string& step, bool is_name, const Location& option) {
    if (Array* list = at.array()) return item_at(*list, step, is_name, option);
    Table* table = at.table();
    if (!table) {
        throw InputError(option, fmt::format("found the key \"{}\" inside {}, which has no keys; "
                                             "check the dots in the name of the key",
                                             step, at.description()));
    }
    if (!table->find(step)) {
        Value made{Table{}};
        made.where = option;
        table->entries.push_back({step, std::move(made), option});
    }
    return *table->find(step);
}

[[noreturn]] void fail_long(const std::string& source) {
    throw InputError({source}, "this file is larger than 64 MiB; expected a scenario file");
}

/// Text of the whole stream. @throws InputError if it is longer than 64 MiB
std::string bounded_text(std::istream& in, const std::string& source) {
    std::string text;
    std::vector<char> portion(64 * 1024);
    while (in.read(portion.data(), static_cast<std::streamsize>(portion.size())) ||
           in.gcount() > 0) {
        text.append(portion.data(), static_cast<std::size_t>(in.gcount()));
        if (text.size() > largest_file) fail_long(source);
    }
    return text;
}

}  // namespace

Value parse_toml(std::string_view text, const std::string& source) {
    try {
        Value document = convert(static_cast<const toml::node&>(toml::parse(text)), source);
        document.where = {source};
        return document;
    } catch (const toml::parse_error& error) {
        Location where = location(source, error.source());
        const TomlMistake mistake =
            toml_mistake(text, where.line, where.column, error.description());
        where.line = mistake.line;
        where.column = mistake.column;
        throw InputError(where, mistake.message);
    }
}

Value read_toml(const std::string& path) {
    if (path == standard_input) {
        static const std::string text = bounded_text(std::cin, "standard input");
        return parse_toml(text, "standard input");
    }
    const InputKind kind = input_kind(path);
    if (kind == InputKind::nothing) throw InputError({path}, "no such file; check the path");
    if (kind == InputKind::folder) {
        throw InputError({path},
                         "this is a directory; expected the path of a scenario file (.toml)");
    }
    const std::string text = InputFile(path).read(largest_file + 1);
    if (text.size() > largest_file) fail_long(path);
    return parse_toml(text, path);
}

std::string to_toml(const Value& value) { return inline_text(value); }

std::string plain_text(const Value& value) {
    return value.string() ? *value.string() : to_toml(value);
}

std::string to_toml(const Table& document) {
    std::string text;
    for (const auto& entry : document.entries) {
        if (const Table* table = entry.value.table()) {
            text += fmt::format("{}[{}]\n", text.empty() ? "" : "\n", key_text(entry.key));
            append_entries(text, *table);
        } else if (is_list_of_tables(entry.value)) {
            for (const auto& item : *entry.value.array()) {
                text += fmt::format("{}[[{}]]\n", text.empty() ? "" : "\n", key_text(entry.key));
                append_entries(text, *item.table());
            }
        } else {
            text += fmt::format("{} = {}\n", key_text(entry.key), inline_text(entry.value));
        }
    }
    return text;
}

std::string_view take_key(std::string_view& path) {
    const bool is_quoted = path.starts_with('"');
    if (is_quoted) path.remove_prefix(1);
    const std::size_t end = std::min(path.find(is_quoted ? '"' : '.'), path.size());
    const std::string_view key = path.substr(0, end);
    path.remove_prefix(end);
    if (is_quoted) {
        if (path.empty()) return {};
        path.remove_prefix(1);
        if (!path.empty() && path.front() != '.') return {};
    }
    if (!path.empty()) path.remove_prefix(1);
    return key;
}

std::size_t find_equals(std::string_view assignment) {
    bool is_quoted = false;
    for (std::size_t i = 0; i < assignment.size(); ++i) {
        if (assignment[i] == '"') is_quoted = !is_quoted;
        if (assignment[i] == '=' && !is_quoted) return i;
    }
    return assignment.npos;
}

void set_value(Value& document, const std::string& path, Value value, const Location& where) {
    std::string_view steps = path;
    Value* at = &document;
    while (!steps.empty()) {
        Value* whole = at->table() ? at->table()->find(steps) : nullptr;
        if (whole) {
            at = whole;
            break;
        }
        const bool is_name = steps.starts_with('"');
        const std::string step(take_key(steps));
        if (step.empty()) {
            throw InputError(where,
                             "expected keys joined by single dots, such as radio.power; a key "
                             "that contains dots needs quotes");
        }
        at = &descend(*at, step, is_name, where);
    }
    *at = std::move(value);
}

std::string_view first_key(std::string_view assignment) {
    std::string_view path = assignment.substr(0, find_equals(assignment));
    return take_key(path);
}

void set_option(Value& document, const std::string& assignment, const std::string& typed) {
    const Location option{typed, 0, 0, true};
    const auto equals = find_equals(assignment);
    if (equals == std::string::npos || equals == 0) {
        throw InputError(option, "expected key=value, such as radio.power=\"15 dBm\"");
    }
    if (assignment[equals - 1] == '.') {
        throw InputError(option, "expected keys joined by single dots, such as radio.power");
    }
    const std::string text = assignment.substr(equals + 1);
    Value value{text};
    if (!text.empty() && text.find('\n') == std::string::npos) {
        try {
            value = *parse_toml("v = " + text, "").table()->find("v");
        } catch (const InputError&) {
            // The text is no TOML: it is a string whose quotes the shell has removed.
        }
    }
    const auto relocate = [&](const auto& self, Value& v) -> void {
        v.where = option;
        if (Array* list = v.array()) {
            for (auto& item : *list) self(self, item);
        } else if (Table* table = v.table()) {
            for (auto& entry : table->entries) {
                entry.key_where = option;
                self(self, entry.value);
            }
        }
    };
    relocate(relocate, value);
    set_value(document, assignment.substr(0, equals), std::move(value), option);
}

}  // namespace rovernet
