// SPDX-License-Identifier: MIT
#include "mobility/files/fcd.hpp"

#include "test/mobility/files/playback.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <random>
#include <string>
#include <vector>

namespace fcd_test {
using namespace rovernet;
using test::movement_error;
using test::Playback;
using test::TemporaryFolder;

namespace {

using Kind = MovementCommand::Kind;

/// A few roundings of coordinates up to 1 km.
constexpr double tolerance = 1e-9;  // [m] or [m/s]

bool near(Vec3 a, Vec3 b) { return distance(a, b) <= tolerance; }

/// A file with these timesteps.
std::string fcd(const std::string& steps) {
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- by hand -->\n<fcd-export>\n" + steps +
           "</fcd-export>\n";
}
std::string step(const std::string& time, const std::string& robots) {
    return "<timestep time=\"" + time + "\">" + robots + "</timestep>\n";
}
std::string at(const std::string& id, const std::string& x, const std::string& y) {
    return "<vehicle id=\"" + id + "\" x=\"" + x + "\" y=\"" + y + "\" angle=\"90.00\"/>";
}
Playback played(const std::string& text, MovementSyntax syntax = MovementSyntax::strict) {
    const TemporaryFolder folder;
    return Playback(folder.write("fcd.xml", text), syntax);
}
std::string error_of(const std::string& text, MovementSyntax syntax = MovementSyntax::strict) {
    const TemporaryFolder folder;
    return movement_error(folder.write("fcd.xml", text), syntax);
}

}  // namespace

TEST_CASE("fcd: a robot is at its position at each timestep, and moves straight in between") {
    const auto p = played(fcd(step("0.00", at("a", "1", "2")) + step("2.00", at("a", "5", "2")) +
                              step("3.00", at("a", "5", "-1"))));
    REQUIRE(p.file.robots().size() == 1);
    CHECK(p.file.robots()[0].name == "a");
    CHECK(p.file.robots()[0].start == Vec3{1, 2, 0});
    CHECK(p.file.robots()[0].appears == start_of_run);
    REQUIRE(p.commands.size() == 2);
    CHECK(p.commands[0].kind == Kind::reach);
    CHECK(p.commands[0].arrival == start_of_run + from_seconds(2));
    CHECK(near(p.velocity("a", 0), {2, 0, 0}));
    CHECK(near(p.position("a", 1.5), {4, 2, 0}));
    CHECK(near(p.velocity("a", 2), {0, -3, 0}));
    CHECK(near(p.position("a", 3), {5, -1, 0}));
    CHECK(p.present("a", 99));
    CHECK(p.file.end() == start_of_run + from_seconds(3));
    CHECK(p.file.notices().empty());
}

TEST_CASE("fcd: robots appear, vanish after their last timestep and may come back") {
    const auto p =
        played(fcd(step("0", at("a", "0", "0")) + step("1", at("b", "5", "5") + at("a", "1", "0")) +
                   step("2", at("b", "6", "5")) + step("3", "") + step("4", at("b", "9", "9"))));
    REQUIRE(p.file.robots().size() == 2);
    CHECK(p.file.robots()[1].name == "b");
    CHECK(p.file.robots()[1].appears == start_of_run + from_seconds(1));
    std::string story;
    for (const auto& c : p.commands) {
        const char* kinds[] = {"appear", "go", "reach", "vanish"};
        story += std::to_string(c.time.time_since_epoch().count() / 1'000'000'000) + " " +
                 p.file.robots()[c.robot].name + " " + kinds[static_cast<int>(c.kind)] + "; ";
    }
    CHECK(story == "0 a reach; 1 b appear; 1 b reach; 1 a vanish; 2 b vanish; 4 b appear; ");
    CHECK(p.present("a", 0.5));
    CHECK_FALSE(p.present("a", 1));
    CHECK_FALSE(p.present("b", 0.5));
    CHECK(p.present("b", 1.5));
    CHECK_FALSE(p.present("b", 3));
    CHECK(p.present("b", 4));
    CHECK(near(p.position("b", 4), {9, 9, 0}));
}

TEST_CASE("fcd: if the first timestep is after the start, its robots appear only then") {
    const auto p = played(fcd(step("1", at("a", "5", "0")) + step("2", at("a", "9", "0"))));
    CHECK_FALSE(p.present("a", 0.5));
    CHECK(p.present("a", 1.5));
    CHECK(near(p.position("a", 1.5), {7, 0, 0}));
}

TEST_CASE(
    "fcd: persons and containers become robots, keep their z, and may rest between timesteps") {
    const auto p = played(
        fcd(step("0",
                 "<person id='p' y='1' x='2' z='3.5' edge='e'/><container id='c' x='0' "
                 "y='0'></container>") +
            step("1", "<person id='p' y='1' x='2' z='3.5'/><container id='c' x='0' y='4'/>") +
            step("2", "<person id='p' y='1' x='2' z='1.5'/><container id='c' x='0' y='4'/>")));
    CHECK(p.file.robots()[0].start == Vec3{2, 1, 3.5});
    CHECK(p.commands.size() == 2);
    CHECK(near(p.position("p", 1.5), {2, 1, 2.5}));
    CHECK(near(p.position("c", 0.5), {0, 2, 0}));
}

TEST_CASE("fcd: names of robots are the ids, with character references and non-ASCII letters") {
    const auto p = played(
        fcd(step("0", at("a&amp;b&lt;&#65;&#x42;&#xe4;", "0", "0") + at("\xc3\xa4>", "1", "1"))));
    REQUIRE(p.file.robots().size() == 2);
    CHECK(p.file.robots()[0].name == "a&b<AB\xc3\xa4");
    CHECK(p.file.robots()[1].name == "\xc3\xa4>");
    const auto q = played(fcd(step("0", at("&#x20AC;&#128512;", "0", "0"))));
    CHECK(q.file.robots()[0].name == "\xe2\x82\xac\xf0\x9f\x98\x80");
    CHECK(error_of(fcd(step("0", at("\xff", "0", "0")))).find("UTF-8") != std::string::npos);
    CHECK(error_of(fcd(step("0", at("a&#10;b", "0", "0")))).find("UTF-8") != std::string::npos);
    CHECK(error_of(fcd(step("0", at("", "0", "0")))) ==
          "fcd.xml:4:20: found <vehicle> without the attribute id, expected id=\"...\"");
    CHECK(error_of(fcd(step("0", at("a&b;", "0", "0"))))
              .ends_with("found \"&b;\", expected a character reference such as &amp;"));
    CHECK(error_of(fcd(step("0", at("&#xD800;", "0", "0")))) != "");
    CHECK(error_of(fcd(step("0", at("&#0;", "0", "0")))) != "");
    CHECK(error_of(fcd(step("0", at("a&amp", "0", "0")))) != "");
}

TEST_CASE("fcd: content that is invalid in an FCD file is refused, with line and column") {
    const auto body = [](const std::string& text) { return error_of(fcd(text)); };
    CHECK(body(step("0", at("a", "0", "0")) + step("1", at("a", "0", "0") + at("a", "1", "0"))) ==
          "fcd.xml:5:76: found \"a\", expected each id only once in a timestep");
    CHECK(body(step("2", "") + step("2", "")) ==
          "fcd.xml:5:17: found \"2\", expected a later time than the time of the timestep before");
    CHECK(body(step("-1", "")) == "fcd.xml:4:17: found \"-1\", expected a time from 0 to 9e9 [s]");
    CHECK(body(step("0", "<vehicle id=\"a\"\n  x=\"1\"\n y=\"1,5\"/>")) ==
          "fcd.xml:6:5: found \"1,5\", expected a coordinate from -1e9 to 1e9 [m]");
    CHECK(body(step("0", at("a", "", "1"))) ==
          "fcd.xml:4:20: found <vehicle> without the attribute x, expected x=\"...\"");
    CHECK(body(step("0", "<vehicle id=\"a\" x=\"1\"/>")) ==
          "fcd.xml:4:20: found <vehicle> without the attribute y, expected y=\"...\"");
    CHECK(body("<timestep/>") ==
          "fcd.xml:4:1: found <timestep> without the attribute time, expected time=\"...\"");
    CHECK(body(step("0", "<vehicel id=\"a\"/>")) ==
          "fcd.xml:4:20: found <vehicel>, expected <timestep> with <vehicle>, <person> or "
          "<container>; did you mean \"vehicle\"?");
    CHECK(error_of("<routes><vehicle/></routes>") ==
          "fcd.xml:1:2: found \"routes\", expected fcd-export, the only kind of XML file with "
          "movements that can be read");
}

TEST_CASE("fcd: XML that is not well-formed is refused, with line and column") {
    const auto body = [](const std::string& text) { return error_of(fcd(text)); };
    CHECK(body("<timestep time=\"0\">") ==
          "fcd.xml:4:20: found \"</fcd-export>\", expected </timestep>");
    CHECK(body("text") == "fcd.xml:4:1: found \"text\", expected a tag (<)");
    CHECK(body("<!DOCTYPE x>") == "fcd.xml:4:1: found \"<!DOCTYPE\", expected an element");
    CHECK(body("<![CDATA[x]]>") == "fcd.xml:4:1: found \"<![CDATA[\", expected an element");
    CHECK(body("<!-- x") ==
          "fcd.xml:4:1: the comment or processing instruction that begins here has no end, "
          "expected \"-->\"");
    CHECK(body("<timestep time=\"0") == "fcd.xml:4:1: the file ends inside a tag, expected \">\"");
    CHECK(body("<timestep time=0>") == "fcd.xml:4:16: found \"0>\", expected a value in quotes");
    CHECK(body("<timestep time>") ==
          "fcd.xml:4:15: found \">\", expected \"=\" after an attribute's name");
    CHECK(body("<timestep time=\"0\"time=\"1\">") ==
          "fcd.xml:4:19: found \"time=\"1\">\", expected a blank, \"/>\" or \">\"");
    CHECK(body("<timestep time=\"0\" time=\"1\">") ==
          "fcd.xml:4:20: found \"time\", expected each attribute once");
    CHECK(body("<timestep time=\"<\">") ==
          "fcd.xml:4:17: found \"<\", expected \"&lt;\" in a value");
    CHECK(body("<timestep time=\"0\" 1=\"1\">").starts_with("fcd.xml:4:20: found "));
    CHECK(body("< timestep>")
              .starts_with("fcd.xml:4:1: found \"<\", expected the name of an element"));
    CHECK(error_of("<fcd-export>\n<timestep time=\"0\">\n") ==
          "fcd.xml:3:1: the file ends inside <timestep>, expected </timestep>");
    CHECK(error_of("<fcd-export/><fcd-export/>").starts_with("fcd.xml:1:14: found "));
    CHECK(error_of("<?xml?>") == "fcd.xml:1:8: the file ends, expected an element");
    CHECK(error_of(fcd("<timestep time=\"0\" x=\"" + std::string(70'000, 'x') + "\"/>")) ==
          "fcd.xml:4:1: a tag is longer than 65536 bytes, which is the limit; check that this is "
          "the right file");
    CHECK(error_of(fcd("<timestep time=\"0\" x=\"" + std::string(60'000, 'x') + "\"/>")) == "");
    CHECK(error_of("</a>").starts_with("fcd.xml:1:1: found \"</a>\", expected an element"));
}

TEST_CASE("fcd: an empty export has no robots") {
    CHECK(played("<fcd-export/>").file.robots().empty());
    CHECK(played("\xef\xbb\xbf" + fcd(step("0", ""))).commands.empty());
}

TEST_CASE(
    "fcd: in tolerant mode unknown elements, also nested ones, and incomplete robots are skipped") {
    std::string deep;
    for (int i = 0; i < 50; ++i) deep += "<e" + std::to_string(i) + ">";
    for (int i = 50; i-- > 0;) deep += "</e" + std::to_string(i) + ">";
    const std::string text =
        fcd("<meta><vehicle id='x'/></meta>" +
            step("0", at("a", "0", "0") + "<vehicle id='b'/>" + deep + at("a", "1", "1")) +
            step("1", at("a", "2", "0")));
    CHECK(error_of(text).starts_with("fcd.xml:4:1: found <meta>"));
    const auto p = played(text, MovementSyntax::tolerant);
    CHECK(p.file.robots().size() == 1);
    CHECK(near(p.position("a", 0.5), {1, 0, 0}));
    REQUIRE(p.file.notices().size() == 1);
    CHECK(p.file.notices()[0].starts_with("4 elements are left out; the first: "));
    for (int i = 0; i < 20; ++i)
        deep = "<d" + std::to_string(i) + ">" + deep + "</d" + std::to_string(i) + ">";
    CHECK(error_of(fcd(deep), MovementSyntax::tolerant).find("elements nested at most 64 levels") !=
          std::string::npos);
}

TEST_CASE(
    "fcd: tags and comments that cross the blocks in which the file is read are read correctly") {
    std::string steps = "<!--" + std::string(600'000, '-') + "-->";
    for (int i = 0; i < 8'000; ++i) {
        steps += step(std::to_string(i), at("a", std::to_string(i), "7") +
                                             std::string(static_cast<std::size_t>(i % 61), ' ') +
                                             at("b", "1", std::to_string(-i)));
    }
    const auto p = played(fcd(steps));
    CHECK(p.commands.size() == 2 * 7'999);
    int wrong = 0;
    for (std::size_t i = 0; i < p.commands.size(); ++i) {
        const double k = static_cast<double>(i / 2) + 1;
        wrong += p.commands[i].to != (i % 2 == 0 ? Vec3{k, 7, 0} : Vec3{1, -k, 0});
    }
    CHECK(wrong == 0);
}

TEST_CASE("fcd: the file is read in blocks; the end mark --> of a comment may lie in two of them") {
    const std::size_t portion = 64 * 1024;
    for (std::size_t n = portion - 100; n < portion + 3; ++n) {
        const std::string comment = "<!--" + std::string(n, 'x') + "-->\n";
        if (error_of(comment + "<fcd-export/>") != "") FAIL_CHECK(n);
    }
}

TEST_CASE("fcd: while many robots come and go, each robot keeps its own motion") {
    std::mt19937 draw(2);
    std::string steps;
    std::vector<std::vector<int>> seen(300, std::vector<int>(40, 0));
    for (int t = 0; t < 40; ++t) {
        std::string robots;
        for (int i = 0; i < 300; ++i) {
            if (draw() % 3 == 0) continue;
            seen[static_cast<std::size_t>(i)][static_cast<std::size_t>(t)] = 1;
            robots += at("car" + std::to_string(i), std::to_string(i), std::to_string(t));
        }
        steps += step(std::to_string(t), robots);
    }
    const auto p = played(fcd(steps));
    int wrong = 0;
    for (int i = 0; i < 300; ++i) {
        const auto& own = seen[static_cast<std::size_t>(i)];
        const std::string name = "car" + std::to_string(i);
        for (std::size_t t = 0; t < 40; ++t) {
            // Between two timesteps it is there if both have it.
            const bool there = own[t] && (t == 39 || own[t + 1]);
            wrong += p.present(name, static_cast<double>(t) + 0.5) != there;
            if (there)
                wrong += !near(p.position(name, static_cast<double>(t)),
                               {static_cast<double>(i), static_cast<double>(t), 0});
        }
    }
    CHECK(wrong == 0);
}

TEST_CASE("fcd: a damaged file is read or refused, without a crash") {
    std::mt19937 draw(5);
    const auto below = [&](std::size_t n) { return draw() % n; };
    const std::string good =
        fcd(step("0", at("a", "0", "0")) + step("1", at("b&amp;", "5", "5") + at("a", "1", "0")));
    int refused = 0;
    for (int i = 0; i < 400; ++i) {
        std::string text = good;
        for (std::size_t n = 1 + below(3); n > 0; --n) {
            const std::size_t place = below(text.size());
            switch (below(4)) {
                case 0: text[place] = static_cast<char>(below(256)); break;
                case 1: text.erase(place, 1 + below(10)); break;
                case 2: text.insert(place, good.substr(below(good.size()), below(60))); break;
                default: text[place] = "0123456789 .-<>\"'&/="[below(20)]; break;
            }
        }
        refused += error_of(text) != "";
        error_of(text, MovementSyntax::tolerant);
    }
    CHECK(refused > 100);
    CHECK(refused < 400);
}

TEST_CASE(
    "fcd: in a file of SUMO, the reader finds the same content as a simple line-based reader") {
    const char* folder = std::getenv("ROVERNET_MOVEMENTS");
    if (!folder) {
        MESSAGE("ROVERNET_MOVEMENTS is not set: skipped");
        return;
    }
    const std::string path = std::string(folder) + "/sumo/fcd.xml";
    const Playback p(path);
    CHECK(p.file.robots().size() == 20);
    CHECK(p.file.end() == start_of_run + from_seconds(99));
    std::ifstream in(path);
    double t = 0;
    int places = 0;
    int wrong = 0;
    for (std::string line; std::getline(in, line);) {
        char id[32];
        double x = 0;
        double y = 0;
        std::sscanf(line.c_str(), " <timestep time=\"%lf\"", &t);
        if (std::sscanf(line.c_str(), " <vehicle id=\"%31[^\"]\" x=\"%lf\" y=\"%lf\"", id, &x,
                        &y) == 3) {
            ++places;
            wrong += !near(p.position(id, t), {x, y, 0});
        }
    }
    CHECK(places > 1'000);
    CHECK(wrong == 0);
}

TEST_CASE(
    "fcd: positions in degrees are recognised by the file's header or by the speeds, and refused") {
    const TemporaryFolder folder;
    const auto refused = [&](const std::string& head, const std::string& places) {
        const std::string error =
            movement_error(folder.write("f.xml", head + "<fcd-export>" + places + "</fcd-export>"));
        return error.find("in degrees") != error.npos;
    };
    const auto option = [](const std::string& value) {
        return "<?xml version=\"1.0\"?>\n<!-- generated by Eclipse SUMO\n<fcd-output "
               "value=\"f.xml\"/>"
               "\n<fcd-output.geo value=\"" +
               value + "\"/>\n<seed value=\"true\"/>-->\n";
    };
    const std::string standing =
        "<timestep time=\"0\"><vehicle id=\"a\" x=\"13.4\" y=\"52.5\" speed=\"0.00\"/></timestep>";
    const auto moves = [](const std::string& x, const std::string& speed) {
        return "<timestep time=\"0\"><vehicle id=\"a\" x=\"13.4\" y=\"52.5\" "
               "speed=\"9\"/></timestep>"
               "<timestep time=\"1\"><vehicle id=\"a\" x=\"" +
               x + "\" y=\"52.5\" speed=\"" + speed + "\"/></timestep>";
    };
    for (const char* yes : {"true", "True", "1", "yes", "on", "t"})
        CHECK(refused(option(yes), standing));
    for (const char* no : {"false", "0", "no", "off"}) CHECK_FALSE(refused(option(no), standing));
    CHECK_FALSE(refused("", standing));
    CHECK(refused("", moves("13.40013", "9.00")));
    CHECK_FALSE(refused("", moves("22.4", "9.00")));
    CHECK_FALSE(refused("", moves("13.5", "9.00")));
    CHECK_FALSE(refused("", moves("13.4", "0.00")));
}

}  // namespace fcd_test
