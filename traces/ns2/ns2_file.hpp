// SPDX-License-Identifier: MIT
#pragma once

#include "files/text_source.hpp"
#include "sim/error.hpp"
#include "traces/ns2/ns2_line.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rovernet {

/// Line that is not an ns-2 trace line, for an error message.
struct Ns2RefusedLine {
    std::uint64_t line = 0;  ///< line number, from 1
    int column = 1;
    std::string why;   ///< text found in the line, and text expected
    std::string text;  ///< start of the line; unprintable characters are replaced by '?'
};

/// Counts of a file's lines by kind: lines = events + all of `skipped` + refused.
struct Ns2Counts {
    std::uint64_t lines = 0;
    std::uint64_t events = 0;
    /// Number of skipped lines of each kind; the index is the kind, an Ns2Other.
    std::array<std::uint64_t, std::size(names_of_other)> skipped{};
    std::uint64_t refused = 0;
    std::vector<Ns2RefusedLine> refused_lines;  ///< first ten refused lines
    /// Flag of each trace format, true if the file has lines of the format; the index is the
    /// format, an Ns2Dialect.
    std::array<bool, 3> dialects{};

    /// Whether all lines are blank or comments.
    bool is_empty() const {
        return lines == skipped_of(Ns2Other::blank) + skipped_of(Ns2Other::comment);
    }
    std::uint64_t skipped_of(Ns2Other kind) const {
        return skipped[static_cast<std::size_t>(kind)];
    }
    /// Formats of the file, such as "old", "new+wired"; "none" if no line has a known format.
    std::string format() const;
};

/// Treatment of a line that is not an ns-2 trace line: count the line (tolerant), or throw
/// InputError (strict).
enum class Ns2Strictness { tolerant, strict };

/// Text of an ns-2 trace: a file, or text that a function generates.
struct Ns2Source : TextSource {
    /// Opens plain text, gzip or zstd, also from a pipe. @throws InputError if it cannot be read
    Ns2Source(const std::string& path) : TextSource(path, Reads::once) {}
    /// Constructor for a text that `next` generates piece by piece, see TextSource.
    Ns2Source(std::string name, std::function<std::string_view()> next)
        : TextSource(std::move(name), std::move(next)) {}
};

/// Reader of the events of an ns-2 trace, one after the other.
///
/// Memory does not grow with the file. A line of more than 64 KiB is refused; reading continues at
/// the next line.
class Ns2File {
  public:
    explicit Ns2File(Ns2Source source, Ns2Strictness = Ns2Strictness::tolerant);

    /// Next line that is an event: neither Ns2Other nor Ns2Refused; null after the last event.
    /// Valid until the next call.
    /// @throws InputError for a refused line, under Ns2Strictness::strict; and if the file is
    ///         damaged
    const Ns2Line* next();
    /// Refuses the event that next() returned last, because it is invalid at its place in the file.
    void refuse(int column, const std::string& why);

    /// Name of the file.
    const std::string& name() const { return source_.name(); }
    /// Text of the last line that was read, without the line's end.
    std::string_view text() const { return text_; }
    /// Number of the last line that was read, from 1.
    std::uint64_t line() const { return counts_.lines; }
    const Ns2Counts& counts() const { return counts_; }
    /// Checks a file that was read. @throws InputError if it has lines, but no ns-2 trace line
    void expect_trace() const;

    static constexpr std::size_t longest_line = 64 * 1024;  ///< longest line [bytes]

  private:
    bool next_text();
    void count_refused(int column, const std::string& why);
    void skip_long_line();
    Location place(std::uint64_t line, int column) const;

    Ns2Source source_;
    Ns2Strictness strictness_;
    Ns2Counts counts_;
    std::string_view text_;
    std::size_t taken_ = 0;  ///< length of the last line [bytes]
    bool is_long_ = false;   ///< true if text_ is the start of a line above longest_line
    Ns2Line line_;
};

}  // namespace rovernet
