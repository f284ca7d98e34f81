// SPDX-License-Identifier: MIT
#pragma once

#include "sim/error.hpp"
#include "sim/geometry.hpp"
#include "sim/time.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// Command of a movement file to one robot.
struct MovementCommand {
    enum class Kind : std::uint8_t {
        appear,  ///< is at `to` from now on, its radio on
        go,      ///< goes straight to `to` at `speed`; 0 stops it where it is
        reach,   ///< goes straight to `to`, which it reaches at `arrival`
        vanish,  ///< is gone: its radio off
    };
    Time time;
    std::uint32_t robot;  ///< index into MovementFile::robots()
    Kind kind;
    Vec3 to = {};       ///< [m]
    double speed = 0;   ///< [m/s], >= 0
    Time arrival = {};  ///< > time
};

/// End of the longest run, of 1e9 s: a file that goes on after it can be played in part only.
inline constexpr Time last_of_run = start_of_run + Duration{1'000'000'000'000'000'000};

/// A robot that a movement file names.
struct FileRobot {
    std::string
        name;    ///< "n0" for node_(0) of ns-2 and for the first line of BonnMotion; SUMO's id
    Vec3 start;  ///< [m] where it first is
    Time appears = start_of_run;
};

/// Strictness with which a movement file is read.
enum class MovementSyntax {
    strict,    ///< a line that means nothing is an error
    tolerant,  ///< a line that means nothing is left out, with one notice for all
};

/// A file of movements, read command by command in order of time.
///
/// ns-2 movement files (setdest), BonnMotion's .movements and .movements.gz (2-D and 3-D, told from
/// the file NAME.params beside it, or else from the number of columns), SUMO's FCD XML. The first
/// bytes decide the kind, not the name. A file in order of time is read as it goes, in memory
/// proportional to its robots; any other keeps at most 40 bytes a leg and says so in a notice.
class MovementFile {
  public:
    /// Reads the file through once: every mistake in it shows now.
    /// @throws InputError with file, line and column
    explicit MovementFile(const std::string& path, MovementSyntax syntax = MovementSyntax::strict);
    ~MovementFile();
    MovementFile(MovementFile&&) noexcept;
    MovementFile& operator=(MovementFile&&) noexcept;

    const std::vector<FileRobot>& robots() const;
    const std::vector<std::string>& notices() const;
    /// Time at which the last command ends.
    Time end() const;
    /// Place of that command in the file; the whole file unless it ends after the longest run.
    const Location& end_where() const;

    /// The next command, in order of time, then as in the file; none at the end.
    std::optional<MovementCommand> next();

    struct Reader;

  private:
    std::unique_ptr<Reader> reader_;
};

}  // namespace rovernet
