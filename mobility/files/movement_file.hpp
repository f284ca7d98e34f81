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

/// Command for one robot in a movement file.
struct MovementCommand {
    enum class Kind : std::uint8_t {
        appear,  ///< robot is at `to` from now on, with its radio on
        go,      ///< robot moves straight to `to` at `speed`; speed 0 stops it
        reach,   ///< robot moves straight to `to`, where it arrives at `arrival`
        vanish,  ///< robot is absent from now on, with its radio off
    };
    Time time;
    std::uint32_t robot;  ///< index into MovementFile::robots()
    Kind kind;
    Vec3 to = {};       ///< goal, or position at which the robot appears [m]
    double speed = 0;   ///< speed [m/s], >= 0, for `go`
    Time arrival = {};  ///< time of arrival, after `time`, for `reach`
};

/// Latest possible end of a run: 1e9 s. A movement file that continues after this time can only be
/// played in part.
inline constexpr Time last_of_run = start_of_run + Duration{1'000'000'000'000'000'000};

/// Robot named in a movement file.
struct FileRobot {
    std::string name;  ///< name: "n0" for node_(0) of ns-2 or line 1 of BonnMotion; for SUMO the id
    Vec3 start;        ///< first position of the robot [m]
    Time appears = start_of_run;
};

/// Handling of invalid lines in a movement file.
enum class MovementSyntax {
    strict,    ///< an invalid line is an error
    tolerant,  ///< invalid lines are skipped, with one notice for all
};

/// File of movements, read command by command in order of time.
///
/// Formats: ns-2 movement files (setdest), BonnMotion's .movements and .movements.gz (2-D or 3-D by
/// the file NAME.params beside it, otherwise by the number of columns), SUMO's FCD XML. The format
/// is recognised by the first bytes, not by the name. A file in order of time is streamed, with
/// memory proportional to the number of robots; any other file needs up to 40 bytes per leg, and a
/// notice reports it.
class MovementFile {
  public:
    /// Reads the whole file once, so that all its errors are reported now.
    /// @throws InputError with file, line and column
    explicit MovementFile(const std::string& path, MovementSyntax syntax = MovementSyntax::strict);
    ~MovementFile();
    MovementFile(MovementFile&&) noexcept;
    MovementFile& operator=(MovementFile&&) noexcept;

    const std::vector<FileRobot>& robots() const;
    const std::vector<std::string>& notices() const;
    /// Time at which the last command of the file ends.
    Time end() const;
    /// Place of the last command in the file, if end() is after last_of_run; otherwise only the
    /// file's name.
    const Location& end_where() const;

    /// Next command, in order of time, then of position in the file; empty at the end.
    std::optional<MovementCommand> next();

    struct Reader;

  private:
    std::unique_ptr<Reader> reader_;
};

}  // namespace rovernet
