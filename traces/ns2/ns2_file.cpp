// SPDX-License-Identifier: MIT
#include "traces/ns2/ns2_file.hpp"

#include "files/word.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <variant>

namespace rovernet {
namespace {

constexpr std::size_t most_shown = 10;

std::string said_of(const Ns2Refused& refused) {
    constexpr std::size_t longest = 40;
    const std::string found = refused.found.empty()
                                  ? "found the end of the line"
                                  : "found \"" + printable(refused.found, longest) + '"';
    const bool is_key = refused.expected.starts_with('-') && refused.expected.size() < 8;
    const std::string_view quote = is_key ? "\"" : "";
    return fmt::format("{}, expected {}{}{}", found, quote, refused.expected, quote);
}

}  // namespace

std::string Ns2Counts::format() const {
    constexpr std::string_view names[] = {"old", "new", "tagged"};
    std::string all;
    const auto add = [&](std::string_view name) {
        if (!all.empty()) all += '+';
        all += name;
    };
    for (std::size_t i = 0; i < dialects.size(); ++i) {
        if (dialects[i]) add(names[i]);
    }
    if (skipped_of(Ns2Other::wired) > 0) add("wired");
    if (skipped_of(Ns2Other::nam) > 0) add("nam");
    return all.empty() ? "none" : all;
}

Ns2File::Ns2File(Ns2Source source, Ns2Strictness strictness)
    : source_(std::move(source)), strictness_(strictness) {}

bool Ns2File::next_text() {
    source_.take(taken_);
    if (is_long_) skip_long_line();
    std::size_t scanned = 0;
    std::size_t found = 0;
    std::string_view text = source_.window();
    while ((found = text.find('\n', scanned)) == std::string_view::npos &&
           text.size() <= longest_line) {
        scanned = text.size();
        const bool is_longer = source_.more();
        text = source_.window();  // more() moves it, also at the end
        if (!is_longer) break;
    }
    taken_ = text.size();
    if (text.empty()) return false;
    ++counts_.lines;
    if (found != std::string_view::npos) {
        text = text.substr(0, found);
        taken_ = text.size() + 1;
    }
    is_long_ = found == std::string_view::npos && text.size() > longest_line;
    if (text.ends_with('\r')) text.remove_suffix(1);
    text_ = text;
    return true;
}

void Ns2File::skip_long_line() {
    is_long_ = false;
    do {
        const std::string_view text = source_.window();
        const std::size_t found = text.find('\n');
        if (found == std::string_view::npos) {
            source_.take(text.size());
            continue;
        }
        source_.take(found + 1);
        return;
    } while (source_.more());
}

const Ns2Line* Ns2File::next() {
    while (next_text()) {
        if (text_.size() > longest_line) {
            count_refused(1, "found a line of more than 64 KiB, expected a line of an ns-2 trace");
            continue;
        }
        line_ = parse_ns2_line(text_);
        if (const auto* other = std::get_if<Ns2Other>(&line_)) {
            ++counts_.skipped[static_cast<std::size_t>(*other)];
        } else if (const auto* refused = std::get_if<Ns2Refused>(&line_)) {
            count_refused(refused->column, said_of(*refused));
        } else {
            if (const auto* packet = std::get_if<Ns2Packet>(&line_)) {
                counts_.dialects[static_cast<std::size_t>(packet->dialect)] = true;
            }
            ++counts_.events;
            return &line_;
        }
    }
    return nullptr;
}

Location Ns2File::place(std::uint64_t line, int column) const {
    constexpr auto most = static_cast<std::uint64_t>(std::numeric_limits<int>::max());
    return {
        .source = source_.name(), .line = static_cast<int>(std::min(line, most)), .column = column};
}

void Ns2File::count_refused(int column, const std::string& why) {
    ++counts_.refused;
    if (strictness_ == Ns2Strictness::strict) throw InputError(place(counts_.lines, column), why);
    if (counts_.refused_lines.size() >= most_shown) return;
    constexpr std::size_t longest = 80;
    counts_.refused_lines.push_back({counts_.lines, column, why, printable(text_, longest)});
}

void Ns2File::refuse(int column, const std::string& why) {
    --counts_.events;
    count_refused(column, why);
}

void Ns2File::expect_trace() const {
    const Ns2Counts& c = counts_;
    const std::uint64_t empty = c.skipped_of(Ns2Other::blank) + c.skipped_of(Ns2Other::comment);
    // Some lines of any text look like one that ns-2 prints.
    const std::uint64_t skipped = c.lines - empty - c.refused;
    if (c.refused == 0 || c.events > 0 || skipped > c.refused) return;
    const Ns2RefusedLine& first = c.refused_lines.front();
    throw InputError(place(first.line, first.column),
                     first.why + "; no line of this file is a line of an ns-2 trace");
}

}  // namespace rovernet
