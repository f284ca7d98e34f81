// SPDX-License-Identifier: MIT
#pragma once

#include "files/text_source.hpp"
#include "mobility/files/movement_file.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// Reader of one kind of file, for MovementFile. When it is made, it has read the file through.
struct MovementFile::Reader {
    virtual ~Reader() = default;
    virtual std::optional<MovementCommand> next() = 0;

    std::vector<FileRobot> robots;
    std::vector<std::string> notices;
    Time end = start_of_run;
    Location end_where = {};  ///< set if `end` is after last_of_run
};

/// The notice that says that `legs` legs of a file are in memory.
std::string kept_notice(const std::string& file, std::uint64_t legs);

/// @throws InputError, always: the file is not the one that was read before
[[noreturn]] void fail_changed(const std::string& file);

}  // namespace rovernet
