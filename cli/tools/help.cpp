// SPDX-License-Identifier: MIT
#include "cli/tools/tool_commands.hpp"
#include "sim/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
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

void print_topics(const std::vector<HelpPage>& pages, const fs::path& folder) {
    std::string shelf;
    for (const HelpPage& page : pages) {
        if (page.shelf != shelf) fmt::print("{}{}\n", shelf.empty() ? "" : "\n", page.shelf);
        shelf = page.shelf;
        fmt::print("  {:18} {}\n", page.topic, page.title);
    }
    fmt::print("\nrovernet help TOPIC prints a page. They are in {}.\n", folder.string());
}

/// Lines of a page without its comments, which are for the check of the pages.
void print_page(const fs::path& file) {
    std::ifstream text(file);
    std::string line;
    bool comment = false;
    while (std::getline(text, line)) {
        comment = comment || line.starts_with("<!--");
        if (!comment) fmt::print("{}\n", line);
        if (line.find("-->") != std::string::npos) comment = false;
    }
}

std::string no_topic(const std::string& topic, const std::vector<std::string>& topics) {
    const std::string suggestion = did_you_mean(topic, topics);
    return fmt::format("there is no topic \"{}\"; {}", topic,
                       suggestion.empty() ? "rovernet help lists all topics" : suggestion);
}

}  // namespace

void help(const HelpArguments& a) {
    const fs::path folder = help_folder();
    if (folder.empty())
        throw CommandEnd(failed,
                         "the documentation is not installed; expected share/doc/rovernet "
                         "beside the folder of the command");
    const std::vector<HelpPage> pages = help_pages(folder);
    if (!a.topic) return print_topics(pages, folder);
    std::vector<std::string> topics;
    for (const HelpPage& page : pages) {
        if (page.topic == *a.topic) return print_page(page.file);
        topics.push_back(page.topic);
    }
    throw CommandEnd(usage, no_topic(*a.topic, topics));
}

}  // namespace rovernet::cli
