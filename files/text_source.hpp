// SPDX-License-Identifier: MIT
#pragma once

#include "sim/error.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

struct gzFile_s;
struct ZSTD_DCtx_s;

namespace rovernet {

/// Kind of a file that is not UTF-8 text, for an error, such as "the file is compressed by xz"; ""
/// for UTF-8 text.
/// @param begin  first 512 bytes of the file, or the whole file if shorter
std::string_view foreign_kind(std::string_view begin);

/// Reader of the bytes of a text file in portions, so that memory does not grow with the file. gzip
/// and zstd files are unpacked. A UTF-8 byte order mark is skipped. Files of other packers, UTF-16
/// text and binary files are refused.
class TextSource {
  public:
    /// Number of times that the source is read: a pipe can be read only once.
    enum class Reads { once, twice };

    /// @throws InputError if `path` is not a readable file; later calls throw an InputError if the
    ///         file is damaged
    explicit TextSource(const std::string& path, Reads reads = Reads::twice);
    /// Constructor for a text that is generated piece by piece, and can be read only once.
    /// @param name  name of the source, for error messages
    /// @param next  returns the next piece, valid until the next call; empty at the end
    TextSource(std::string name, std::function<std::string_view()> next)
        : name_(std::move(name)), next_(std::move(next)) {}

    /// Bytes that were read and not yet consumed; valid until the next call of more().
    std::string_view window() const { return {buffer_.data() + begin_, end_ - begin_}; }
    /// Appends more bytes of the file to window(), whose bytes may move in memory. @return false at
    /// the end of the file
    bool more();
    /// Reads until window() has at least `bytes` bytes, or the file ends.
    void ensure(std::size_t bytes) {
        while (end_ - begin_ < bytes && more()) continue;
    }
    /// Consumes the first n bytes of window(); n <= window().size().
    void take(std::size_t n) { begin_ += n; }
    /// Number of bytes consumed since the start of the text.
    std::uint64_t taken() const { return before_buffer_ + begin_; }
    /// Returns to the start of the file. Not allowed for generated text.
    void rewind();

    const std::string& name() const { return name_; }

  private:
    void refuse_foreign() const;
    void skip_mark();
    std::size_t read_file(char* out, std::size_t most);
    std::size_t unpack(char* out, std::size_t most);
    void detect_zstd();
    [[noreturn]] void fail(const std::string& message) const;

    struct Close {
        void operator()(gzFile_s* file) const;
        void operator()(ZSTD_DCtx_s* context) const;
    };
    /// Bytes of a zstd file that were read and not yet unpacked.
    struct Packed {
        std::unique_ptr<ZSTD_DCtx_s, Close> context;
        std::vector<char> bytes;
        std::size_t begin = 0;
        std::size_t end = 0;
        bool in_frame = false;  ///< true inside a zstd frame; the file must not end inside a frame
    };
    std::string name_;
    std::function<std::string_view()> next_;  ///< generates the text; empty if file_ is the source
    std::unique_ptr<gzFile_s, Close> file_;
    std::unique_ptr<Packed> zstd_;  ///< state of unpacking; null unless the file is packed by zstd
    std::vector<char> buffer_;
    std::size_t begin_ = 0;
    std::size_t end_ = 0;
    std::uint64_t before_buffer_ = 0;
    bool at_end_ = false;
};

/// Reader of the lines of a text file.
class TextLines {
  public:
    static constexpr std::size_t longest = 64 * 1024;  ///< largest allowed length of a line [bytes]

    explicit TextLines(TextSource source)
        : source_(std::move(source)), where_{.source = source_.name(), .line = 0, .column = 1} {}

    /// Next line without its end (LF or CR LF); empty optional after the last line. Valid until the
    /// next call.
    /// @throws InputError if a line is longer than `longest`
    std::optional<std::string_view> next();
    /// Returns to the first line.
    void rewind();
    /// Place in the file of the last line that next() returned.
    const Location& where() const { return where_; }

  private:
    TextSource source_;
    Location where_;
    std::size_t last_ = 0;  ///< length of the last line, with its end [bytes]
};

}  // namespace rovernet
