// SPDX-License-Identifier: MIT
#pragma once

#include "models/phy/wifi.hpp"

#include <tuple>

// The list of physical layers.

namespace rovernet {

/// Physical layers that there are, for tests that every one has to pass.
using PhysicalLayers = std::tuple<Wifi>;

}  // namespace rovernet
