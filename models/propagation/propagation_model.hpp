// SPDX-License-Identifier: MIT
#pragma once

#include "scene/scene.hpp"
#include "sim/geometry.hpp"
#include "sim/math.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

// Interface of propagation models: the path loss of a link in dB. A model is a plain struct with a
// name and one pure function; optional functions (range, shape) speed up the search for links.
// Antennas, gains and powers are not part of a model: Medium adds them.
//
//     struct FreeSpace {
//         static constexpr std::string_view name = "free_space";
//         void loss(const LinkBatch& links, Db /*cutoff*/, std::span<double> out_db) const {
//             for (std::size_t i = 0; i < out_db.size(); ++i)
//                 out_db[i] = std::max(0.0, free_space_db(links.distance(i), links.frequency));
//         }
//     };

namespace rovernet {

/// Path loss [dB] with log-normal shadowing, at distance d [m] >= 0 for a standard normal draw x:
///
///   L(d, x) = max(0, median(d) + sigma clamp(x, -5, 5)),
///   median(d) = L0 + S log10(max(d / d0, 1)).
struct ShadowedLoss {
    /// Number of standard deviations to which shadowing draws are clamped [-].
    static constexpr double cut_sigmas = 5;

    /// Loss at the reference distance, L0 [dB].
    double at_reference;
    /// Slope S [dB per decade of distance], > 0.
    double per_decade;
    /// Reference distance d0 [m], > 0.
    double reference_distance;
    /// Standard deviation of shadowing [dB], >= 0.
    double sigma;

    /// Median loss [dB] at distance d [m], relative to the median loss at the reference distance.
    double rise(double d) const {
        return per_decade * math::log10(std::max(d / reference_distance, 1.0));
    }
    /// Median loss [dB] at distance d [m].
    double median(double d) const { return at_reference + rise(d); }
    /// Loss [dB] at distance d [m] for the standard normal draw x, which is clamped to +-5.
    double operator()(double d, double x) const {
        return std::max(0.0, median(d) + sigma * std::clamp(x, -cut_sigmas, cut_sigmas));
    }
    /// Distance [m] at which the median loss is `loss` [dB], except for rounding; at least d0.
    double distance(double loss) const {
        return reference_distance * math::exp10(std::max(0.0, (loss - at_reference) / per_decade));
    }
};

/// Links from one transmitter to its receivers: the complete input of a propagation model.
///
/// A propagation model is a pure function of positions and keys, because losses of robots at rest
/// are cached. Time and frame are for fading, which varies and is not cached.
struct LinkBatch {
    /// Frequency of the transmitter [Hz].
    Hertz frequency;
    /// Position of the transmitter's antenna [m].
    Vec3 from;
    /// Positions of the receivers' antennas [m].
    std::span<const Vec3> to = {};
    /// Key of the transmitter, for random draws.
    std::uint64_t from_key = 0;
    /// Keys of the receivers; same size as `to`.
    std::span<const std::uint64_t> to_keys = {};
    /// Scene with its walls; never null in a Network.
    const Scene* scene = nullptr;
    /// Storey height [m], by which models count the floors between antennas if the scene has no
    /// ceilings. The value no_storeys means that no floors are counted.
    Meters floor_height = no_storeys;
    /// Seed and replication of random draws.
    std::uint64_t seed = 0;
    std::uint32_t replication = 0;
    /// Time at which the frame begins, or for which the link is evaluated.
    Time at = start_of_run;
    /// Key of the frame, for random draws; 0 for the local mean of the link.
    std::uint64_t frame = 0;

    /// Number of links.
    std::size_t size() const { return to.size(); }
    /// Distance between the antennas of link i [m], in three dimensions.
    double distance(std::size_t i) const { return rovernet::distance(from, to[i]); }
};

/// Propagation model: a plain struct with one pure function over a batch of links.
///
/// `loss` fills out_db[i] [dB] for receiver i, same size as the batch; finite, never negative, and
/// equal in both directions. Once a loss exceeds `cutoff`, the model may stop the computation and
/// return any value above `cutoff`. All copies of the model return equal results, in any order and
/// at any time.
/// Example: examples/own_model.cpp.
template <class T>
concept PropagationModel = std::copy_constructible<T> &&
    requires(const T& model, const LinkBatch& links, Db cutoff, std::span<double> out_db) {
    { T::name } -> std::convertible_to<std::string_view>;
    model.loss(links, cutoff, out_db);
};

/// Model with a bounded range: beyond `reach(loss, frequency)` [m] its loss is more than `loss`.
/// For a model without this bound, a search for receivers checks every robot.
template <class T>
concept BoundedModel = requires(const T& model, Db loss, Hertz frequency) {
    { model.reach(loss, frequency) } -> std::same_as<Meters>;
};

/// Model whose range bound depends on antenna heights: beyond `reach` its loss is more than `loss`
/// between any two antennas with z <= `highest` [m].
template <class T>
concept BoundedByHeight = requires(const T& model, Db loss, Hertz frequency, Meters highest) {
    { model.reach(loss, frequency, highest) } -> std::same_as<Meters>;
};

/// Shape of the path loss as a function of antenna positions. The shape determines how the medium
/// searches for receivers and link changes.
enum class LossShape {
    /// Path loss is a non-decreasing function of the distance between the antennas.
    by_distance,
    /// Path loss of each pair of nodes is its own non-decreasing function of the distance.
    by_pair,
    /// Path loss is a non-decreasing function of the distance if both antenna heights are constant.
    by_heights,
    /// Path loss is a function of the distance plus the losses of walls: the loss jumps where the
    /// line of sight passes a wall's corner, and is smooth elsewhere.
    by_walls,
    /// Path loss may be any function of the positions.
    unknown,
};
/// Shape of the loss while two antennas move with velocities a and b [m/s]; never by_heights.
constexpr LossShape shape_in_motion(LossShape shape, Vec3 a, Vec3 b) {
    if (shape != LossShape::by_heights) return shape;
    return a.z == 0 && b.z == 0 ? LossShape::by_distance : LossShape::unknown;
}

/// Model that states the shape of its loss. Models without shape() have LossShape::unknown.
template <class T>
concept ShapedModel = requires(const T& model) {
    { model.shape() } -> std::same_as<LossShape>;
};

/// Model with log-normal shadowing: its loss is the function shadowed_loss() of the distance and of
/// the pair's draw, see shadowing_draws(). A ShadowedRange then decides links exactly like `loss`.
template <class T>
concept ShadowedModel = requires(const T& model, Hertz frequency) {
    { model.shadowed_loss(frequency) } -> std::same_as<ShadowedLoss>;
};

/// Model with a random part for each pair of nodes. median() returns the model without the random
/// part; the result equals the model if it has no random part. Pictures of coverage show the
/// median, because a point of a picture has no pair of nodes.
template <class T>
concept RandomModel = requires(const T& model) {
    { model.median() } -> std::same_as<T>;
    { model.is_random() } -> std::same_as<bool>;
};

/// Model valid only at some frequencies; check_frequency throws std::invalid_argument for any other
/// frequency.
template <class T>
concept FrequencyCheckedModel = requires(const T& model, Hertz frequency) {
    model.check_frequency(frequency);
};

/// Model valid only in some scenes; check_scene throws std::invalid_argument for any other scene.
template <class T>
concept SceneCheckedModel = requires(const T& model, const Scene& scene) {
    model.check_scene(scene);
};

}  // namespace rovernet
