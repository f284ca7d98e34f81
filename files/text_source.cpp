// SPDX-License-Identifier: MIT
#include "files/text_source.hpp"

#include "files/input_file.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iterator>
#include <limits>
#include <new>
#include <unistd.h>
#include <zstd.h>

namespace rovernet {
namespace {

constexpr std::size_t portion = 64 * 1024;  // [bytes] read at once
constexpr unsigned packed_portion = 16 * 1024;

/// Magic number of a file format that is not text.
struct Mark {
    std::size_t at;  ///< offset in the file
    std::string_view bytes;
    std::string_view what;
};
// Sources: the formats' specifications; of bzip2, lzip and compress their manuals' magic numbers.
constexpr Mark marks[] = {
    {0, {"\xfd\x37zXZ\0", 6}, "the file is compressed by xz"},
    {0, {"]\0\0", 3}, "the file is compressed by lzma"},
    {0, "BZh", "the file is compressed by bzip2"},
    {0, "7z\xbc\xaf\x27\x1c", "the file is an archive of 7-Zip"},
    {0, "PK\x03\x04", "the file is a ZIP archive"},
    {0, "Rar!\x1a\x07", "the file is a RAR archive"},
    {0, "\x04\x22\x4d\x18", "the file is compressed by lz4"},
    {0, "LZIP", "the file is compressed by lzip"},
    {0, "\x1f\x9d", "the file is compressed by the program compress"},
    {0, "\x1f\x8b", "the file is compressed by gzip"},
    {0, "\x28\xb5\x2f\xfd", "the file is compressed by zstd"},
    {257, "ustar", "the file is a tar archive"},
    {0, "\xff\xfe", "the file is in UTF-16"},
    {0, "\xfe\xff", "the file is in UTF-16"},
    {0, "\x89MCAP", "the file is a recorded trace (MCAP), which can be read only uncompressed"},
    {0, "\xd4\xc3\xb2\xa1", "the file is a capture (pcap)"},
    {0, "\xa1\xb2\xc3\xd4", "the file is a capture (pcap)"},
    {0, "\x0a\x0d\x0d\x0a", "the file is a capture (pcapng)"},
    {0, "SQLite format 3", "the file is a database of SQLite"},
    {0, "\x89PNG", "the file is a picture (PNG)"},
    {0, "%PDF-", "the file is a PDF document"}};
constexpr std::size_t longest_mark = 512;  // number of bytes searched for marks [bytes]

}  // namespace

std::string_view foreign_kind(std::string_view begin) {
    for (const Mark& mark : marks)
        if (begin.size() >= mark.at && begin.substr(mark.at).starts_with(mark.bytes))
            return mark.what;
    return "";
}

void TextSource::Close::operator()(gzFile_s* file) const { gzclose(file); }

void TextSource::Close::operator()(ZSTD_DCtx_s* context) const { ZSTD_freeDCtx(context); }

TextSource::TextSource(const std::string& path, Reads reads) : name_(path), buffer_(portion) {
    if (reads == Reads::twice && input_kind(path) == InputKind::stream) {
        fail("this is a pipe; expected a regular file, because a movement file is read twice");
    }
    InputFile input(path);
    const int descriptor = input.release();
    file_.reset(gzdopen(descriptor, "rb"));
    if (!file_) {
        close(descriptor);
        throw std::bad_alloc();
    }
    gzbuffer(file_.get(), packed_portion);
    detect_zstd();
    ensure(longest_mark);
    refuse_foreign();
    skip_mark();
}

/// Refuses files that are not text: a line reader might accept parts of them.
void TextSource::refuse_foreign() const {
    const std::string_view text = window().substr(0, longest_mark);
    std::string_view kind = foreign_kind(text);
    // One layer of packing is already removed.
    if (kind.ends_with("gzip") || kind.ends_with("zstd")) kind = "the file is compressed twice";
    if (!kind.empty())
        fail(fmt::format("{}; expected text in UTF-8, plain or compressed by gzip or zstd", kind));
    // A few such bytes may be damage, which the readers report with its place.
    constexpr std::ptrdiff_t part = 8, shortest = 16;
    if (std::ssize(text) < shortest ||
        part * std::count(text.begin(), text.end(), '\0') <= std::ssize(text))
        return;
    fail(
        "the file is not a text, because it has many NUL bytes; expected text in UTF-8, plain or "
        "compressed by gzip or zstd");
}

/// Detects zstd: data that zlib passes on unchanged may begin with zstd's magic number (RFC 8878,
/// 3.1.1).
void TextSource::detect_zstd() {
    constexpr std::string_view magic = "\x28\xb5\x2f\xfd";
    ensure(magic.size());
    if (!window().starts_with(magic)) return;
    zstd_ = std::make_unique<Packed>();
    Packed& packed = *zstd_;
    packed.context.reset(ZSTD_createDCtx());
    packed.bytes.assign(window().begin(), window().end());
    packed.end = packed.bytes.size();
    packed.bytes.resize(std::max(packed.bytes.size(), portion));
    begin_ = end_ = 0;
    before_buffer_ = 0;
    at_end_ = false;
}

std::size_t TextSource::read_file(char* out, std::size_t most) {
    const int n = gzread(file_.get(), out, static_cast<unsigned>(most));
    if (n < static_cast<int>(most)) {
        int error = Z_OK;
        std::string_view reason = gzerror(file_.get(), &error);
        if (error == Z_ERRNO) reason = std::strerror(errno);
        // zlib names the file by its descriptor: "<fd:3>: unexpected end of file".
        if (reason.starts_with("<fd:")) reason.remove_prefix(reason.find(' ') + 1);
        if (error != Z_OK) fail(fmt::format("cannot read the file: {}", reason));
    }
    return n > 0 ? static_cast<std::size_t>(n) : 0;
}

std::size_t TextSource::unpack(char* out, std::size_t most) {
    Packed& packed = *zstd_;
    ZSTD_outBuffer unpacked{out, most, 0};
    while (unpacked.pos == 0) {
        if (packed.begin == packed.end) {
            packed.begin = 0;
            packed.end = read_file(packed.bytes.data(), packed.bytes.size());
        }
        const bool at_end = packed.end == 0;
        if (at_end && !packed.in_frame) return 0;
        ZSTD_inBuffer input{packed.bytes.data(), packed.end, packed.begin};
        const std::size_t left = ZSTD_decompressStream(packed.context.get(), &unpacked, &input);
        packed.begin = input.pos;
        packed.in_frame = left != 0;
        if (ZSTD_isError(left)) {
            fail(fmt::format("cannot read the file: {}", ZSTD_getErrorName(left)));
        }
        if (at_end && unpacked.pos == 0) {
            fail("cannot read the file: it ends in the middle of its zstd data");
        }
    }
    return unpacked.pos;
}

bool TextSource::more() {
    if (at_end_) return false;
    const std::size_t rest = end_ - begin_;
    if (rest > 0) std::memmove(buffer_.data(), buffer_.data() + begin_, rest);
    before_buffer_ += begin_;
    begin_ = 0;
    end_ = rest;
    if (next_) {
        const std::string_view piece = next_();
        if (buffer_.size() < rest + piece.size()) buffer_.resize(rest + piece.size());
        std::copy(piece.begin(), piece.end(), buffer_.data() + rest);
        at_end_ = piece.empty();
        end_ += piece.size();
        return !at_end_;
    }
    if (buffer_.size() < rest + portion) buffer_.resize(rest + portion);
    char* out = buffer_.data() + rest;
    const std::size_t n = zstd_ ? unpack(out, portion) : read_file(out, portion);
    at_end_ = n == 0;
    end_ += n;
    return !at_end_;
}

void TextSource::rewind() {
    if (gzrewind(file_.get()) != 0) fail("cannot read the file a second time");
    begin_ = end_ = 0;
    before_buffer_ = 0;
    at_end_ = false;
    zstd_.reset();
    detect_zstd();
    skip_mark();
}

void TextSource::skip_mark() {
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    ensure(byte_order_mark.size());
    if (!window().starts_with(byte_order_mark)) return;
    take(byte_order_mark.size());
    before_buffer_ -= byte_order_mark.size();  // modulo 2^64: nothing has been taken yet
}

void TextSource::fail(const std::string& message) const {
    throw InputError({.source = name_}, message);
}

std::optional<std::string_view> TextLines::next() {
    source_.take(last_);
    last_ = 0;
    std::size_t scanned = 0;
    const void* found = nullptr;
    std::string_view text = source_.window();
    while (!(found = std::memchr(text.data() + scanned, '\n', text.size() - scanned)) &&
           text.size() <= longest) {
        scanned = text.size();
        const bool is_longer = source_.more();
        text = source_.window();  // more() moves it, also at the end
        if (!is_longer) break;
    }
    if (text.empty()) return std::nullopt;
    if (where_.line < std::numeric_limits<int>::max()) ++where_.line;
    last_ = text.size();
    if (found) {
        text =
            text.substr(0, static_cast<std::size_t>(static_cast<const char*>(found) - text.data()));
        last_ = text.size() + 1;
    }
    if (text.size() > longest) {
        throw InputError(where_, fmt::format("a line is longer than {} bytes, which is the limit; "
                                             "check that this is the right file",
                                             longest));
    }
    if (text.ends_with('\r')) text.remove_suffix(1);
    return text;
}

void TextLines::rewind() {
    source_.rewind();
    where_.line = 0;
    last_ = 0;
}

}  // namespace rovernet
