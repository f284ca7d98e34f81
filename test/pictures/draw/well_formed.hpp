// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet::test {

/// Checker of XML documents that consist of elements, attributes and text.
class XmlCheck {
  public:
    explicit XmlCheck(std::string_view text) : rest_(text) {}

    /// Description of the first fault; empty if the document is well-formed.
    std::string fault() {
        skip_declaration();
        bool any = false;
        while (fault_.empty() && !rest_.empty()) {
            if (!rest_.starts_with('<')) {
                text();
            } else if (any && open_.empty()) {
                fault_ = "a second root";
            } else {
                any = true;
                tag();
            }
        }
        if (fault_.empty() && !open_.empty()) fault_ = "<" + open_.back() + "> is not closed";
        if (fault_.empty() && !any) fault_ = "no element";
        return fault_;
    }

  private:
    void skip_declaration() {
        if (rest_.starts_with("<?xml ")) rest_.remove_prefix(rest_.find("?>") + 2);
    }
    void text() {
        const auto part = rest_.substr(0, rest_.find('<'));
        if (open_.empty() && part.find_first_not_of("\n ") != part.npos) fault_ = "text outside";
        check_characters(part);
        rest_.remove_prefix(part.size());
    }
    void tag() {
        const auto end = rest_.find('>');
        if (end == rest_.npos) {
            fault_ = "a tag without end";
            return;
        }
        std::string_view inside = rest_.substr(1, end - 1);
        rest_.remove_prefix(end + 1);
        if (inside.starts_with('/')) {
            close(inside.substr(1));
            return;
        }
        const bool empty = inside.ends_with('/');
        if (empty) inside.remove_suffix(1);
        const auto name = inside.substr(0, inside.find(' '));
        if (name.empty()) fault_ = "a tag without name";
        attributes(inside.substr(name.size()));
        if (!empty) open_.emplace_back(name);
    }
    void close(std::string_view name) {
        if (open_.empty() || open_.back() != name) {
            fault_ = "</" + std::string(name) + "> closes nothing";
        } else {
            open_.pop_back();
        }
    }
    void attributes(std::string_view list) {
        std::vector<std::string_view> names;
        while (!list.empty() && fault_.empty()) {
            const auto equals = list.find("=\"");
            const auto end = equals == list.npos ? list.npos : list.find('"', equals + 2);
            if (!list.starts_with(' ') || end == list.npos) {
                fault_ = "attributes: " + std::string(list.substr(0, 40));
                return;
            }
            const auto name = list.substr(1, equals - 1);
            if (std::find(names.begin(), names.end(), name) != names.end()) fault_ = "twice";
            names.push_back(name);
            check_characters(list.substr(equals + 2, end - equals - 2));
            list.remove_prefix(end + 1);
        }
    }
    void check_characters(std::string_view part) {
        for (std::size_t i = 0; i < part.size(); ++i) {
            const auto c = static_cast<unsigned char>(part[i]);
            if (c == '<' || (c < 0x20 && c != '\n')) fault_ = "a character that may not be there";
            if (c != '&') continue;
            const auto entity = part.substr(i, part.find(';', i) - i);
            const bool known = entity == "&amp" || entity == "&lt" || entity == "&gt" ||
                               entity == "&quot" || entity == "&#39";
            if (!known) fault_ = "an entity: " + std::string(entity.substr(0, 10));
        }
    }

    std::string_view rest_;
    std::vector<std::string> open_{};
    std::string fault_{};
};

/// Description of the first fault of an XML document; empty if the document is well-formed.
inline std::string xml_fault(std::string_view text) { return XmlCheck(text).fault(); }

}  // namespace rovernet::test
