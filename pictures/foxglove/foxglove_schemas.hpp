// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"
#include "sim/geometry.hpp"
#include "sim/time.hpp"

#include <string>
#include <string_view>

// Messages of Foxglove as JSON, and their JSON Schemas: those parts of foxglove.FrameTransforms,
// foxglove.Grid, foxglove.SceneUpdate and foxglove.Log that a run needs.
// Source: the schemas that Foxglove documents, https://docs.foxglove.dev/docs/sdk/schemas.

namespace rovernet::foxglove {

/// JSON Schema of the messages of a type: "foxglove.FrameTransforms", "foxglove.Grid",
/// "foxglove.SceneUpdate" or "foxglove.Log".
Table schema_of(std::string_view type);

/// Time of a run in the form of Foxglove's messages; 0 at the start of the run.
Table time(Time t);
/// Duration in the form of Foxglove's messages.
Table duration(Duration length);
Table vector(Vec3 v);
/// Position [m] and heading [rad] as a pose.
Table pose(Vec3 position, double heading);
/// Rotation about the vertical axis by a heading [rad], as a quaternion.
Table rotation(double heading);

/// Colour, each part from 0 to 1.
struct Color {
    double r = 0, g = 0, b = 0, a = 1;
};
Table color(Color c);

/// Entity of a foxglove.SceneUpdate, without shapes: lists are empty until they are set.
/// @param frame  coordinate frame of the shapes: "map", or the name of a robot
/// @param lifetime  time after which the entity vanishes; 0: it stays
Table entity(Time t, const std::string& frame, const std::string& id, Duration lifetime);
/// Message foxglove.SceneUpdate with these entities.
Table scene_update(Array entities);

}  // namespace rovernet::foxglove
