// SPDX-License-Identifier: MIT
#include "scenario/stage/stage_scanner.hpp"

#include "scenario/document/quantity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

namespace rovernet {
namespace {

constexpr int most_scanner_beams = 10'000;
constexpr double degrees_a_radian = 57.295779513082320877;

Value angle_value(double degrees, const Location& where) {
    return placed(fmt::format("{} deg", degrees), where);
}
Value length_value(double metres, const Location& where) {
    return placed(quantity_text(metres, Dimension::length), where);
}

/// A whole number of beams.
int count_of(const WorldProperty& property) {
    const double number = property.number();
    if (number >= 1 && number <= most_scanner_beams && number == std::floor(number)) {
        return static_cast<int>(number);
    }
    throw InputError(property.where, fmt::format("{}: found {}; expected a whole number from 1 to "
                                                 "10,000; such as {} 181",
                                                 property.name, number, property.name));
}

/// Second number of a tuple, such as the range of [min max].
double second_of(const WorldProperty& property) {
    const double* number = property.is_tuple && property.values.size() > 1
                               ? std::get_if<double>(&property.values[1])
                               : nullptr;
    if (number) return *number;
    throw InputError(property.where, fmt::format("{}: found no second number; expected {} [min "
                                                 "max]; such as {} [0 5]",
                                                 property.name, property.name, property.name));
}

/// Gatherer of the range finders of one robot.
class ScannerReader {
  public:
    ScannerReader(const WorldUnits& units, std::vector<std::string>& notices)
        : units_(units), notices_(notices) {}

    void visit(const WorldEntity& parent, const WorldPose& pose);
    Array take() { return std::move(scanners_); }

  private:
    void laser(const WorldEntity& model, const WorldPose& pose);
    void sensor(const WorldEntity& ranger, const WorldEntity& sensor, const WorldPose& pose);
    void sensors(const WorldEntity& ranger, const std::vector<const WorldEntity*>& sensors,
                 const WorldPose& pose);
    void transducers(const WorldEntity& ranger, const WorldPose& pose);
    void transducers(Table table, const WorldEntity& ranger,
                     const std::map<std::string_view, const WorldProperty*>& poses, int count);

    Table begin(std::string_view kind, const WorldEntity& model, const WorldPose& pose) const;
    void set_fan(Table& table, int beams, double fov, const WorldEntity& model) const;
    double fov_of(const WorldEntity& model, double usual) const;
    Value range_of(const WorldEntity& sensor) const;
    void add_beam(const WorldPose& pose, const Location& where);
    void end_ring(Table table, const WorldEntity& model);
    void note(const Location& where, std::string_view text) {
        notices_.push_back(world_notice(where, text));
    }

