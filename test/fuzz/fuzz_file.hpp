// SPDX-License-Identifier: MIT
#pragma once

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <sys/mman.h>
#include <unistd.h>

namespace rovernet::test {

/// File in memory with the given bytes, for readers that need a path; removed by the destructor.
class FuzzFile {
  public:
    FuzzFile(const std::uint8_t* bytes, std::size_t size) : file_(memfd_create("fuzz", 0)) {
        if (file_ < 0) std::abort();
        for (std::size_t done = 0; done < size;) {
            const ssize_t n = write(file_, bytes + done, size - done);
            if (n < 0 && errno != EINTR) std::abort();
            if (n > 0) done += static_cast<std::size_t>(n);
        }
    }
    ~FuzzFile() { close(file_); }
    FuzzFile(const FuzzFile&) = delete;
    FuzzFile& operator=(const FuzzFile&) = delete;

    std::string path() const { return "/proc/self/fd/" + std::to_string(file_); }

  private:
    int file_;
};

}  // namespace rovernet::test
