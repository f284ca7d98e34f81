# What a program that uses the library may include: rovernet.hpp and what that needs. They are
# installed; all other headers may change with any commit. test/consumer holds the list to rovernet.hpp.
file(GLOB ROVERNET_COMMANDS CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}
    ${PROJECT_SOURCE_DIR}/experiment/*_command.hpp)
set(ROVERNET_PUBLIC_HEADERS
    ${ROVERNET_COMMANDS} experiment/run.hpp experiment/session.hpp
    mobility/area.hpp mobility/driven.hpp mobility/follow.hpp
    mobility/follow_wall.hpp mobility/gauss_markov.hpp mobility/group.hpp mobility/movement.hpp
    mobility/patrol.hpp mobility/random_direction.hpp mobility/random_walk.hpp
    mobility/random_waypoint.hpp mobility/straight.hpp mobility/wander.hpp mobility/way.hpp
    mobility/waypoints.hpp
    models/access/access.hpp models/access/aloha.hpp models/access/csma.hpp
    models/access/no_access.hpp
    models/antenna.hpp models/arrival.hpp
    models/links/link_search.hpp
    models/phy/phy.hpp models/phy/wifi.hpp
    models/propagation/disc.hpp models/propagation/friis.hpp models/propagation/itu_indoor.hpp
    models/propagation/itu_site_general.hpp models/propagation/list.hpp
    models/propagation/log_distance.hpp models/propagation/multi_wall.hpp
    models/propagation/propagation.hpp models/propagation/propagation_model.hpp
    models/propagation/rays.hpp models/propagation/raytrace_2007.hpp
    models/propagation/two_ray.hpp
    models/radio.hpp models/radio_labels.hpp
    models/reception/collision.hpp models/reception/judge.hpp models/reception/sinr.hpp
    models/variation/fading.hpp models/variation/shadowing.hpp
    network/neighbour.hpp network/network.hpp network/robot.hpp network/settings.hpp
    network/subscription.hpp
    routing/aodv.hpp routing/dsr.hpp routing/flood.hpp routing/managed.hpp routing/suppression.hpp
    rovernet.hpp
    scenario/document/toml.hpp scenario/document/value.hpp
    scenario/scenario_file.hpp
    scene/doors.hpp scene/map_frame.hpp
    scene/materials/material.hpp scene/materials/p2040.hpp
    scene/occupancy.hpp scene/scene.hpp scene/scene_change.hpp scene/storeys.hpp
    sim/error.hpp sim/fate.hpp sim/fields.hpp sim/geometry.hpp sim/ids.hpp sim/leg.hpp
    sim/link_layer.hpp sim/math.hpp sim/message.hpp sim/random.hpp sim/parameter.hpp sim/record.hpp
    sim/record_field.hpp sim/record_kind.hpp sim/robot_record.hpp
    sim/router.hpp sim/routing_protocol.hpp sim/sink.hpp sim/time.hpp sim/units.hpp
    study/statistics/interval.hpp
    study/statistics/metric_bounds.hpp study/statistics/summary.hpp
    traces/cost_values.hpp traces/fingerprint.hpp traces/metric_values.hpp
    traces/ns2/ns2_trace.hpp)
