// SPDX-License-Identifier: MIT
#include "files/text_source.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <limits>

namespace rovernet {
namespace {

constexpr std::size_t portion = 64 * 1024;  // [bytes] read at once
constexpr unsigned packed_portion = 16 * 1024;

}  // namespace

void TextSource::Close::operator()(gzFile_s* file) const { gzclose(file); }

TextSource::TextSource(const std::string& path) : name_(path), buffer_(portion) {
    std::error_code ignored;
    const auto status = std::filesystem::status(path, ignored);
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
        fail("is not a file; a movement file is read twice, so it has to be one");
    }
    errno = 0;
    file_.reset(gzopen(path.c_str(), "rb"));
    if (!file_) fail(fmt::format("cannot open the file: {}", std::strerror(errno)));
    gzbuffer(file_.get(), packed_portion);
    skip_mark();
}

bool TextSource::more() {
    if (at_end_) return false;
    const std::size_t rest = end_ - begin_;
    std::memmove(buffer_.data(), buffer_.data() + begin_, rest);
    before_buffer_ += begin_;
    begin_ = 0;
    end_ = rest;
    if (buffer_.size() < rest + portion) buffer_.resize(rest + portion);
    const int n = gzread(file_.get(), buffer_.data() + rest, static_cast<unsigned>(portion));
    if (n < static_cast<int>(portion)) {
        int error = Z_OK;
        const char* reason = gzerror(file_.get(), &error);
        if (error == Z_ERRNO) reason = std::strerror(errno);
        if (error != Z_OK) fail(fmt::format("cannot read the file: {}", reason));
    }
    at_end_ = n <= 0;
    end_ += n > 0 ? static_cast<std::size_t>(n) : 0;
    return !at_end_;
}

void TextSource::rewind() {
    if (gzrewind(file_.get()) != 0) fail("cannot read the file a second time");
    begin_ = end_ = 0;
    before_buffer_ = 0;
    at_end_ = false;
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
        throw InputError(where_, fmt::format("a line is longer than {} bytes", longest));
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
