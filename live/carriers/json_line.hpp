// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <charconv>
#include <cstddef>
#include <cstring>
#include <string_view>

namespace rovernet {

/// Buffer for writing one JSON line piece by piece, faster than from a Table (tree of values): a
/// run may write thousands of lines per second. The buffer reuses its memory.
class JsonLine {
  public:
    void put(std::string_view text) {
        const std::size_t before = text_.size();
        text_.resize(before + text.size());
        std::memcpy(text_.data() + before, text.data(), text.size());
    }
    void put(char letter) { text_.push_back(letter); }
    /// Appends a number as the shortest text that reads back as the same number. @return this text
    /// @param number  must be finite
    template <class Number>
    std::string_view put_number(Number number) {
        constexpr std::size_t longest = 32;
        const std::size_t before = text_.size();
        text_.resize(before + longest);
        char* const begin = text_.data() + before;
        const auto size =
            static_cast<std::size_t>(std::to_chars(begin, begin + longest, number).ptr - begin);
        text_.resize(before + size);
        return {begin, size};
    }

    std::string_view text() const { return {text_.data(), text_.size()}; }
    void clear() { text_.clear(); }

  private:
    fmt::memory_buffer text_;
};

}  // namespace rovernet
