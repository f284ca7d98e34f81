// SPDX-License-Identifier: MIT
#include "study/command_words.hpp"

#include "scenario/scenario_file.hpp"
#include "test/cli/process.hpp"

namespace command_words_test {
using namespace rovernet;
using namespace rovernet::test;

TEST_CASE("command words: a shell reads every printed word back unchanged") {
    const std::vector<std::string> words{"plain-1.0/a_b=c:d,+", "",    "two words", "it's", "''",
                                         "\"$HOME\" `id` \\",   "*?[", "~",         "#x",   "a\nb",
                                         "\xc3\xa4;|&<>(){}!%"};
    std::string expected;
    for (const std::string& word : words) expected += word + '\0';
    for (const char* shell : {"/bin/bash", "/bin/sh"}) {
        const TemporaryFolder folder;
        const std::string line = "printf '%s\\0' " + shell_command(words);
        CHECK(Process(folder, {"-c", line}, shell).wait().out == expected);
    }
    CHECK(shell_word(words[0]) == words[0]);
}

TEST_CASE("command words: options of a scenario are printed in a fixed order") {
    const ScenarioOptions options{
        .set = {"a=1", "b=2"}, .world_path = {"w"}, .bitmaps = {"x=y"}, .lenient = true};
    CHECK(shell_command(option_words(options)) ==
          "--set a=1 --set b=2 --world-path w --bitmap x=y --lenient");
    CHECK(option_words({}).empty());
}

}  // namespace command_words_test
