// SPDX-License-Identifier: MIT
#pragma once

// Access models: how nodes get access to the medium, in the order of their cost.
//   none   a frame goes on air at once
//   aloha  a node's own frames wait for one another
//   csma   nodes listen, as in Wi-Fi
// Include this to choose one in code; scenario/access_table.hpp has their words.
#include "models/access/aloha.hpp"
#include "models/access/dcf.hpp"
#include "models/access/no_access.hpp"
