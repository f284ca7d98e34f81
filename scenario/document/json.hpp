// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"

#include <string>
#include <string_view>

// Values as JSON: the output of --json, the files of a run's folder, the cells of a study's store.

namespace rovernet {

/// JSON document of a value: keys in their order, numbers in the fewest digits that read back the
/// same, two blanks of indentation, a newline at the end. NaN and infinity become null, and so does
/// an empty Value; bytes that are not UTF-8 become U+FFFD. Equal results give equal bytes.
std::string to_json(const Value& value);

/// JSON of a value in one line, without a newline.
std::string to_json_line(const Value& value);

/// Parses a JSON document; null becomes an empty Value, and no Value has a file position. Used for
/// JSON that rovernet wrote itself: a study's store, the measurement of a worker.
/// @throws InputError without a file position, if the text is not JSON or nests over 100 levels
Value parse_json(std::string_view text);

}  // namespace rovernet
