// SPDX-License-Identifier: MIT
#pragma once

#include "models/phy/wifi.hpp"

#include <tuple>

// The list of physical layers.

namespace rovernet {

/// Physical layers that there are, for the tests that every one has to pass. An access model names
/// the one that its frames go by: Access::phy.
using PhysicalLayers = std::tuple<Wifi>;

}  // namespace rovernet
