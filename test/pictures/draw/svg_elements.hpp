// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/draw/plot.hpp"
#include "pictures/draw/svg.hpp"

#include <doctest/doctest.h>

#include <charconv>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet::test {

/// Element of a well-formed SVG document.
struct SvgElement {
    std::string name;
    std::map<std::string, std::string> attributes = {};
    std::string group = {};  ///< class of the nearest enclosing group that has a class
    std::string text = {};   ///< text directly after the start tag

    double number(const std::string& key) const {
        const std::string& value = attributes.at(key);
        double v = 0;
        const auto end = value.data() + value.size();
        REQUIRE(std::from_chars(value.data(), end, v).ptr == end);
        return v;
    }
    std::string shape() const {
        const auto found = attributes.find("class");
        return found == attributes.end() ? "" : found->second;
    }
};

/// Elements of a document in the order of their start tags.
inline std::vector<SvgElement> svg_elements(std::string_view svg) {
    std::vector<SvgElement> out;
    std::vector<std::string> groups{""};
    svg.remove_prefix(svg.find("<svg"));
    while (!svg.empty()) {
        const auto end = svg.find('>');
        std::string_view tag = svg.substr(1, end - 1);
        svg.remove_prefix(end + 1);
        const auto text = svg.substr(0, svg.find('<'));
        svg.remove_prefix(text.size());
        if (tag.starts_with('/')) {
            groups.pop_back();
            continue;
        }
        SvgElement element{.name = std::string(tag.substr(0, tag.find_first_of(" /")))};
        element.group = groups.back();
        element.text = std::string(text.substr(0, text.find('\n')));
        for (auto at = tag.find("=\""); at != tag.npos; at = tag.find("=\"")) {
            const auto name = tag.substr(0, at).substr(tag.substr(0, at).rfind(' ') + 1);
            tag.remove_prefix(at + 2);
            element.attributes[std::string(name)] = std::string(tag.substr(0, tag.find('"')));
            tag.remove_prefix(tag.find('"') + 1);
        }
        if (!tag.ends_with('/')) {
            groups.push_back(element.shape().empty() ? groups.back() : element.shape());
        }
        out.push_back(std::move(element));
    }
    return out;
}

/// Elements of a class, without the symbols of a legend.
inline std::vector<SvgElement> of_class(const std::vector<SvgElement>& all,
                                        std::string_view shape) {
    std::vector<SvgElement> out;
    for (const auto& each : all) {
        if (each.shape() == shape && each.group != "legend") out.push_back(each);
    }
    return out;
}

/// Corners of a path made of SvgPath's commands. Each move command begins a new piece.
inline std::vector<std::vector<PicturePoint>> corners(const SvgElement& path) {
    std::vector<std::vector<PicturePoint>> out;
    const std::string& data = path.attributes.at("d");
    const char *at = data.data(), *end = at + data.size();
    const auto number = [&] {
        double v = 0;
        at = std::from_chars(at + 1, end, v).ptr;
        return v;
    };
    PicturePoint p;
    while (at != end) {
        const char command = *at;
        if (command == 'Z') {
            ++at;
            continue;
        }
        if (command != 'V') p.x = number();
        if (command != 'H') p.y = number();
        if (command == 'M') out.emplace_back();
        out.back().push_back(p);
    }
    return out;
}

/// Mean position of the corners of a mark.
inline PicturePoint middle(const SvgElement& mark) {
    PicturePoint sum;
    const auto points = corners(mark).at(0);
    for (const auto& p : points) {
        sum.x += p.x;
        sum.y += p.y;
    }
    const auto count = static_cast<double>(points.size());
    return {sum.x / count, sum.y / count};
}

}  // namespace rovernet::test