    const WorldUnits& units_;
    std::vector<std::string>& notices_;
    Array scanners_;
    Array angles_, places_;  // of the ring that is read
};

void ScannerReader::visit(const WorldEntity& parent, const WorldPose& pose) {
    for (const WorldEntity& child : parent.children) {
        if (child.type == "position" || child.type == "sensor") continue;
        const WorldPose own = pose * world_pose(child, "pose", units_);
        if (child.type == "laser") laser(child, own);
        if (child.type == "ranger") {
            std::vector<const WorldEntity*> found;
            for (const WorldEntity& part : child.children) {
                if (part.type == "sensor") found.push_back(&part);
            }
            if (found.empty()) transducers(child, own);
            if (found.size() == 1) sensor(child, *found.front(), own);
            if (found.size() > 1) sensors(child, found, own);
        }
        visit(child, own);
    }
}

/// Keys common to all range finders: kind, pose and interval.
Table ScannerReader::begin(std::string_view kind, const WorldEntity& model,
                           const WorldPose& pose) const {
    Table table;
    table.set("kind", placed(kind, model.where));
    const WorldProperty* given = model.find("pose");
    const Location& where = given ? given->where : model.where;
    if (pose.at.x != 0 || pose.at.y != 0) {
        table.set(
            "at",
            placed(Array{length_value(pose.at.x, where), length_value(pose.at.y, where)}, where));
    }
    if (pose.degrees != 0) table.set("heading", angle_value(pose.degrees, where));
    if (const WorldProperty* interval = model.find("update_interval")) {
        table.set("every", placed(fmt::format("{} ms", interval->number()), interval->where));
    }
    return table;
}

/// Beams over the field of view, both of its ends included; a single one is straight ahead.
void ScannerReader::set_fan(Table& table, int beams, double fov, const WorldEntity& model) const {
    const WorldProperty* given = model.find("fov");
    const Location& where = given ? given->where : model.where;
    const double half = beams > 1 ? fov / 2 : 0;
    table.set("beams", placed(beams, where));
    table.set("from", angle_value(-half, where));
    table.set("to", angle_value(half, where));
}

/// Field of view in degrees.
double ScannerReader::fov_of(const WorldEntity& model, double usual) const {
    const WorldProperty* given = model.find("fov");
    return given ? given->number() * units_.degrees : usual;
}

void ScannerReader::laser(const WorldEntity& model, const WorldPose& pose) {
    constexpr int usual_samples = 180;
    constexpr double usual_fov = 180, usual_range = 8;
    Table table = begin("laser", model, pose);
    const WorldProperty* samples = model.find("samples");
    set_fan(table, samples ? count_of(*samples) : usual_samples, fov_of(model, usual_fov), model);
    const WorldProperty* range = model.find("range_max");
    table.set("range", length_value(range ? units_.metres(range->number()) : usual_range,
                                    range ? range->where : model.where));
    scanners_.push_back(placed(std::move(table), model.where));
}

/// Range of a sensor of Stage 4.
Value ScannerReader::range_of(const WorldEntity& sensor) const {
    constexpr double usual = 5;
    const WorldProperty* range = sensor.find("range");
    return length_value(range ? units_.metres(second_of(*range)) : usual,
                        range ? range->where : sensor.where);
}

void ScannerReader::sensor(const WorldEntity& ranger, const WorldEntity& sensor,
                           const WorldPose& pose) {
    constexpr double usual_fov = 0.1 * degrees_a_radian;
    Table table = begin("ranger", ranger, pose * world_pose(sensor, "pose", units_));
    const WorldProperty* samples = sensor.find("samples");
    set_fan(table, samples ? count_of(*samples) : 1, fov_of(sensor, usual_fov), sensor);
    table.set("range", range_of(sensor));
    scanners_.push_back(placed(std::move(table), ranger.where));
}

/// Several sensors have one beam each, as in Player's ranger interface.
void ScannerReader::sensors(const WorldEntity& ranger,
                            const std::vector<const WorldEntity*>& sensors, const WorldPose& pose) {
    Table table = begin("ranger", ranger, pose);
    Value range = range_of(*sensors.front());
    double farthest = 0;
    bool differ = false, several = false;
    for (const WorldEntity* each : sensors) {
        add_beam(world_pose(*each, "pose", units_), each->where);
        const WorldProperty* samples = each->find("samples");
        several = several || (samples && count_of(*samples) > 1);
        const Value own = range_of(*each);
        differ = differ || *own.string() != *range.string();
        const double metres = read_quantity(own, "range", Dimension::length);
        if (metres > farthest) range = own;
        farthest = std::max(farthest, metres);
    }
    if (differ) {
        note(ranger.where,
             fmt::format("the sensors of this ranger have different ranges; in rovernet, all these "
                         "sensors measure up to the largest range, {}",
                         *range.string()));
    }
    if (several) {
        note(ranger.where,
             "a ranger with several sensors gets only one beam for each sensor: the middle sample "
             "of this sensor");
    }
    table.set("range", std::move(range));
    end_ring(std::move(table), ranger);
}

/// The sonars of Stage 2 and 3.
void ScannerReader::transducers(const WorldEntity& ranger, const WorldPose& pose) {
    constexpr int usual_count = 16;
    constexpr double usual_range = 5;
    Table table = begin("sonar", ranger, pose);
    const WorldProperty* given = ranger.find("scount");
    const int count = given ? count_of(*given) : usual_count;
    const WorldProperty* view = ranger.find("sview");
    table.set("range", length_value(view ? units_.metres(second_of(*view)) : usual_range,
                                    view ? view->where : ranger.where));
    std::map<std::string_view, const WorldProperty*> poses;  // the last of each name
    bool has_views = false;
    for (const WorldProperty& each : ranger.properties) {
        if (each.name.starts_with("spose[")) poses[each.name] = &each;
        has_views = has_views || each.name.starts_with("sview[");
    }
    if (has_views)
        note(ranger.where, "sview[i] of a ranger is ignored, as in Stage; only sview is read");
    if (!poses.empty()) return transducers(std::move(table), ranger, poses, count);
    table.set("beams", placed(count, ranger.where));
    table.set("from", angle_value(0, ranger.where));
    table.set("to", angle_value(360.0 * (count - 1) / count, ranger.where));
    scanners_.push_back(placed(std::move(table), ranger.where));
}

void ScannerReader::transducers(Table table, const WorldEntity& ranger,
                                const std::map<std::string_view, const WorldProperty*>& poses,
                                int count) {
    for (int i = 0; i < count; ++i) {
        const auto found = poses.find(fmt::format("spose[{}]", i));
        if (found == poses.end()) {
            angles_.clear();
            places_.clear();
            return note(ranger.where,
                        fmt::format("this ranger is left out: it has {} sonars, but no spose[{}], "
                                    "which is the pose of one of these sonars",
                                    count, i));
        }
        add_beam(world_pose(*found->second, units_), found->second->where);
    }
    end_ring(std::move(table), ranger);
}

void ScannerReader::add_beam(const WorldPose& pose, const Location& where) {
    angles_.push_back(angle_value(pose.degrees, where));
    places_.push_back(
        placed(Array{length_value(pose.at.x, where), length_value(pose.at.y, where)}, where));
}

void ScannerReader::end_ring(Table table, const WorldEntity& model) {
    table.set("angles", placed(std::exchange(angles_, {}), model.where));
    table.set("places", placed(std::exchange(places_, {}), model.where));
    scanners_.push_back(placed(std::move(table), model.where));
}

}  // namespace

Array stage_scanners(const WorldEntity& robot, const WorldUnits& units,
                     std::vector<std::string>& notices) {
    ScannerReader reader(units, notices);
    reader.visit(robot, {});
    return reader.take();
}

bool is_stage_scanner(const WorldEntity& model) {
    return model.type == "laser" || model.type == "ranger";
}

}  // namespace rovernet
