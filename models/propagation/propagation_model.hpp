// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/shadowed_range.hpp"
#include "scene/scene.hpp"
#include "sim/geometry.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

// The port of propagation models: the loss of a link in dB. A model is a plain struct with a name
// and one pure function; whatever else it knows of itself (its range, its shape) makes links
// cheaper to find. Antennas, gains and powers are not its business: Medium adds them.
//
//     struct FreeSpace {
//         static constexpr std::string_view name = "free_space";
//         void loss(const LinkBatch& links, Db /*give_up*/, std::span<double> out_db) const {
//             for (std::size_t i = 0; i < out_db.size(); ++i)
//                 out_db[i] = std::max(0.0, free_space_db(links.distance(i), links.frequency));
//         }
//     };

namespace rovernet {

/// Links from one transmitter to its receivers: all that a propagation model may know.
///
/// A propagation model is a pure function of places and keys: its losses are kept for robots at
/// rest. Time and frame are for what varies behind it.
struct LinkBatch {
    /// Frequency of the transmitter [Hz].
    Hertz frequency;
    /// Position of its antenna [m].
    Vec3 from;
    /// Positions of the receivers' antennas [m].
    std::span<const Vec3> to;
    /// Key of the transmitter, for random draws.
    std::uint64_t from_key = 0;
    /// Keys of the receivers, as many as `to`.
    std::span<const std::uint64_t> to_keys;
    /// Scene with its walls; never null in a Network.
    const Scene* scene = nullptr;
    /// Height of one storey [m], in a scene that has no floors of its own; no_storeys: antennas are
    /// on one storey at all heights.
    Meters floor_height = no_storeys;
    /// Seed and replication of random draws.
    std::uint64_t seed = 0;
    std::uint32_t replication = 0;
    /// Time at which the frame begins, or the link is looked at.
    Time at = start_of_run;
    /// Key of the frame, for random draws; 0: the local mean of the link.
    std::uint64_t frame = 0;

    /// Number of links.
    std::size_t size() const { return to.size(); }
    /// Distance between the antennas of the i-th link [m], in three dimensions.
    double distance(std::size_t i) const { return rovernet::distance(from, to[i]); }
};

/// Path loss model: a plain struct with one pure function over a batch.
///
/// `loss` fills out_db[i] [dB] for the i-th receiver, same size as the batch; finite and never
/// negative, the same in both directions. It may stop working on a link once its loss exceeds
/// `give_up`, and leave any value above `give_up` there. Every copy of the model answers alike, in
/// any order and at any time.
template <class T>
concept PropagationModel = std::copy_constructible<T> &&
    requires(const T& model, const LinkBatch& links, Db give_up, std::span<double> out_db) {
    { T::name } -> std::convertible_to<std::string_view>;
    model.loss(links, give_up, out_db);
};

/// Model that bounds its own range: beyond `reach(loss, frequency)` [m] its loss is more than
/// `loss`. For other models every robot is looked at.
template <class T>
concept BoundedModel = requires(const T& model, Db loss, Hertz frequency) {
    { model.reach(loss, frequency) } -> std::same_as<Meters>;
};

/// Model that bounds its range by the heights of the antennas: beyond that no loss between two
/// whose z is at most `highest` [m] is as little as `loss`.
template <class T>
concept BoundedByHeight = requires(const T& model, Db loss, Hertz frequency, Meters highest) {
    { model.reach(loss, frequency, highest) } -> std::same_as<Meters>;
};

/// Shape of the loss while the ends of a link move. It decides how links are found, and where their
/// changes are looked for.
enum class LossShape {
    /// Function of the distance between the antennas alone, which never falls.
    by_distance,
    /// Function of the distance for each pair of nodes, which never falls.
    by_pair,
    /// Function of the distance as long as both antennas keep their heights, which never falls.
    by_heights,
    /// Function of the distance, except that walls add to it: it jumps where the line of sight
    /// passes a wall's corner, and is smooth elsewhere.
    by_walls,
    /// Anything.
    unknown,
};
/// Shape between antennas that move at these velocities [m/s]; it is never by_heights.
constexpr LossShape shape_in_motion(LossShape shape, Vec3 a, Vec3 b) {
    if (shape != LossShape::by_heights) return shape;
    return a.z == 0 && b.z == 0 ? LossShape::by_distance : LossShape::unknown;
}

/// Model that knows its shape; others are `unknown`.
template <class T>
concept ShapedModel = requires(const T& model) {
    { model.shape() } -> std::same_as<LossShape>;
};

/// Model whose loss, at each frequency, is a ShadowedLoss of the antennas' distance and the pair's
/// own one of the shadowing_draws(): then a ShadowedRange decides links as `loss` does.
template <class T>
concept ShadowedModel = requires(const T& model, Hertz frequency) {
    { model.shadowed_loss(frequency) } -> std::same_as<ShadowedLoss>;
};

/// Model with a random part for each pair of nodes, which tells the same model without it; with
/// nothing random, an equal model. Pictures of coverage show the median, as they have no pairs.
template <class T>
concept RandomModel = requires(const T& model) {
    { model.median() } -> std::same_as<T>;
    { model.is_random() } -> std::same_as<bool>;
};

/// Model that cannot work with every frequency, and says so by std::invalid_argument.
template <class T>
concept FrequencyCheckedModel = requires(const T& model, Hertz frequency) {
    model.check_frequency(frequency);
};

/// Model that cannot work in every scene, and says so by std::invalid_argument.
template <class T>
concept SceneCheckedModel = requires(const T& model, const Scene& scene) {
    model.check_scene(scene);
};

}  // namespace rovernet
