// SPDX-License-Identifier: MIT
#include "pictures/draw/svg.hpp"

#include "test/pictures/draw/well_formed.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <string>

namespace svg_test {
using namespace rovernet;

TEST_CASE("svg: numbers have at most two decimals, no needless zeros and no minus before a zero") {
    CHECK(svg_number(0) == "0");
    CHECK(svg_number(-0.001) == "0");
    CHECK(svg_number(12.5) == "12.5");
    CHECK(svg_number(100) == "100");
    CHECK(svg_number(-3.14159) == "-3.14");
    CHECK(svg_number(0.996) == "1");
}

TEST_CASE("svg: infinite and very large values give valid numbers") {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    CHECK(svg_number(infinity) == "1000000000");
    CHECK(svg_number(-infinity) == "-1000000000");
    CHECK(svg_number(std::numeric_limits<double>::quiet_NaN()) == "0");
}

TEST_CASE("svg: markup is escaped, and characters that XML cannot contain become U+FFFD") {
    const std::string bad = "\xef\xbf\xbd";
    CHECK(xml_text("a<b>&\"'") == "a&lt;b&gt;&amp;&quot;&#39;");
    CHECK(xml_text("R\xc3\xb6hre \xe6\x9c\xba \xf0\x9f\xa4\x96") ==
          "R\xc3\xb6hre \xe6\x9c\xba \xf0\x9f\xa4\x96");
    CHECK(xml_text(std::string("a\0b", 3)) == "a" + bad + "b");
    CHECK(xml_text("\x1b[0m") == bad + "[0m");
    CHECK(xml_text("\xff") == bad);
    CHECK(xml_text("\xc3") == bad);                                // cut off
    CHECK(xml_text("\xc0\xaf") == bad + bad);                      // a longer form of "/"
    CHECK(xml_text("\xed\xa0\x80") == bad + bad + bad);            // a surrogate
    CHECK(xml_text("\xef\xbf\xbf") == bad);                        // U+FFFF
    CHECK(xml_text("\xf4\x90\x80\x80") == bad + bad + bad + bad);  // beyond U+10FFFF
}

TEST_CASE("svg: a text is shortened by characters, not by bytes") {
    CHECK(shortened("robot", 5) == "robot");
    CHECK(shortened("robots", 5) == "robo\xe2\x80\xa6");
    CHECK(shortened("\xc3\xa4\xc3\xb6\xc3\xbc", 3) == "\xc3\xa4\xc3\xb6\xc3\xbc");
    CHECK(shortened("\xc3\xa4\xc3\xb6\xc3\xbc", 2) == "\xc3\xa4\xe2\x80\xa6");
}

TEST_CASE(
    "svg: the width of a text depends on its letters and font size; an unknown character counts as "
    "wide") {
    CHECK(text_width("ii", 10) < text_width("mm", 10));
    CHECK(text_width("abc", 20) == 2 * text_width("abc", 10));
    CHECK(text_width("\xe6\x9c\xba", 10) >= 10);
}

TEST_CASE("svg: a path is written with one SVG command for each drawing call") {
    SvgPath path;
    CHECK(path.empty());
    path.move(1, 2.004).horizontal(3).vertical(-4).line(0.5, 0.25).close();
    CHECK(path.text() == "M1 2H3V-4L0.5 0.25Z");
}

TEST_CASE("svg: a document with any names in it is well-formed XML, and open elements are closed") {
    Svg svg(100, 50.5);
    svg.open("g", {{"id", "a\"b<c>&"}, {"opacity", 0.5}, {"fill", Color{255, 0, 16}}});
    svg.title("</title>&");
    svg.text(1, 2, "<svg>\"&amp;", {.anchor = TextAnchor::end, .bold = true, .halo = true});
    svg.open("g", {});
    svg.add("circle", {{"r", 1.0}});
    const std::string text = svg.finish();
    CHECK(test::xml_fault(text) == "");
    CHECK(text.find("fill=\"#ff0010\"") != std::string::npos);
    CHECK(text.find("viewBox=\"0 0 100 50.5\"") != std::string::npos);
    CHECK(text.find("&lt;/title&gt;&amp;") != std::string::npos);
}

TEST_CASE("svg: the check for well-formed XML finds errors") {
    CHECK(test::xml_fault("<a><b></a></b>") != "");
    CHECK(test::xml_fault("<a>") != "");
    CHECK(test::xml_fault("<a/><b/>") != "");
    CHECK(test::xml_fault("<a b=\"<\"/>") != "");
    CHECK(test::xml_fault("<a>x & y</a>") != "");
    CHECK(test::xml_fault("<a b=c/>") != "");
    CHECK(test::xml_fault("<a b=\"1\" b=\"2\"/>") != "");
    CHECK(test::xml_fault("<?xml version=\"1.0\"?>\n<a b=\"c\"><d/>&amp;</a>\n") == "");
}

}  // namespace svg_test
