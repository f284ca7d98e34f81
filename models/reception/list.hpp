// SPDX-License-Identifier: MIT
#pragma once

// Reception models: what becomes of a frame at a receiver that it reaches, in the order of their
// cost.
//   threshold  it is received
//   collision  it is lost if another overlaps, unless it is much stronger
//   sinr       its bits are right or wrong by the ratio of signal to noise and interference
// Include this to choose one in code; scenario/reception_table.hpp has their words.
#include "models/reception/collision.hpp"
#include "models/reception/judge.hpp"
#include "models/reception/sinr.hpp"
