// SPDX-License-Identifier: MIT
#include "files/kept_inputs.hpp"

#include <algorithm>
#include <atomic>
#include <fstream>
#include <iterator>
#include <mutex>
#include <set>
#include <sys/stat.h>
#include <utility>

namespace rovernet {
namespace {

/// Device and number of a file: the same for all its names.
using FileId = std::pair<dev_t, ino_t>;

std::atomic<bool> keeps = false;
std::mutex access_to_kept;
std::set<FileId> kept;

}  // namespace

void keep_inputs() { keeps = true; }

void note_input(const std::string& path) {
    struct stat status {};
    if (!keeps || stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return;
    const std::lock_guard lock(access_to_kept);
    kept.insert({status.st_dev, status.st_ino});
}

bool is_kept_input(const std::string& path) {
    struct stat status {};
    // A rename replaces a link, not the file that it leads to.
    if (!keeps || lstat(path.c_str(), &status) != 0) return false;
    const std::lock_guard lock(access_to_kept);
    return kept.contains({status.st_dev, status.st_ino});
}

bool replaces_input(const std::string& path, std::istream& contents) {
    if (!is_kept_input(path)) return false;
    std::ifstream input(path, std::ios::binary);
    using Bytes = std::istreambuf_iterator<char>;
    return !std::equal(Bytes(contents), Bytes(), Bytes(input), Bytes());
}

}  // namespace rovernet
