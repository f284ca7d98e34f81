// SPDX-License-Identifier: MIT
#pragma once

#include "files/text_source.hpp"
#include "mobility/files/movement_file.hpp"

#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// Reader of a movement file in one format, for MovementFile. The constructor reads the whole file
/// once.
struct MovementFile::Reader {
    virtual ~Reader() = default;
    virtual std::optional<MovementCommand> next() = 0;

    std::vector<FileRobot> robots;
    std::vector<std::string> notices;
    Time end = start_of_run;
    Location end_where = {};  ///< place of the last command; only set if `end` is after last_of_run
};

/// Text of the notice that `legs` legs (pieces of movement) of a file are stored in memory.
std::string kept_notice(const std::string& file, std::uint64_t legs);

/// Reports that a file has changed since it was first read. @throws InputError, always
[[noreturn]] void fail_changed(const std::string& file);

}  // namespace rovernet
