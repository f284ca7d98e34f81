// SPDX-License-Identifier: MIT
#pragma once

// How nodes get access to the medium: the models, cheapest first.
#include "models/access/aloha.hpp"
#include "models/access/dcf.hpp"
#include "models/access/no_access.hpp"
