// SPDX-License-Identifier: MIT
#pragma once

// Access models: how nodes get access to the medium. They are in the order of their cost: none,
// aloha, csma. Include this to choose one in code; scenario/access_table.hpp has their words.
#include "models/access/aloha.hpp"
#include "models/access/dcf.hpp"
#include "models/access/no_access.hpp"
