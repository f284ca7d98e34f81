// SPDX-License-Identifier: MIT
// Walls along a segment: crossings, lengths and losses.
#include "scene/scene.hpp"
#include "scene/wall_layer.hpp"

#include <algorithm>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace rovernet {
namespace {

/// Length [m] up to which gaps and pieces of wall are ignored.
constexpr double shortest = 1e-9;

bool comes_before(Vec3 a, Vec3 b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }

/// Joins crossings of one material that overlap or touch; the result is in order of entry.
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

/// Segment among walls, with the data for grouping its crossings into walls.
class SegmentInWalls {
  public:
    SegmentInWalls(std::span<const WallLayer> layers, const Storeys& storeys, Vec3 a, Vec3 b)
        : layers_(layers), storeys_(storeys), a_(a), b_(b), length_(distance(a, b)) {
        if (layers.size() == 1 && layers.front().is_endless()) {
            only_ = &layers.front();
            from_ = only_->frame.to_cells(a);
            to_ = only_->frame.to_cells(b);
            step_ = {(to_.u - from_.u) / length_, (to_.v - from_.v) / length_};
        }
        for (const WallLayer& layer : layers) {
            any_stair_ = any_stair_ || layer.faces->any_stair();
            any_hollow_ = any_hollow_ || layer.hollows->any();
        }
    }

    /// Returns the walls, if they are of one material, on one map and endless; otherwise null.
    const WallLayer* one_map() const { return only_; }
    /// Writes the crossings for one_map().
    void cross_one_map(std::vector<Crossing>& out) const {
        only_->crossings(from_, to_, length_, out);
    }

    /// Drawn thickness of the walls in the middle of a crossing [m].
    double thickness_in(const Crossing& c) const {
        const double along = (c.entry + c.exit) / 2;
        if (only_) return only_->thickness->at(on_one_map(along));
        double most = 0;
        on_maps(along, [&](const WallLayer& layer, CellPoint p) {
            most = std::max(most, layer.thickness->at(p));
            return true;
        });
        return most;
    }

    /// Whether each crossing is a separate wall: there are no staircases and no outlines.
    bool each_is_wall() const { return !any_stair_ && !any_hollow_; }
    /// Whether a crossing and the next one belong to one wall: the segment has left it at a step of
    /// a staircase and re-enters by the same face, or it is in the interior of a wall drawn as an
    /// outline.
    bool is_one_wall(const Crossing& p, const Crossing& q) const {
        if (p.material != q.material) return false;
        return (any_hollow_ && is_hollow((p.exit + q.entry) / 2)) ||
               (any_stair_ && common_face(p.exit, q.entry, p.material));
    }

    /// Whether the segment enters by the face by which it leaves, so that it only touches the steps
    /// of a staircase.
    bool is_touch(const Crossing& first, const Crossing& last) const {
        if (!any_stair_) return false;
        const Face* face = common_face(first.entry, last.exit, first.material);
        return face && face->slants;
    }

  private:
    /// Calls ask(layer, point) for the layers on the storey, until it returns false.
    template <class Ask>
    void on_maps(double along, Ask ask) const {
        if (only_) {
            ask(*only_, on_one_map(along));
            return;
        }
        const Vec3 p = at(along);
        const std::size_t storey = storeys_.number_at(p.z);
        for (const WallLayer& layer : layers_)
            if (layer.storey == storey && !ask(layer, layer.frame.to_cells(p))) return;
    }
    CellPoint on_one_map(double along) const {
        return {from_.u + along * step_.u, from_.v + along * step_.v};
    }
    Vec3 at(double along) const { return a_ + (along / length_) * (b_ - a_); }
    bool is_hollow(double along) const {
        bool found = false;
        on_maps(along, [&](const WallLayer& layer, CellPoint p) {
            found = layer.hollows->holds(p);
            return !found;
        });
        return found;
    }
    /// Face that contains the two points at these distances along the segment; null if there is
    /// none.
    const Face* common_face(double along, double further, std::size_t material) const {
        const Faces* faces = faces_at(along);
        if (!faces || faces != faces_at(further)) return nullptr;
        const auto face = faces->at(at(along), material);
        return face && face == faces->at(at(further), material) ? &faces->all()[*face] : nullptr;
    }
    const Faces* faces_at(double along) const {
        if (only_) return only_->faces.get();
        const std::size_t storey = storeys_.number_at(at(along).z);
        const auto layer = std::find_if(layers_.begin(), layers_.end(),
                                        [&](const WallLayer& l) { return l.storey == storey; });
        return layer == layers_.end() ? nullptr : layer->faces.get();
    }

