// SPDX-License-Identifier: MIT
#pragma once

#include "models/phy/wifi.hpp"

#include <tuple>

namespace rovernet {

/// The physical layers that there are.
using PhysicalLayers = std::tuple<Wifi>;

}  // namespace rovernet
