// SPDX-License-Identifier: MIT
#include "pictures/map/link_stroke.hpp"

#include "pictures/draw/arrow_head.hpp"
#include "pictures/draw/color.hpp"
#include "pictures/map/link_grades.hpp"

#include <utility>

namespace rovernet {
namespace {

constexpr double sample_width = 30;            // [px]
constexpr double gap_width = 7, gap_core = 4;  // [px] of the dark line and the white in it

void stroke(Svg& svg, const std::string& data, Color color, double width, const char* dashes) {
    svg.add("path", {{"d", data},
                     {"fill", "none"},
                     {"stroke", color},
                     {"stroke-width", width},
                     {"stroke-dasharray", dashes}});
}

std::string sample_path(PicturePoint p) {
    return SvgPath().move(p.x, p.y).horizontal(p.x + sample_width).text();
}

}  // namespace

void draw_link_stroke(Svg& svg, const std::string& data, const LinkStroke& look) {
    const LinkGrade& grade = link_grades[look.grade];
    stroke(svg, data, look.seam ? Color{0xff, 0xff, 0xff} : ember.at(grade.shade),
           look.width * grade.width + (look.seam ? 1.6 : 0),
           look.dashed && !look.seam ? "7 4" : "none");
}

LegendItem link_sample(std::string text, const LinkStroke& look) {
    return {std::move(text), sample_width, [look](Svg& svg, PicturePoint p) {
                const LinkGrade& grade = link_grades[look.grade];
                SvgPath head;
                draw_link_stroke(svg, sample_path(p), look);
                if (!look.dashed) return;
                append_arrow_head(head, p, {p.x + sample_width + 4, p.y}, 2, grade.width);
                svg.add("path", {{"d", head.text()}, {"fill", ember.at(grade.shade)}});
            }};
}

void draw_gap_stroke(Svg& svg, const std::string& data) {
    stroke(svg, data, {0x22, 0x22, 0x22}, gap_width, "none");
    stroke(svg, data, {0xff, 0xff, 0xff}, gap_core, "none");
}

LegendItem gap_sample(std::string text) {
    return {std::move(text), sample_width,
            [](Svg& svg, PicturePoint p) { draw_gap_stroke(svg, sample_path(p)); }};
}

}  // namespace rovernet
