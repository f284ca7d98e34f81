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

/// A line that is none of ns-2, fit to be shown.
struct Ns2RefusedLine {
    std::uint64_t line = 0;  ///< number, from 1
    int column = 1;
    std::string why;   ///< what was found and what was expected
    std::string text;  ///< begin of the line; what cannot be printed is '?'
};

/// What the lines of a file were: lines = events + all of `skipped` + refused.
struct Ns2Counts {
    std::uint64_t lines = 0;
    std::uint64_t events = 0;
    std::array<std::uint64_t, std::size(names_of_other)> skipped{};  ///< by Ns2Other
    std::uint64_t refused = 0;
    std::vector<Ns2RefusedLine> refused_lines;  ///< the first ten
    std::array<bool, 3> dialects{};             ///< true: the file has such lines, by Ns2Dialect

    std::uint64_t skipped_of(Ns2Other kind) const {
        return skipped[static_cast<std::size_t>(kind)];
    }
    /// The formats that the file has, such as "old", "new+wired"; "none" if nothing tells.
    std::string format() const;
};

/// What becomes of a line that is none of ns-2: it is counted, or it is an InputError.
enum class Ns2Strictness { tolerant, strict };

/// Text of a trace: a file, or what somebody writes piece by piece.
struct Ns2Source : TextSource {
    /// Plain text, gzip or zstd; a pipe, too. @throws InputError if it cannot be read
    Ns2Source(const std::string& path) : TextSource(path, Reads::once) {}
    /// Text that `next` makes, see TextSource.
    Ns2Source(std::string name, std::function<std::string_view()> next)
        : TextSource(std::move(name), std::move(next)) {}
};

/// The events of an ns-2 trace, one after the other.
///
/// Memory does not grow with the file. A line of more than 64 KiB is refused, whatever it holds;
/// the lines behind it are read.
class Ns2File {
  public:
    explicit Ns2File(Ns2Source source, Ns2Strictness = Ns2Strictness::tolerant);

    /// The next line that is an event: neither Ns2Other nor Ns2Refused; nullptr after the last.
    /// Valid until the next call.
    /// @throws InputError if a line is refused, under Ns2Strictness::strict; if the file is damaged
    const Ns2Line* next();
    /// Refuses the event that came last after all, as it makes no sense at its place in the file.
    /// @throws InputError under Ns2Strictness::strict
    void refuse(int column, const std::string& why);

    /// Name of the file.
    const std::string& name() const { return source_.name(); }
    /// The line that came last, without its end.
    std::string_view text() const { return text_; }
    /// Its number, from 1.
    std::uint64_t line() const { return counts_.lines; }
    const Ns2Counts& counts() const { return counts_; }
    /// @throws InputError if the file has lines, and none of them is of ns-2
    void expect_trace() const;

    static constexpr std::size_t longest_line = 64 * 1024;  ///< [bytes]

  private:
    bool next_text();
    void count_refused(int column, const std::string& why);
    void skip_long_line();
    Location place(std::uint64_t line, int column) const;

    Ns2Source source_;
    Ns2Strictness strictness_;
    Ns2Counts counts_;
    std::string_view text_;
    std::size_t taken_ = 0;  ///< bytes of the last line
    bool is_long_ = false;   ///< text_ is the begin of a longer line
    Ns2Line line_;
};

}  // namespace rovernet
