// SPDX-License-Identifier: MIT
#pragma once

#include "sim/record.hpp"
#include "traces/recorded/record_code.hpp"

namespace rovernet {

/// Whether two records are equal in all data of a recorded trace, bit for bit. True only if
/// append_text() gives the same text for both; may be false for equal texts, such as those of two
/// Received without receptions.
/// @param format  format of the traces, or the older format of two traces; data that this format
///                lacks is not compared
bool are_same(const Record& a, const RecordContext& of_a, const Record& b,
              const RecordContext& of_b, unsigned format = recorded_format);

}  // namespace rovernet
