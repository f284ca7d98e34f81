// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace rovernet {

/// What a path leads to, as far as it can be read.
enum class InputKind {
    file,     ///< regular file
    stream,   ///< pipe, FIFO or terminal, to be read once; /dev/null, too
    nothing,  ///< no such file
    loop,     ///< links that lead to one another
    closed,   ///< a folder on the way there may not be entered, or a name is too long
    folder,
    device,  ///< any other device, such as /dev/zero: it may have no end
    socket,
};

InputKind input_kind(const std::string& path);
/// What is wrong with a path that is neither a file nor a stream: "is a folder", "no such file".
std::string_view fault_of(InputKind kind);

/// Whether the path leads nowhere.
constexpr bool is_no_path(InputKind kind) {
    return kind == InputKind::nothing || kind == InputKind::loop || kind == InputKind::closed;
}

/// A file or stream that is open for reading; it is closed with its object.
class InputFile {
  public:
    /// Opens it. A FIFO gets 5 s in which somebody has to open it for writing.
    /// @throws InputError that says what is wrong with the path
    explicit InputFile(const std::string& path);
    ~InputFile();
    InputFile(const InputFile&) = delete;

    /// Hands its descriptor over.
    int release();
    /// Reads bytes; fewer than `most` at the end only. @throws InputError if it cannot be read
    std::string read(std::size_t most);

  private:
    void wait_for_writer() const;
    [[noreturn]] void fail(std::string_view what) const;

    std::string path_;
    int file_ = -1;
};

/// @throws InputError that says what is wrong, unless the path leads to a regular file
void need_file(const std::string& path);

}  // namespace rovernet
