// SPDX-License-Identifier: MIT
#include "files/text_source.hpp"

#include "sim/error.hpp"
#include "test/traces/record_stream.hpp"

#include <doctest/doctest.h>

#include <string>
#include <zstd.h>

namespace text_source_test {
using namespace rovernet;
using namespace rovernet::testing;

namespace {

/// With a checksum, as the command zstd has it.
std::string packed_by_zstd(const std::string& text) {
    std::string bytes(ZSTD_compressBound(text.size()), '\0');
    ZSTD_CCtx* context = ZSTD_createCCtx();
    ZSTD_CCtx_setParameter(context, ZSTD_c_checksumFlag, 1);
    const std::size_t n =
        ZSTD_compress2(context, bytes.data(), bytes.size(), text.data(), text.size());
    ZSTD_freeCCtx(context);
    REQUIRE_FALSE(ZSTD_isError(n));
    bytes.resize(n);
    return bytes;
}

std::string all_of(TextSource& source) {
    std::string text;
    do {
        text += source.window();
        source.take(source.window().size());
    } while (source.more());
    return text;
}

std::string many_lines() {
    std::string text;
    for (int i = 0; i < 40'000; ++i) text += "line " + std::to_string(i * 7919 % 40'000) + "\n";
    return text;
}

}  // namespace

TEST_CASE(
    "text source: a zstd file is recognised under any file name, and can be read a second time") {
    const TempFolder folder;
    for (const std::string& text : {many_lines(), std::string("x"), std::string()}) {
        write_file(folder / "text", packed_by_zstd(text));
        TextSource source(folder / "text");
        CHECK(all_of(source) == text);
        source.rewind();
        CHECK(source.taken() == 0);
        CHECK(all_of(source) == text);
    }
}

TEST_CASE("text source: consecutive zstd frames give one text") {
    const TempFolder folder;
    write_file(folder / "text", packed_by_zstd("one\n") + packed_by_zstd("two\n"));
    TextSource source(folder / "text", TextSource::Reads::once);
    CHECK(all_of(source) == "one\ntwo\n");
}

TEST_CASE(
    "text source: a damaged or incomplete zstd file is refused instead of read as a shorter text") {
    const TempFolder folder;
    const std::string bytes = packed_by_zstd(many_lines());
    const auto error_of = [&](const std::string& content) -> std::string {
        write_file(folder / "text", content);
        try {
            TextSource source(folder / "text");
            all_of(source);
        } catch (const InputError& e) {
            return e.message();
        }
        return "";
    };
    CHECK(error_of(bytes) == "");
    for (const std::size_t n : {std::size_t{5}, bytes.size() / 2, bytes.size() - 1}) {
        CHECK(error_of(bytes.substr(0, n)).find("it ends in the middle") != std::string::npos);
    }
    std::string damaged = bytes;
    for (std::size_t i = 100; i < 200; ++i) damaged[i] = '\xff';
    CHECK(error_of(damaged).starts_with("cannot read the file: "));
}

TEST_CASE(
    "text source: the error for an unsupported compressed file, or a file without text, names the "
    "kind of file") {
    const TempFolder folder;
    const std::string tar = std::string("a.tr") + std::string(253, '\0') + "ustar  ";
    const std::vector<std::pair<std::string, std::string>> files = {
        {{"\xfd\x37zXZ\0\0", 7}, "xz"},
        {"BZh91AY&SY", "bzip2"},
        {"7z\xbc\xaf\x27\x1c", "7-Zip"},
        {"PK\x03\x04..", "ZIP"},
        {"\x04\x22\x4d\x18..", "lz4"},
        {"LZIP\x01", "lzip"},
        {"\x1f\x9d\x90", "compress"},
        {tar, "tar"},
        {{"]\0\0\x80\0", 5}, "lzma"},
        {{"\xff\xfes\0", 4}, "UTF-16"},
        {{"\xfe\xff\0s", 4}, "UTF-16"},
        {std::string("s\0 \0r\0 \0s\0 \0r\0 \0\n\0", 18), "NUL"},
        {{"\x89MCAP0\r\n", 8}, "recorded trace"},
        {{"\xd4\xc3\xb2\xa1\2\0", 6}, "pcap"}};
    for (const auto& each : files) {
        const std::string &bytes = each.first, &name = each.second;
        CAPTURE(name);
        write_file(folder / "in", bytes);
        std::string told;
        try {
            TextSource(folder / "in");
        } catch (const InputError& error) {
            told = error.what();
        }
        CHECK(told.find(name) != told.npos);
    }
    write_file(folder / "in", "\xef\xbb\xbfs 1");
    CHECK(TextSource(folder / "in").window() == "s 1");
    write_file(folder / "in", "\xc3\xa4");  // any letters
    CHECK(TextSource(folder / "in").window().size() == 2);
    write_file(folder / "in", "");
    CHECK(TextSource(folder / "in").window().empty());
}

}  // namespace text_source_test
