// SPDX-License-Identifier: MIT
#include "sim/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace rovernet {
namespace {

/// Edit distance of two words: number of letters to insert, remove or replace, and of neighbouring
/// letters to swap.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        before_last.swap(last);
        last.swap(row);
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
            const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
        }
    }
    return row[b.size()];
}

bool same_but_for_case(std::string_view a, std::string_view b) {
    const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; };
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [&](char x, char y) { return lower(x) == lower(y); });
}

std::string at(const Location& where, const std::string& message) {
    const std::string place = where.text();
    return place.empty() ? message : place + ": " + message;
}

}  // namespace

std::string Location::text() const {
    return line > 0 ? fmt::format("{}:{}:{}", source, line, column) : source;
}

InputError::InputError(Location where, const std::string& message)
    : std::runtime_error(at(where, message)), where_(std::move(where)), message_(message) {}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates) {
    constexpr std::size_t longest_word = 64;  // a longer word is no typing error
    if (word.empty() || word.size() > longest_word) return "";
    const std::string* best = nullptr;
    std::size_t best_distance = std::max<std::size_t>(word.size() / 2, 1) + 1;
    for (const auto& candidate : candidates) {
        const bool contained =
            word.size() >= 3 && candidate.find(word) != std::string::npos && candidate != word;
        const std::size_t d = same_but_for_case(word, candidate) ? 0
                              : contained                        ? 1
                                                                 : edit_distance(word, candidate);
        if (d < best_distance && d < word.size()) {  // at least one letter must be equal
            best = &candidate;
            best_distance = d;
        }
    }
    return best ? fmt::format("did you mean \"{}\"?", *best) : "";
}

}  // namespace rovernet
