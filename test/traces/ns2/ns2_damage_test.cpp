// SPDX-License-Identifier: MIT
#include "sim/error.hpp"
#include "test/traces/record_stream.hpp"
#include "traces/ns2/ns2_reader.hpp"
#include "traces/ns2/ns2_stats.hpp"
#include "traces/ns2/ns2_trace.hpp"

#include <doctest/doctest.h>

#include <cstddef>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

namespace ns2_damage_test {
using namespace rovernet;
using namespace rovernet::testing;

namespace {

std::string sample(Ns2Format format) {
    const TempFolder folder;
    Stream stream;
    const auto trace = std::make_shared<Ns2Trace>(folder / "run.tr", format, MacTrace::on);
    stream.sinks = {trace};
    RandomRecords(stream, 2).run(6, 120);
    trace->close();
    return content(folder / "run.tr");
}

/// Lines as anybody counts them: ends of line, and a last line without one.
std::uint64_t lines_in(const std::string& text) {
    std::uint64_t lines = 0;
    for (const char c : text) lines += c == '\n' ? 1 : 0;
    return lines + (!text.empty() && text.back() != '\n' ? 1 : 0);
}

std::size_t middle_line(const std::string& text) { return text.find('\n', text.size() / 2) + 1; }

std::string with(std::string text, std::size_t at_byte, const std::string& what) {
    return text.insert(at_byte, what);
}

/// Places in a line of the middle at which a file may be cut: within the event, the time, the
/// robot, the layer, the bracket, at its end, between CR and LF.
std::vector<std::string> truncated(const std::string& text) {
    const std::size_t begin = middle_line(text), end = text.find('\n', begin);
    std::vector<std::string> all;
    for (const std::size_t at_byte :
         {std::size_t{0}, std::size_t{1}, begin, begin + 1, begin + 2, begin + 8,
          begin + (end - begin) / 4, begin + (end - begin) / 2, end - 1, end}) {
        all.push_back(text.substr(0, at_byte));
    }
    return all;
}

std::vector<std::string> damaged(const std::string& text) {
    const std::size_t begin = middle_line(text);
    std::string flipped = text, every_bit = text, dos = text, zeros = text;
    flipped[begin + 3] = static_cast<char>(flipped[begin + 3] ^ 0x40);
    for (std::size_t i = 11; i < text.size(); i += 97) {
        every_bit[i] = static_cast<char>(every_bit[i] ^ (1 << (i % 7)));
    }
    for (std::size_t i = 0; (i = dos.find('\n', i)) != dos.npos; i += 2) dos.insert(i, 1, '\r');
    for (std::size_t i = begin; i < begin + 40; ++i) zeros[i] = '\0';
    return {flipped,
            every_bit,
            dos,
            zeros,
            with(text, begin + 2, std::string(30, '9')),
            with(text, begin + 10, std::string(60'000, '8')),
            with(text, begin, std::string(10'000'000, 'x') + "\n"),
            with(text, begin, "s " + std::string(10'000'000, '1') + "\n"),
            with(text, begin, std::string(10'000'000, '\0')),
            with(text, begin + 1, std::string(200'000, ' ')),
            with(text, begin, "\xff\xfe\n")};
}

}  // namespace

TEST_CASE("damaged trace: every line is counted once, whatever it contains") {
    for (const auto format : {Ns2Format::old_format, Ns2Format::new_format}) {
        const std::string text = sample(format);
        std::vector<std::string> all = truncated(text);
        for (auto& more : damaged(text)) all.push_back(std::move(more));
        REQUIRE(all.size() >= 20);
        for (std::size_t i = 0; i < all.size(); ++i) {
            CAPTURE(i);
            const TempFolder folder;
            write_file(folder / "run.tr", all[i]);
            Ns2Counts counts;
            try {
                counts = ns2_stats(folder / "run.tr").counts;
            } catch (const InputError&) {
                CHECK(i == 1);  // a single byte is no trace
                continue;
            }
            CHECK(counts.lines == lines_in(all[i]));
            CHECK(counts.lines == std::accumulate(counts.skipped.begin(), counts.skipped.end(),
                                                  counts.events + counts.refused));
        }
    }
}

TEST_CASE("damaged trace: a broken line does not affect other lines") {
    for (const auto format : {Ns2Format::old_format, Ns2Format::new_format}) {
        const std::string text = sample(format);
        const TempFolder folder;
        write_file(folder / "run.tr", text);
        const auto whole = ns2_stats(folder / "run.tr");
        REQUIRE(whole.counts.refused == 0);
        for (const std::string& line : {std::string(10'000'000, 'x'), std::string("s 1.0 _"),
                                        std::string("r\0 1.0", 6), std::string(65'537, ' ')}) {
            write_file(folder / "run.tr", with(text, middle_line(text), line + "\n"));
            const auto read = ns2_stats(folder / "run.tr");
            CHECK(read.counts.refused == 1);
            CHECK(read.counts.lines == whole.counts.lines + 1);
            CHECK(read.counts.refused_lines[0].line ==
                  lines_in(text.substr(0, middle_line(text))) + 1);
            CHECK(read.metrics == whole.metrics);
            CHECK_THROWS_AS(ns2_stats(folder / "run.tr", Ns2Strictness::strict), InputError);
        }
    }
}

}  // namespace ns2_damage_test
