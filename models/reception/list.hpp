// SPDX-License-Identifier: MIT
#pragma once

// Reception models: what becomes of a frame at a receiver that it reaches. They are in the order of
// their cost: threshold, collision, sinr. Include this to choose one in code;
// scenario/reception_table.hpp has their words.
#include "models/reception/collision.hpp"
#include "models/reception/judge.hpp"
#include "models/reception/sinr.hpp"
