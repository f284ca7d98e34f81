// SPDX-License-Identifier: MIT
#pragma once

// All of rovernet's library.

#include "experiment/link_table.hpp"
#include "experiment/movement_play.hpp"
#include "experiment/run.hpp"
#include "experiment/whereabouts.hpp"
#include "mobility/files/movement_file.hpp"
#include "mobility/files/movement_writer.hpp"
#include "mobility/straight.hpp"
#include "mobility/waypoints.hpp"
#include "models/access/list.hpp"
#include "models/propagation/list.hpp"
#include "models/reception/list.hpp"
#include "network/network.hpp"
#include "pictures/chart/chart.hpp"
#include "pictures/map/picture.hpp"
#include "routing/flood.hpp"
#include "scenario/scenario.hpp"
#include "scene/occupancy.hpp"
#include "scene/scene.hpp"
#include "scene/stage/stage_walls.hpp"
#include "traces/fingerprint.hpp"
#include "traces/metrics.hpp"
#include "traces/ns2/ns2_reader.hpp"
#include "traces/ns2/ns2_trace.hpp"
