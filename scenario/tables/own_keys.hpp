// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"

namespace rovernet {

/// Copy of a [propagation] or [reception] table without the keys that its model does not use.
Table own_keys_of_propagation(const Table& propagation);
Table own_keys_of_reception(const Table& reception);

}  // namespace rovernet
