// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"
#include "scene/scanner.hpp"

#include <vector>

namespace rovernet {

/// Reads the key `scan` of a robot: a table, or a list of tables for several range finders. A range
/// finder without a name is named after its kind, and numbered from the second on: laser, laser1,
/// laser2.
/// @throws InputError for an unknown key, a wrong type, a value out of range, keys that exclude
/// each other, or two range finders of the same name
std::vector<Scanner> read_scanners(const Value& value);

/// Converts range finders to a table, or to a list of tables: the inverse of read_scanners().
/// @param scanners  at least one
Value scanners_document(const std::vector<Scanner>& scanners);

}  // namespace rovernet
