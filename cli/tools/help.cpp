// SPDX-License-Identifier: MIT
#include "cli/tools/tool_commands.hpp"
#include "sim/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <compare>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rovernet::cli {
namespace {

namespace fs = std::filesystem;

/// Page of the documentation: its file docs/SHELF/TOPIC.md, and its first heading.
struct HelpPage {
    std::string shelf, topic, title;
    fs::path file;
};

/// Folder with the documentation: of an installed command share/doc/rovernet beside its folder,
/// otherwise docs/ of the tree in which it was built. Empty: there is none.
fs::path help_folder() {
    std::error_code ignored;
    const fs::path command = fs::read_symlink("/proc/self/exe", ignored);
    const fs::path installed = command.parent_path().parent_path() / "share/doc/rovernet";
    if (fs::exists(installed / "guide/README.md")) return installed;
    for (fs::path folder = command.parent_path(); folder != folder.root_path();
         folder = folder.parent_path()) {
        if (fs::exists(folder / "docs/guide/README.md")) return folder / "docs";
    }
    return {};
}

std::string first_heading(const fs::path& file) {
    std::ifstream text(file);
    std::string line;
    while (std::getline(text, line))
        if (line.starts_with("# ")) return line.substr(2);
    return "";
}

/// Pages of all shelves, in the order of the alphabet.
std::vector<HelpPage> help_pages(const fs::path& folder) {
    std::vector<HelpPage> pages;
    for (const char* shelf : {"guide", "methods", "formats", "inside"}) {
        std::vector<HelpPage> of_shelf;
        std::error_code ignored;
        for (const auto& entry : fs::directory_iterator(folder / shelf, ignored)) {
            const fs::path& file = entry.path();
            if (file.extension() != ".md" || file.stem() == "README") continue;
            of_shelf.push_back({shelf, file.stem().string(), first_heading(file), file});
        }
        std::sort(of_shelf.begin(), of_shelf.end(),
                  [](const HelpPage& a, const HelpPage& b) { return a.topic < b.topic; });
        std::move(of_shelf.begin(), of_shelf.end(), std::back_inserter(pages));
    }
    return pages;
}

void print_line(const HelpPage& page) { fmt::print("  {:18} {}\n", page.topic, page.title); }

void print_topics(const std::vector<HelpPage>& pages, const fs::path& folder) {
    std::string shelf;
    for (const HelpPage& page : pages) {
        if (page.shelf != shelf) fmt::print("{}{}\n", shelf.empty() ? "" : "\n", page.shelf);
        shelf = page.shelf;
        print_line(page);
    }
    fmt::print("\nrovernet help TOPIC prints a page. All pages are in {}.\n", folder.string());
}

/// Text of a page without its comments, which are for the check of the pages.
std::string text_of(const HelpPage& page) {
    std::ifstream file(page.file);
    std::string line, text;
    bool comment = false;
    while (std::getline(file, line)) {
        comment = comment || line.starts_with("<!--");
        if (!comment) text += line + "\n";
        if (line.find("-->") != std::string::npos) comment = false;
    }
    return text;
}

std::string in_small_letters(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

/// Word without an ending that a page may lack: "flooding" also finds "flood".
std::string stem_of(std::string word) {
    constexpr std::size_t shortest = 4;  // letters of a stem
    for (const std::string_view end : {"ing", "s"}) {
        if (!word.ends_with(end) || word.size() < end.size() + shortest) continue;
        word.erase(word.size() - end.size());
        break;
    }
    return word;
}

/// How often a word of the text begins with `word`; both are in small letters.
std::size_t count_of(const std::string& word, const std::string& text) {
    std::size_t count = 0;
    for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + 1))
        if (at == 0 || !std::isalnum(static_cast<unsigned char>(text[at - 1]))) ++count;
    return count;
}

/// Pages that have words of the list, the best first: a page with more of the words, where a word
/// in its name or title counts twice; among equal pages the one that repeats the words more often.
std::vector<HelpPage> pages_with(const std::vector<std::string>& words,
                                 const std::vector<HelpPage>& pages) {
    struct Rank {
        std::size_t words = 0, places = 0;
        auto operator<=>(const Rank&) const = default;
    };
    std::vector<std::pair<Rank, HelpPage>> ranked;
    for (const HelpPage& page : pages) {
        const std::string head = in_small_letters(page.topic + " " + page.title),
                          text = in_small_letters(text_of(page));
        Rank rank;
        for (const std::string& each : words) {
            const std::string word = stem_of(in_small_letters(each));
            const std::size_t here = count_of(word, text);
            rank.words += (here > 0 ? 1u : 0u) + (count_of(word, head) > 0 ? 1u : 0u);
            rank.places += here;
        }
        if (rank.words > 0) ranked.emplace_back(rank, page);
    }
    std::stable_sort(ranked.begin(), ranked.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<HelpPage> best;
    for (auto& [rank, page] : ranked) best.push_back(std::move(page));
    return best;
}

std::string no_page(const std::vector<std::string>& words, const std::vector<HelpPage>& pages) {
    const std::string topic = fmt::format("{}", fmt::join(words, " "));
    std::vector<std::string> topics;
    for (const HelpPage& page : pages) topics.push_back(page.topic);
    const std::string suggestion = did_you_mean(topic, topics);
    return fmt::format("there is no topic \"{}\", and no page contains {}; {}", topic,
                       words.size() > 1 ? "one of these words" : "this word",
                       suggestion.empty() ? "rovernet help lists all topics" : suggestion);
}

/// Prints the command that is called so, if there is one, and the best pages with the words.
/// @throws CommandEnd if there is neither
void print_search(const std::vector<std::string>& words, const std::vector<Command::Text>& commands,
                  const std::vector<HelpPage>& pages) {
    const std::string topic = fmt::format("{}", fmt::join(words, " "));
    const bool is_command = std::any_of(commands.begin(), commands.end(),
                                        [&](const auto& command) { return command.name == topic; });
    const std::vector<HelpPage> found = pages_with(words, pages);
    if (!is_command && found.empty()) throw CommandEnd(usage, no_page(words, pages));
    if (is_command) fmt::print("rovernet {} --help explains this command.\n\n", topic);
    if (found.empty()) return;
    constexpr std::size_t most = 6;
    fmt::print("Pages with \"{}\", the best first:\n", topic);
    for (std::size_t i = 0; i < std::min(most, found.size()); ++i) print_line(found[i]);
    fmt::print("\nrovernet help {} prints the first one.\n", found.front().topic);
}

}  // namespace

void help(const HelpArguments& a) {
    const fs::path folder = help_folder();
    if (folder.empty())
        throw CommandEnd(
            failed,
            "the documentation is not installed; expected the folder share/doc/rovernet "
            "beside the folder that contains the program rovernet");
    const std::vector<HelpPage> pages = help_pages(folder);
    std::istringstream said(fmt::format("{}", fmt::join(a.words, " ")));
    const std::vector<std::string> words(std::istream_iterator<std::string>(said), {});
    if (words.empty()) return print_topics(pages, folder);
    const std::string topic = fmt::format("{}", fmt::join(words, "-"));
    for (const HelpPage& page : pages)
        if (page.topic == topic) return fmt::print("{}", text_of(page));
    print_search(words, a.program->text().commands, pages);
}

}  // namespace rovernet::cli
