// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace rovernet {

/// Kind of file-system object at a path that is to be read.
enum class InputKind {
    file,     ///< regular file
    stream,   ///< pipe, FIFO or terminal, readable only once; also /dev/null
    nothing,  ///< no such file
    loop,     ///< symbolic links that form a loop
    closed,   ///< no permission to enter a folder of the path, or a name is too long
    folder,
    device,  ///< any other device, such as /dev/zero, which may be endless
    socket,
};

InputKind input_kind(const std::string& path);
/// Text of the error about a path that is neither a file nor a stream: "is a folder", "no such
/// file".
std::string_view fault_of(InputKind kind);

/// Whether a path of this kind leads to no file-system object: the object does not exist, or the
/// path cannot be followed.
constexpr bool is_no_path(InputKind kind) {
    return kind == InputKind::nothing || kind == InputKind::loop || kind == InputKind::closed;
}

/// File or stream that is open for reading; the destructor closes it.
class InputFile {
  public:
    /// Opens the path. If the path is a FIFO, waits up to 5 s until a program opens the FIFO for
    /// writing.
    /// @throws InputError if the path cannot be read
    explicit InputFile(const std::string& path);
    ~InputFile();
    InputFile(const InputFile&) = delete;

    /// Returns the file descriptor, which the caller then owns.
    int release();
    /// Reads `most` bytes, or fewer at the end of the file. @throws InputError if reading fails
    std::string read(std::size_t most);

  private:
    void wait_for_writer() const;
    [[noreturn]] void fail(std::string_view what) const;

    std::string path_;
    int file_ = -1;
};

/// Searches `folder` for a file that does not exist at the path `name`. Returns the file name (last
/// part of the path) if `folder` contains such a file, otherwise "". An error message can then
/// report a wrong folder instead of a missing file: a folder of a different machine, or `~`, which
/// only a shell expands. Backslashes also separate folders.
std::string named_beside(const std::string& folder, const std::string& name);

/// Checks that a path is a regular file. @throws InputError if it is not
void need_file(const std::string& path);

}  // namespace rovernet
