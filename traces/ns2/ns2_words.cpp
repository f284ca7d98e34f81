// SPDX-License-Identifier: MIT
#include "traces/ns2/ns2_words.hpp"

#include <algorithm>

namespace rovernet {

bool Ns2Words::time(std::string_view word, Time& value) {
    constexpr std::string_view expected = "a time in seconds from 0 to 9.2e9";
    constexpr std::int64_t longest_s = 9'200'000'000, ns_per_s = 1'000'000'000;
    constexpr std::size_t decimals = 9;
    const std::size_t dot = std::min(word.find('.'), word.size());
    std::string_view fraction = word.substr(std::min(dot + 1, word.size()));
    // %g writes short times as 1e-05.
    if (word.find_first_of("eE") != word.npos) {
        double s = 0;
        if (!number(word, s, expected)) return false;
        if (!(s >= 0 && s < static_cast<double>(longest_s))) return fail(word, expected);
        value = start_of_run + from_seconds(s);
        return true;
    }
    std::uint64_t whole = 0;
    const std::string_view before = word.substr(0, dot);
    if (before.empty() || before[0] == '-' || !integer(before, whole, expected) ||
        whole > static_cast<std::uint64_t>(longest_s)) {
        return fail(word, expected);
    }
    std::int64_t ns = 0;
    for (std::size_t i = 0; i < decimals; ++i) {
        const char digit = i < fraction.size() ? fraction[i] : '0';
        if (digit < '0' || digit > '9') return fail(word, expected);
        ns = 10 * ns + (digit - '0');
    }
    fraction.remove_prefix(std::min(decimals, fraction.size()));
    if (fraction.find_first_not_of("0123456789") != fraction.npos) return fail(word, expected);
    if (!fraction.empty() && fraction[0] >= '5') ++ns;
    value = Time{Duration{static_cast<std::int64_t>(whole) * ns_per_s + ns}};
    return true;
}

}  // namespace rovernet
