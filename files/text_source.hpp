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

/// The bytes of a file, unpacked if it is a gzip or a zstd file, in portions: memory does not grow
/// with it. A byte order mark of UTF-8 is not among them.
class TextSource {
  public:
    /// How often the source is read: one that is read once may be a pipe.
    enum class Reads { once, twice };

    /// @throws InputError if `path` is no file that can be read; later calls too, if it is damaged
    explicit TextSource(const std::string& path, Reads reads = Reads::twice);
    /// Text that is made piece by piece, and read once.
    /// @param name  of the source, for errors
    /// @param next  called for the next piece, good until the next call; empty: there is no more
    TextSource(std::string name, std::function<std::string_view()> next)
        : name_(std::move(name)), next_(std::move(next)) {}

    /// Bytes that have been read and not yet taken; valid until the next call of more().
    std::string_view window() const { return {buffer_.data() + begin_, end_ - begin_}; }
    /// Makes the window longer; it moves. False at the end of the file.
    bool more();
    /// Makes the window at least `bytes` long, or all that is left of the file.
    void ensure(std::size_t bytes) {
        while (end_ - begin_ < bytes && more()) continue;
    }
    /// Moves the window's begin; n <= window().size().
    void take(std::size_t n) { begin_ += n; }
    /// Number of bytes that have been taken since the start.
    std::uint64_t taken() const { return before_buffer_ + begin_; }
    /// Back to the start of a file; of one alone.
    void rewind();

    const std::string& name() const { return name_; }

  private:
    void skip_mark();
    std::size_t read_file(char* out, std::size_t most);
    std::size_t unpack(char* out, std::size_t most);
    void detect_zstd();
    [[noreturn]] void fail(const std::string& message) const;

    struct Close {
        void operator()(gzFile_s* file) const;
        void operator()(ZSTD_DCtx_s* context) const;
    };
    /// Bytes of a zstd file that have been read and not yet unpacked.
    struct Packed {
        std::unique_ptr<ZSTD_DCtx_s, Close> context;
        std::vector<char> bytes;
        std::size_t begin = 0;
        std::size_t end = 0;
        bool in_frame = false;  ///< the file must not end here
    };
    std::string name_;
    std::function<std::string_view()> next_;  ///< makes the text; empty: file_ has it
    std::unique_ptr<gzFile_s, Close> file_;
    std::unique_ptr<Packed> zstd_;  ///< if it is a zstd file
    std::vector<char> buffer_;
    std::size_t begin_ = 0;
    std::size_t end_ = 0;
    std::uint64_t before_buffer_ = 0;
    bool at_end_ = false;
};

/// The lines of a file.
class TextLines {
  public:
    static constexpr std::size_t longest = 64 * 1024;  ///< [bytes]

    explicit TextLines(TextSource source)
        : source_(std::move(source)), where_{.source = source_.name(), .line = 0, .column = 1} {}

    /// The next line without its end, LF or CR LF; nothing after the last. Valid until the next
    /// call.
    /// @throws InputError if a line is longer than `longest`
    std::optional<std::string_view> next();
    /// Back to the first line.
    void rewind();
    /// The line that next() gave last.
    const Location& where() const { return where_; }

  private:
    TextSource source_;
    Location where_;
    std::size_t last_ = 0;  ///< bytes of the last line
};

}  // namespace rovernet
