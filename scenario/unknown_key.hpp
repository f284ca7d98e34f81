// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/tables/reader.hpp"

namespace rovernet {

/// Error about an unknown key of a scenario. If other tables of a scenario have this key, the
/// message names these tables.
InputError with_tables(const UnknownKey& fault);

}  // namespace rovernet
