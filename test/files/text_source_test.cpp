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

TEST_CASE("text source: a file packed by zstd is the same text, whatever its name, twice") {
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

TEST_CASE("text source: frames of zstd one after the other are one text") {
    const TempFolder folder;
    write_file(folder / "text", packed_by_zstd("one\n") + packed_by_zstd("two\n"));
    TextSource source(folder / "text", TextSource::Reads::once);
    CHECK(all_of(source) == "one\ntwo\n");
}

TEST_CASE("text source: a zstd file that is cut or damaged is an error, not a shorter text") {
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

}  // namespace text_source_test
