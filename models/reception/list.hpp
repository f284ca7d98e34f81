// SPDX-License-Identifier: MIT
#pragma once

// Reception models: fate of a frame at a receiver in range. In the order of their cost:
//   threshold  it is received
//   collision  it is lost if another frame overlaps, unless it is much stronger
//   sinr       its bits are right or wrong by the ratio of signal to noise and interference
// Include this to choose a model in code; scenario/tables/reception_table.hpp has their names in
// files.
#include "models/reception/collision.hpp"
#include "models/reception/judge.hpp"
#include "models/reception/sinr.hpp"
