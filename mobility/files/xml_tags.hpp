// SPDX-License-Identifier: MIT
#pragma once

#include "files/text_source.hpp"
#include "files/word.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// Streaming parser for the tags of an XML file with elements and attributes, without text between
/// the tags. Memory does not grow with the file. Comments and processing instructions are skipped;
/// a document type and CDATA are errors. UTF-8 or ASCII.
class XmlTags {
  public:
    enum class Kind { open, close, end_of_file };

    explicit XmlTags(TextSource source)
        : source_(std::move(source)), where_{.source = source_.name(), .line = 1, .column = 1} {}

    /// Reads the next tag; an empty element `<a/>` gives two tags, open and close. name() and
    /// value() refer to this tag, until the next call.
    /// @throws InputError if the file is not well-formed, a tag is longer than 64 KiB or has more
    ///         than 64 attributes, or elements are nested deeper than 64
    Kind next();
    /// Skips to the end of the element whose open tag was read last.
    void skip_element();
    void rewind();

    std::string_view name() const { return name_; }
    /// Value of an attribute of the last tag, with character references resolved; valid until the
    /// next call.
    std::optional<Word> value(std::string_view attribute);
    /// Beginnings of the comments before the first element.
    const std::string& head_comments() const { return head_comments_; }
    /// Place of the last tag in the file; after a call of value(), the line of that value.
    const Location& where() const { return where_; }
    const std::string& source() const { return source_.name(); }

  private:
    struct Attribute {
        std::string_view name;
        std::string_view value;  // text as in the file
    };

    bool find_tag();
    void keep_head_comment();
    void skip_past(std::string_view end, std::size_t from);
    std::string_view tag();
    void advance(std::size_t bytes);
    void parse_open(std::string_view text);
    std::size_t parse_attribute(std::string_view text, std::size_t at);
    void parse_close(std::string_view text);
    Kind close_file();
    Word word_at(std::string_view text);
    std::string_view resolved(Word value);
    [[noreturn]] void fail(std::string_view found, std::string_view expected);

    TextSource source_;
    int line_ = 1;                  ///< number of the line at the first byte of the window
    std::uint64_t line_start_ = 0;  ///< number of bytes of the file before line `line_`
    std::size_t length_ = 0;        ///< length of the last tag, at the start of the window [bytes]

    Location where_;
    std::string_view name_;
    std::vector<Attribute> attributes_;
    bool empty_ = false;  ///< true if the close tag of an empty element is still to come
    std::vector<std::string> open_;
    bool had_root_ = false;
    std::string resolved_;
    std::string head_comments_;
};

}  // namespace rovernet
