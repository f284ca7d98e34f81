// SPDX-License-Identifier: MIT
#pragma once

// The reception models, cheapest first.
#include "models/reception/collision.hpp"
#include "models/reception/judge.hpp"
#include "models/reception/sinr.hpp"