    std::span<const WallLayer> layers_;
    const WallLayer* only_ = nullptr;
    const Storeys& storeys_;
    Vec3 a_, b_;
    double length_;
    CellPoint from_, to_, step_;  // a, b and the way by metre, of one map
    bool any_stair_ = false, any_hollow_ = false;
};

/// Calls visit(pieces, touched) for each wall that a segment passes, until it returns false: with
/// the consecutive crossings of one wall, and whether they only touch the steps of one of its
/// faces.
/// @param crossings  in order along the segment
template <class Visit>
void visit_walls(std::span<const Crossing> crossings, const SegmentInWalls& segment, Visit visit) {
    if (segment.each_is_wall()) {
        for (const Crossing& c : crossings)
            if (!visit(std::span(&c, 1), false)) return;
        return;
    }
    for (std::size_t i = 0, end = 0; i < crossings.size(); i = end) {
        end = i + 1;
        while (end < crossings.size() && segment.is_one_wall(crossings[end - 1], crossings[end]))
            ++end;
        const auto pieces = crossings.subspan(i, end - i);
        if (!visit(pieces, segment.is_touch(pieces.front(), pieces.back()))) return;
    }
}

double thickness_of(std::span<const Crossing> pieces, const SegmentInWalls& segment) {
    double most = 0;
    for (const Crossing& c : pieces) most = std::max(most, segment.thickness_in(c));
    return most;
}

double length_of(std::span<const Crossing> pieces) {
    double sum = 0;
    for (const Crossing& c : pieces) sum += c.length;
    return sum;
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

std::vector<Wall> Scene::walls(Vec3 a, Vec3 b) const {
    std::vector<Wall> found;
    const auto all = crossings(a, b);
    if (all.empty()) return found;
    const SegmentInWalls segment(layers_, storeys_, a, b);
    visit_walls(all, segment, [&](std::span<const Crossing> pieces, bool touched) {
        if (touched) return true;
        found.push_back({pieces.front().entry, pieces.back().exit, length_of(pieces),
                         pieces.front().material, Meters{thickness_of(pieces, segment)}});
        return true;
    });
    return found;
}

bool Scene::passes_wall(Vec3 a, Vec3 b) const {
    if (wall_length(a, b, 0) == 0) return false;
    const bool any_stair = std::any_of(layers_.begin(), layers_.end(), [](const WallLayer& layer) {
        return layer.faces->any_stair();
    });
    if (!any_stair) return true;
    const SegmentInWalls segment(layers_, storeys_, a, b);
    const auto all = crossings(a, b);
    bool passes = false;
    visit_walls(all, segment, [&](std::span<const Crossing>, bool touched) {
        passes = !touched;
        return !passes;
    });
    return passes;
}

/// Sum of the losses of the walls that a segment passes [dB].
/// @param rate_of  loss rate of a wall, by its pieces in the segment
template <class RateOf>
double Scene::sum_of_walls(Vec3 a, Vec3 b, double enough, std::vector<Crossing>& scratch,
                           RateOf rate_of) const {
    if (layers_.empty() || a == b) return 0;
    if (comes_before(b, a)) std::swap(a, b);
    const SegmentInWalls segment(layers_, storeys_, a, b);
    if (segment.one_map()) {
        segment.cross_one_map(scratch);
    } else {
        merged_crossings(a, b, scratch);
    }
    double sum = 0;
    visit_walls(scratch, segment, [&](std::span<const Crossing> pieces, bool touched) {
        const WallRate& rate = rate_of(pieces, segment);
        sum += (touched ? 0 : rate.per_crossing) + rate.per_metre * length_of(pieces);
        return sum <= enough;
    });
    return sum;
}

double Scene::wall_loss(Vec3 a, Vec3 b, std::span<const WallRate> rates, double enough,
                        std::vector<Crossing>& scratch) const {
    return sum_of_walls(a, b, enough, scratch,
                        [&](std::span<const Crossing> pieces, const auto&) -> const WallRate& {
                            return rates[pieces.front().material];
                        });
}

double Scene::wall_loss(Vec3 a, Vec3 b, const WallRates& rates, double enough,
                        std::vector<Crossing>& scratch) const {
    return sum_of_walls(
        a, b, enough, scratch,
        [&](std::span<const Crossing> pieces, const auto& segment) -> const WallRate& {
            const bool heavy = std::any_of(pieces.begin(), pieces.end(), [&](const Crossing& c) {
                return segment.thickness_in(c) >= rates.thinnest_heavy.value;
            });
            return (heavy ? rates.heavy : rates.light)[pieces.front().material];
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
