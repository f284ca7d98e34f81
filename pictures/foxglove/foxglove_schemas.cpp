// SPDX-License-Identifier: MIT
#include "pictures/foxglove/foxglove_schemas.hpp"

#include "sim/math.hpp"

#include <initializer_list>
#include <stdexcept>
#include <string>
#include <utility>

namespace rovernet::foxglove {
namespace {

using Keys = std::initializer_list<std::pair<std::string_view, Table>>;

Table of_type(std::string_view type) {
    Table schema;
    schema.set("type", type);
    return schema;
}
Table object(Keys keys) {
    Table properties;
    for (const auto& [key, schema] : keys) properties.set(key, schema);
    Table schema = of_type("object");
    schema.set("properties", std::move(properties));
    return schema;
}
Table list_of(Table items) {
    Table schema = of_type("array");
    schema.set("items", std::move(items));
    return schema;
}
Table number() { return of_type("number"); }
Table whole() { return of_type("integer"); }
Table text() { return of_type("string"); }
Table boolean() { return of_type("boolean"); }
Table bytes() {
    Table schema = text();
    schema.set("contentEncoding", "base64");
    return schema;
}

Table time_schema() { return object({{"sec", whole()}, {"nsec", whole()}}); }
Table vector_schema() { return object({{"x", number()}, {"y", number()}, {"z", number()}}); }
Table quaternion_schema() {
    return object({{"x", number()}, {"y", number()}, {"z", number()}, {"w", number()}});
}
Table pose_schema() {
    return object({{"position", vector_schema()}, {"orientation", quaternion_schema()}});
}
Table color_schema() {
    return object({{"r", number()}, {"g", number()}, {"b", number()}, {"a", number()}});
}

Table transforms_schema() {
    const Table transform = object({{"timestamp", time_schema()},
                                    {"parent_frame_id", text()},
                                    {"child_frame_id", text()},
                                    {"translation", vector_schema()},
                                    {"rotation", quaternion_schema()}});
    return object({{"transforms", list_of(transform)}});
}

Table grid_schema() {
    const Table field = object({{"name", text()}, {"offset", whole()}, {"type", whole()}});
    return object({{"timestamp", time_schema()},
                   {"frame_id", text()},
                   {"pose", pose_schema()},
                   {"column_count", whole()},
                   {"cell_size", object({{"x", number()}, {"y", number()}})},
                   {"row_stride", whole()},
                   {"cell_stride", whole()},
                   {"fields", list_of(field)},
                   {"data", bytes()}});
}

Table scene_update_schema() {
    const Table cylinder = object({{"pose", pose_schema()},
                                   {"size", vector_schema()},
                                   {"bottom_scale", number()},
                                   {"top_scale", number()},
                                   {"color", color_schema()}});
    const Table arrow = object({{"pose", pose_schema()},
                                {"shaft_length", number()},
                                {"shaft_diameter", number()},
                                {"head_length", number()},
                                {"head_diameter", number()},
                                {"color", color_schema()}});
    const Table line = object({{"type", whole()},
                               {"pose", pose_schema()},
                               {"thickness", number()},
                               {"scale_invariant", boolean()},
                               {"points", list_of(vector_schema())},
                               {"color", color_schema()},
                               {"colors", list_of(color_schema())},
                               {"indices", list_of(whole())}});
    const Table label = object({{"pose", pose_schema()},
                                {"billboard", boolean()},
                                {"font_size", number()},
                                {"scale_invariant", boolean()},
                                {"color", color_schema()},
                                {"text", text()}});
    const Table none = list_of(of_type("object"));
    const Table entity = object({{"timestamp", time_schema()},
                                 {"frame_id", text()},
                                 {"id", text()},
                                 {"lifetime", time_schema()},
                                 {"frame_locked", boolean()},
                                 {"metadata", none},
                                 {"arrows", list_of(arrow)},
                                 {"cubes", none},
                                 {"spheres", none},
                                 {"cylinders", list_of(cylinder)},
                                 {"lines", list_of(line)},
                                 {"triangles", none},
                                 {"texts", list_of(label)},
                                 {"models", none}});
    return object({{"deletions", none}, {"entities", list_of(entity)}});
}

Table log_schema() {
    return object({{"timestamp", time_schema()},
                   {"level", whole()},
                   {"message", text()},
                   {"name", text()},
                   {"file", text()},
                   {"line", whole()}});
}

/// Seconds and the rest in nanoseconds, as Foxglove has times.
Table seconds_and_rest(std::int64_t ns) {
    constexpr std::int64_t second = 1'000'000'000;
    Table out;
    out.set("sec", ns / second);
    out.set("nsec", ns % second);
    return out;
}

}  // namespace

Table schema_of(std::string_view type) {
    if (type == "foxglove.FrameTransforms") return transforms_schema();
    if (type == "foxglove.Grid") return grid_schema();
    if (type == "foxglove.SceneUpdate") return scene_update_schema();
    if (type == "foxglove.Log") return log_schema();
    throw std::invalid_argument("schema_of: no schema of " + std::string(type));
}

Table time(Time t) { return seconds_and_rest((t - start_of_run).count()); }
Table duration(Duration length) { return seconds_and_rest(length.count()); }

Table vector(Vec3 v) {
    Table out;
    out.set("x", v.x);
    out.set("y", v.y);
    out.set("z", v.z);
    return out;
}

Table rotation(double heading) {
    const math::SinCos half = math::sincos(heading / 2);
    Table out;
    out.set("x", 0.0);
    out.set("y", 0.0);
    out.set("z", half.sin);
    out.set("w", half.cos);
    return out;
}

Table pose(Vec3 position, double heading) {
    Table out;
    out.set("position", vector(position));
    out.set("orientation", rotation(heading));
    return out;
}

Table color(Color c) {
    Table out;
    out.set("r", c.r);
    out.set("g", c.g);
    out.set("b", c.b);
    out.set("a", c.a);
    return out;
}

Table entity(Time t, const std::string& frame, const std::string& id, Duration lifetime) {
    Table out;
    out.set("timestamp", time(t));
    out.set("frame_id", frame);
    out.set("id", id);
    out.set("lifetime", duration(lifetime));
    out.set("frame_locked", true);
    for (const char* shapes : {"metadata", "arrows", "cubes", "spheres", "cylinders", "lines",
                               "triangles", "texts", "models"}) {
        out.set(shapes, Array{});
    }
    return out;
}

Table scene_update(Array entities) {
    Table out;
    out.set("deletions", Array{});
    out.set("entities", std::move(entities));
    return out;
}

}  // namespace rovernet::foxglove
