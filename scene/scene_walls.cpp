// SPDX-License-Identifier: MIT
// Walls in the way of a signal: crossings, lengths and losses.
#include "scene/scene.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace rovernet {
namespace {

/// Gaps and pieces of wall up to this length [m] are none.
constexpr double shortest = 1e-9;

/// A gap no wider than this [cells] does not end a wall: one that stands askew to the cells is
/// drawn in steps, and a ray leaves it at each.
constexpr double widest_step = 2;

bool comes_before(Vec3 a, Vec3 b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }

/// Joins crossings of one material that overlap or touch; leaves them in order of entry.
void join(std::vector<Crossing>& crossings) {
    std::sort(crossings.begin(), crossings.end(), [](const Crossing& p, const Crossing& q) {
        return std::tie(p.material, p.entry, p.exit) < std::tie(q.material, q.entry, q.exit);
    });
    std::size_t kept = 0;
    for (const Crossing& c : crossings) {
        Crossing* last = kept > 0 ? &crossings[kept - 1] : nullptr;
        if (last && last->material == c.material && c.entry - last->exit <= shortest) {
            if (c.exit <= last->exit) continue;
            last->exit = c.exit;
            last->length = last->exit - last->entry;
        } else {
            crossings[kept++] = c;
        }
    }
    crossings.resize(kept);
    std::sort(crossings.begin(), crossings.end(), [](const Crossing& p, const Crossing& q) {
        return std::tie(p.entry, p.exit, p.material) < std::tie(q.entry, q.exit, q.material);
    });
}

/// Sum of what the walls take that a segment crosses [dB], see Scene::wall_loss.
/// @param crossings     in order along the segment
/// @param step_at       gap that does not end a wall which begins that far along the segment [m]
/// @param thickness_at  drawn thickness at a point that far along the segment [m]
template <class StepAt, class ThicknessAt>
double loss_of_walls(std::span<const Crossing> crossings, const WallRates& rates, double enough,
                     StepAt step_at, ThicknessAt thickness_at) {
    double sum = 0;
    for (auto part = crossings.begin(); part != crossings.end() && sum <= enough;) {
        const std::size_t material = part->material;
        const double step = step_at(part->entry);
        double end = part->exit, inside = 0;
        bool heavy = false;
        for (; part != crossings.end() && part->material == material && part->entry - end <= step;
             ++part) {
            heavy = heavy || thickness_at((part->entry + part->exit) / 2) >= rates.thinnest_heavy;
            end = part->exit;
            inside += part->length;
        }
        const WallRate& rate = (heavy ? rates.heavy : rates.light)[material];
        sum += rate.per_crossing + rate.per_metre * inside;
    }
    return sum;
}

double widest_step_on(const MapFrame& frame) {
    return widest_step * std::max(frame.cell_width(), frame.cell_height());
}

}  // namespace

const WallLayer* Scene::only_layer() const {
    const bool is_one = layers_.size() == 1 && layers_.front().is_endless();
    return is_one ? &layers_.front() : nullptr;
}

void Scene::crossings(Vec3 a, Vec3 b, std::vector<Crossing>& out) const {
    out.clear();
    if (layers_.empty() || a == b) return;
    if (const WallLayer* only = only_layer()) {
        only->crossings(only->frame.to_cells(a), only->frame.to_cells(b), distance(a, b), out);
    } else {
        merged_crossings(a, b, out);
    }
}

void Scene::merged_crossings(Vec3 a, Vec3 b, std::vector<Crossing>& out) const {
    const bool reversed = comes_before(b, a);
    if (reversed) std::swap(a, b);
    out.clear();
    for (const WallLayer& layer : layers_) layer.append_crossings(a, b, out);
    join(out);
    if (!reversed) return;
    const double length = distance(a, b);
    for (Crossing& c : out) c = {length - c.exit, length - c.entry, c.length, c.material};
    std::reverse(out.begin(), out.end());
}

std::vector<Crossing> Scene::crossings(Vec3 a, Vec3 b) const {
    std::vector<Crossing> out;
    crossings(a, b, out);
    return out;
}

double Scene::wall_length(Vec3 a, Vec3 b, double enough) const {
    if (layers_.empty() || a == b) return 0;
    if (const WallLayer* only = only_layer()) {
        return only->walls->solid_length(only->frame.to_cells(a), only->frame.to_cells(b),
                                         distance(a, b), enough);
    }
    if (comes_before(b, a)) std::swap(a, b);  // sums in one order
    double sum = 0;
    for (const Crossing& c : crossings(a, b)) sum += c.length;
    return sum;
}

double Scene::wall_loss(Vec3 a, Vec3 b, std::span<const WallRate> rates, double enough,
                        std::vector<Crossing>& scratch) const {
    if (comes_before(b, a)) std::swap(a, b);
    crossings(a, b, scratch);
    double sum = 0;
    for (const Crossing& c : scratch) {
        sum += rates[c.material].per_crossing + rates[c.material].per_metre * c.length;
        if (sum > enough) break;
    }
    return sum;
}

double Scene::wall_loss(Vec3 a, Vec3 b, const WallRates& rates, double enough,
                        std::vector<Crossing>& scratch) const {
    if (layers_.empty() || a == b) return 0;
    if (comes_before(b, a)) std::swap(a, b);
    const double length = distance(a, b);
    const WallLayer* only = only_layer();
    if (!only) {
        merged_crossings(a, b, scratch);
        const auto at = [&](double along) { return a + along / length * (b - a); };
        return loss_of_walls(
            scratch, rates, enough,
            [&](double along) { return widest_step_on(storey_at(at(along).z).frame_); },
            [&](double along) { return wall_thickness(at(along)); });
    }
    const CellPoint from = only->frame.to_cells(a), to = only->frame.to_cells(b);
    const double u = (to.u - from.u) / length, v = (to.v - from.v) / length;
    only->crossings(from, to, length, scratch);
    return loss_of_walls(
        scratch, rates, enough, [step = widest_step_on(only->frame)](double) { return step; },
        [&](double along) {
            return Meters{only->thickness->at({from.u + along * u, from.v + along * v})};
        });
}

Meters Scene::wall_thickness(Vec3 p) const {
    const std::size_t here = storeys_.number_at(p.z);
    double most = 0;
    for (const WallLayer& layer : layers_) {
        if (layer.storey == here)
            most = std::max(most, layer.thickness->at(layer.frame.to_cells(p)));
    }
    return {most};
}

}  // namespace rovernet
