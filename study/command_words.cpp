// SPDX-License-Identifier: MIT
#include "study/command_words.hpp"

#include "scenario/scenario_file.hpp"

#include <algorithm>
#include <string_view>

namespace rovernet {

std::string shell_word(const std::string& word) {
    const bool plain = !word.empty() && std::all_of(word.begin(), word.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               std::string_view("_-./=:,+").find(c) != std::string_view::npos;
    });
    if (plain) return word;
    std::string text = "'";
    for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
}

std::string shell_command(std::span<const std::string> words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : " ") + shell_word(word);
    return text;
}

std::vector<std::string> option_words(const ScenarioOptions& options) {
    std::vector<std::string> words;
    const auto append = [&](const char* option, const std::vector<std::string>& values) {
        for (const std::string& value : values) words.insert(words.end(), {option, value});
    };
    append("--set", options.set);
    append("--world-path", options.world_path);
    append("--bitmap", options.bitmaps);
    if (options.lenient) words.emplace_back("--lenient");
    return words;
}

}  // namespace rovernet
