// SPDX-License-Identifier: MIT
#pragma once

// All of rovernet's library.

#include "experiment/network.hpp"
#include "experiment/run.hpp"
#include "experiment/scenario.hpp"
#include "mobility/waypoints.hpp"
#include "models/list.hpp"
#include "routing/flood.hpp"
#include "scene/occupancy.hpp"
#include "scene/scene.hpp"
#include "traces/fingerprint.hpp"
#include "traces/metrics.hpp"
#include "traces/ns2_reader.hpp"
#include "traces/ns2_trace.hpp"
