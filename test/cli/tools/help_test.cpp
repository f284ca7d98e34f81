// SPDX-License-Identifier: MIT
#include "test/cli/process.hpp"

#include <algorithm>
#include <string>

namespace help_test {
using rovernet::test::command;
using rovernet::test::Ended;
using rovernet::test::TemporaryFolder;

namespace {

bool has(const std::string& text, const std::string& words) {
    return text.find(words) != std::string::npos;
}

}  // namespace

TEST_CASE("help: lists the pages by folder, and prints a page without its hidden comments") {
    const TemporaryFolder folder;
    const Ended all = command(folder, {"help"});
    CHECK(all.exit == 0);
    for (const char* words : {"guide\n", "methods\n", "formats\n", "inside\n", "  glossary "})
        CHECK(has(all.out, words));
    CHECK(all.out.find("  first-run ") < all.out.find("formats\n"));
    const Ended page = command(folder, {"help", "first-run"});
    CHECK(page.exit == 0);
    CHECK(page.out.starts_with("# Your first run\n"));
    CHECK(!has(page.out, "<!--"));
    CHECK(!has(page.out, "-->\n"));
}

TEST_CASE(
    "help: words that are not a topic are searched for in all pages, and the best page comes "
    "first") {
    const TemporaryFolder folder;
    const Ended fading = command(folder, {"help", "Fading"});
    CHECK(fading.exit == 0);
    CHECK(fading.out.starts_with(
        "Pages with \"Fading\", the best first:\n  variation          Shadowing, fading and"));
    CHECK(fading.out.ends_with("\nrovernet help variation prints the first one.\n"));
    const Ended lost = command(folder, {"help", "why are", "messages lost"});
    CHECK(has(lost.out, "Pages with \"why are messages lost\", the best first:\n  traces "));
    CHECK(std::count(lost.out.begin(), lost.out.end(), '\n') == 9);  // six pages
    CHECK(has(command(folder, {"help", "flooding"}).out, "\n  routing "));
    CHECK(has(command(folder, {"help", "licence"}).out, "\n  versions "));
    CHECK(has(command(folder, {"help", "cite"}).out, "\n  versions "));
    const Ended only = command(folder, {"help", "OLSR"});
    CHECK(has(only.out, "  not-there          What is not there\n"));
}

TEST_CASE("help: several words may name one topic, and the name of a command leads to its --help") {
    const TemporaryFolder folder;
    CHECK(command(folder, {"help", "first", "run"}).out.starts_with("# Your first run\n"));
    CHECK(command(folder, {"help", ""}).out == command(folder, {"help"}).out);
    CHECK(command(folder, {"help", "run"})
              .out.starts_with("rovernet run --help explains this command.\n"));
}

TEST_CASE("help: if no page has the words, the error suggests the topic with the nearest name") {
    const TemporaryFolder folder;
    const Ended ended = command(folder, {"help", "frist-run"});
    CHECK(ended.exit == 2);
    CHECK(has(ended.err,
              "there is no topic \"frist-run\", and no page contains this word; did you mean "
              "\"first-run\"?"));
    CHECK(ended.out.empty());
    CHECK(has(command(folder, {"help", "xyzzy", "plugh"}).err,
              "no page contains one of these words; rovernet help lists all topics"));
}

}  // namespace help_test
