// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"
#include "scene/scanner.hpp"

#include <vector>

namespace rovernet {

/// Reads the `scan` of a robot: a table, or a list of tables for several range finders. The second
/// of a kind that has no name is called as its kind and 1, and so on.
/// @throws InputError for an unknown key, a wrong type, a value out of its range, keys that exclude
/// each other, and for two of one name
std::vector<Scanner> read_scanners(const Value& value);

/// Value that reads back as the same: one table, or a list of several.
/// @param scanners  at least one
Value scanners_document(const std::vector<Scanner>& scanners);

}  // namespace rovernet
