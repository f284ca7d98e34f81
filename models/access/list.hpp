// SPDX-License-Identifier: MIT
#pragma once

// Access models: they determine when nodes may transmit. In the order of their cost:
//   none   a frame is transmitted at once
//   aloha  a frame waits for earlier frames of its node
//   csma   nodes sense the carrier, as in Wi-Fi
// Include this to choose a model in code; scenario/tables/access_table.hpp has their names in
// files.
#include "models/access/aloha.hpp"
#include "models/access/csma.hpp"
#include "models/access/no_access.hpp"
