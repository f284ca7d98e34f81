// SPDX-License-Identifier: MIT
#include "scenario/document/toml.hpp"

#include "scenario/document/json.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <string>

namespace toml_test {
using namespace rovernet;
using rovernet::test::TemporaryFolder;

namespace {

std::string place_of_error(const std::string& text) {
    try {
        parse_toml(text, "f.toml");
    } catch (const InputError& error) {
        return error.where().text();
    }
    return "no error";
}

std::string error_of_file(const std::string& path) {
    try {
        read_toml(path);
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

std::string after_option(const std::string& text, const std::string& option) {
    Value document = parse_toml(text, "f.toml");
    set_option(document, option, "--set " + option);
    return to_toml(*document.table());
}

std::string error_of_option(const std::string& text, const std::string& option) {
    try {
        after_option(text, option);
    } catch (const InputError& error) {
        CHECK(error.where().is_option);
        return error.what();
    }
    return "no error";
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("toml: a printed document is read back unchanged") {
    const std::string text =
        "whole = -5\nreal = 0.1\nlarge = 1e+300\ntruth = true\n"
        "text = \"quote \\\" slash \\\\ tab \\u0009 é\"\n\n[table]\nlist = [1, 2.0, [\"a\"]]\n"
        "\"dotted.key\" = { a = 1, b = [] }\n\n[[each]]\nn = 1\n\n[[each]]\nn = 2\n";
    const Value document = parse_toml(text, "f.toml");
    const std::string printed = to_toml(*document.table());
    CHECK(printed == text);
    CHECK(to_json(parse_toml(printed, "f.toml")) == to_json(document));
}

TEST_CASE("toml: printed keys have the same order as in the file") {
    CHECK(to_toml(*parse_toml("z = 1\na = 2\nm = 3", "").table()) == "z = 1\na = 2\nm = 3\n");
}

TEST_CASE("toml: a real number without a fraction is printed as a real number, such as 30.0") {
    CHECK(to_toml(*parse_toml("a = 30.0", "").table()) == "a = 30.0\n");
}

TEST_CASE(
    "toml: --set finds a key whose name contains dots, with or without quotes around the name") {
    const std::string text = "vary = { \"radio.power\" = [1], b = 2 }\n";
    for (const char* path : {"vary.radio.power", "vary.\"radio.power\""}) {
        CHECK(after_option(text, std::string(path) + "=[3]") ==
              "[vary]\n\"radio.power\" = [3]\nb = 2\n");
    }
    CHECK(after_option("vary = { b = 2 }\n", "vary.radio.power=[3]") ==
          "[vary]\nb = 2\nradio = { power = [3] }\n");
}

TEST_CASE(
    "toml: for mistakes with quotes, commas or lines, the error says what is probably wrong") {
    const auto error_of = [](const std::string& text) -> std::string {
        try {
            parse_toml(text, "f");
        } catch (const InputError& error) {
            return error.what();
        }
        return "no error";
    };
    const auto check = [&](const std::string& text, const char* place, const char* words) {
        const std::string error = error_of(text);
        CAPTURE(error);
        CHECK(error.starts_with(std::string("f:") + place + ": "));
        CHECK(contains(error, words));
    };
    const std::string quotes = "need quotes: \"30 mW\"", own_line = "on its own line";
    check("a = \"15 dBm\",\nb = 1", "1:13", "no comma after the value");
    check("a = [1],", "1:8", "no comma after the value");
    check("a = 2,5 m", "1:6", "write the decimal point as \".\"");
    check("a = \"1 m\" b = \"2 m\"", "1:11", own_line.c_str());
    check("a = 30 mW", "1:8", quotes.c_str());
    check("a = \"1 m\nb = 2", "1:9", "closing quote of a text is missing; expected \" at");
    check("a = \"1 m\r\nb = 2", "1:9", "closing quote of a text is missing; expected \" at");
    check("a = '1 m\nb = 2", "1:9", "closing quote of a text is missing; expected ' at");
    check("a = \"1 m", "1:9", "closing quote of a text is missing");
    check("a = \u201c1 m\u201d", "1:5", "typographic quote \u201c; expected the straight quote \"");
    check("a = [0 m, 1 m]", "1:8", "texts and quantities in quotes");
    check("x = { bb = 1, bb = 2 }", "1:15", "the key \"bb\" occurs a second time");
    check("a = 1979-05-27", "1:5", "a date or a time of day, but no key has such a value");
}

TEST_CASE("toml: if a key or table occurs twice, in any notation, the error contains its name") {
    const auto check = [](const std::string& text, const std::string& error) {
        CAPTURE(text);
        try {
            parse_toml(text, "f");
            CHECK_MESSAGE(false, "no error");
        } catch (const InputError& thrown) {
            CHECK(std::string(thrown.what()) == "f:" + error);
        }
    };
    const std::string once = " occurs a second time; expected the key once";
    const std::string together =
        " occurs a second time; expected all keys of this table in one place";
    check("r = [{ n = 1 }]\nr.x = 1", "2:1: the key \"r\"" + once);
    check("r = { a = 1 }\nr.b = 2", "2:1: the key \"r\"" + together);
    check("[s]\nvary.radio = [1]\nvary.radio.power = [2]", "3:6: the key \"vary.radio\"" + once);
    check("[s]\nvary.radio.power = [1]\nvary.radio = [2]",
          "3:1: the key \"vary.radio\"" + together);
    check("power = 1\n\"power\" = 2", "2:1: the key \"power\"" + once);
    check("'a b' = 1\n  'a b' = 2", "2:3: the key \"a b\"" + once);
    check("x = { \"a,b\" = 1, \"a,b\" = 2 }", "1:18: the key \"a,b\"" + once);
    check("a . b = 1\na . \"b\" = 2", "2:1: the key \"a.\"b\"\"" + once);
    check("\"\u00e9\".p = 1\n\"\u00e9\".p = [2]", "2:1: the key \"\"\u00e9\".p\"" + once);
    check("x = [1]\n[[x]]", "2:1: the key \"x\"" + once);
    check("[[robot]]\n[ robot ]",
          "2:1: [robot] occurs a second time; in a list of tables, write [[robot]] before each "
          "table");
    check("x.y = 1\n[x]",
          "2:1: [x] occurs a second time; expected one header [x], and all keys of this table "
          "below it");
    const std::string inside =
        "2:1: [x.y]: this name begins with a key that already has a value, so no keys can be added "
        "to that key; give this table a different name, or remove that key";
    check("x = 1\n[x.y]", inside);
    check("x = 1\n[x.y]\nk = 1", inside);
    check("x = 1\n[[x . \"y\"]]\n[[robot]]", std::string(inside).replace(6, 3, "x.\"y\""));
    const std::string braces =
        ": this name begins with a table that is written in braces, so no keys can be added to "
        "that table; write all keys of that table inside the braces, or all of them under a header "
        "[NAME], without braces";
    check("x = { a = 1 }\n[x.y]\n", "2:1: [x.y]" + braces);
    check("x = { a = 1 }\n[x.y]\nk = 1", "2:1: [x.y]" + braces);
    check("x = { a = 1 }\n  [x.y.z]  # in the line above\n\nk = 1", "2:3: [x.y.z]" + braces);
    check("x = { a = 1 }\n[[x.y]]\n[[robot]]", "2:1: [x.y]" + braces);
}

TEST_CASE("toml: an error has the line and column of the mistake") {
    CHECK(place_of_error("a = 1\na = 2") == "f.toml:2:1");
    CHECK(place_of_error("a = 1\nb = [1, 2\n") == "f.toml:2:11");
    CHECK(place_of_error("a = 1\nb = 12:00:00") == "f.toml:2:5");
    CHECK(place_of_error("a = 1\nb = \"\xff\"") == "f.toml:2:5");
}

TEST_CASE("toml: the error for a missing file or a directory states the reason") {
    const TemporaryFolder folder;
    CHECK(contains(error_of_file(folder.path("no.toml")), "no such file"));
    CHECK(error_of_file(folder.path("no.toml")).starts_with(folder.path("no.toml") + ": "));
    CHECK(contains(error_of_file(folder.path("")), "a directory"));
}

TEST_CASE("toml: an empty file is an empty document") {
    const TemporaryFolder folder;
    CHECK(read_toml(folder.write("empty.toml", "")).table()->entries.empty());
}

TEST_CASE(
    "set_option: the path of a key may contain tables, names of robots and numbers of robots") {
    const std::string text = "[[robot]]\nname = \"A\"\n\n[[robot]]\nname = \"B\"\n";
    CHECK(after_option(text, "robot.1.radius=2") == text + "radius = 2\n");
    CHECK(after_option(text, "robot.B.radius=2") == text + "radius = 2\n");
    CHECK(after_option(text, "robot.B.radio.power=2") == text + "radio = { power = 2 }\n");
    CHECK(after_option("", "a.b=1") == "[a]\nb = 1\n");
    CHECK(after_option("[a]\nb = 1\n", "a.b=2") == "[a]\nb = 2\n");
}

TEST_CASE(
    "set_option: a name with dots must be in quotes, and the error for a name without quotes says "
    "so") {
    const std::string text = "[[robot]]\nname = \"flow.0\"\n\n[[robot]]\nname = \"a=b\"\n";
    CHECK(contains(after_option(text, "robot.\"flow.0\".radio.power=2"),
                   "name = \"flow.0\"\nradio = { power = 2 }\n"));
    CHECK(contains(after_option(text, "robot.\"a=b\".radius=2"), "name = \"a=b\"\nradius = 2\n"));
    CHECK(after_option("", "\"a.b\"=1") == "\"a.b\" = 1\n");
    CHECK(contains(error_of_option(text, "robot.flow.0.radio.power=2"),
                   "no item of the list is named \"flow\"; a name that contains dots needs "
                   "quotes: \"flow.0\""));
    for (const char* option : {"\"a.b=1", "\"a\"b=1", "\"\".a=1"}) {
        CAPTURE(option);
        CHECK(error_of_option(text, option).starts_with("--set " + std::string(option) + ": "));
    }
}

TEST_CASE(
    "set_option: if a robot's name is a number, this number never selects a different robot") {
    const std::string text = "[[robot]]\nname = \"1\"\n\n[[robot]]\nname = \"2\"\n";
    const std::string first = "[[robot]]\nname = \"1\"\nradius = 9\n\n[[robot]]\nname = \"2\"\n";
    CHECK(after_option(text, "robot.\"1\".radius=9") == first);
    CHECK(after_option(text, "robot.0.radius=9") == first);
    CHECK(after_option(text, "robot.2.radius=9") == text + "radius = 9\n");
    CHECK(contains(error_of_option(text, "robot.1.radius=9"), "write \"1\" in quotes"));
    CHECK(contains(error_of_option(text, "robot.3.radius=9"), "there is no item 3"));
    CHECK(contains(error_of_option(text, "robot.\"0\".radius=9"), "no item of the list is named"));
    const std::string same = "[[robot]]\nname = \"0\"\n";
    CHECK(after_option(same, "robot.0.radius=9") == same + "radius = 9\n");
}

TEST_CASE("set_option: a value is read as TOML if possible, and as text otherwise") {
    CHECK(after_option("", "a=friis") == "a = \"friis\"\n");
    CHECK(after_option("", "a=\"friis\"") == "a = \"friis\"\n");
    CHECK(after_option("", "a=15 dBm") == "a = \"15 dBm\"\n");
    CHECK(after_option("", "a=1e-3") == "a = 0.001\n");
    CHECK(after_option("", "a=true") == "a = true\n");
    CHECK(after_option("", "a=[1, 2]") == "a = [1, 2]\n");
    CHECK(after_option("", "a=") == "a = \"\"\n");
    CHECK(after_option("", "a=b=c") == "a = \"b=c\"\n");
    CHECK(after_option("", "a=1\nb = 2") == "a = \"1\\u000ab = 2\"\n");
    CHECK(after_option("", "a=2007-01-01") == "a = \"2007-01-01\"\n");
}

TEST_CASE("set_option: an error message begins with the text of the option") {
    const std::string text = "a = 1\n[[robot]]\nname = \"Anna\"\n";
    for (const char* option : {"radio.power", "=5", "", "a..b=1", ".a=1", "a.=1", "a.b=1",
                               "robot.7.radius=1", "robot.Ana.radius=1"}) {
        CAPTURE(option);
        CHECK(error_of_option(text, option).starts_with("--set " + std::string(option) + ": "));
    }
    CHECK(contains(error_of_option(text, "robot.7.radius=1"), "the list has 1"));
    CHECK(contains(error_of_option(text, "robot.Ana.radius=1"), "did you mean \"Anna\"?"));
    CHECK(contains(error_of_option(text, "a.b=1"), "which has no keys"));
}

}  // namespace toml_test
