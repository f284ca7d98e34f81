// SPDX-License-Identifier: MIT
#pragma once

#include "sim/record.hpp"

#include <string>

namespace rovernet {

/// Appends a record as lines of text, for people and for comparisons: its time [ns], its kind, then
/// its fields in the order of docs/formats/trace-format.md, with the uid of a message instead of
/// its slot. A Received has one line per reception. Two records that are equal in a recorded trace
/// have the same text.
///
///     2000193 Received 0 4 2 1 - 0 0 7 waiting+
///
/// In this example the message with uid 0 comes from robot 4 with ttl 2 over 1 hop, for everyone,
/// and is delivered at robot 7.
void append_text(const Record& record, const RecordContext& context, std::string& text);

}  // namespace rovernet
