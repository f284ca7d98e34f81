// SPDX-License-Identifier: MIT
#include "test/cli/process.hpp"

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

TEST_CASE("help: an unknown topic is an error that suggests the nearest topic") {
    const TemporaryFolder folder;
    const Ended ended = command(folder, {"help", "frist-run"});
    CHECK(ended.exit == 2);
    CHECK(has(ended.err, "there is no topic \"frist-run\"; did you mean \"first-run\"?"));
    CHECK(ended.out.empty());
}

}  // namespace help_test
