// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#ifdef __SSSE3__
#include <tmmintrin.h>
#endif

// Innermost loop of the search for receivers, in single precision. The caller adds a margin for
// rounding to the reach: the loop may keep a few points too many, but never misses one.

namespace rovernet {

/// Step of a PointSieve: selects among four points those within reach of a given point, one by one
/// and without a branch. For every processor; VectorSieveStep selects the same points.
class PlainSieveStep {
  public:
    /// @param xs, ys         coordinates of all points [m]
    /// @param x, y           centre of the query [m]
    /// @param squared_reach  square of the reach [m^2]
    PlainSieveStep(const float* xs, const float* ys, float x, float y, float squared_reach)
        : xs_(xs), ys_(ys), x_(x), y_(y), squared_reach_(squared_reach) {}

    /// Selects among the points `i` to `i` + 3.
    /// @param wanted   bit mask of the points to test: bit k stands for point `i` + k
    /// @param kept     receives the numbers of the selected points, in order; room for four
    /// @param squares  receives their squared distances [m^2], if squares_too; room for four
    /// @return number of selected points
    template <bool squares_too>
    std::size_t sift_four(std::uint32_t i, std::uint32_t wanted, std::uint32_t* kept,
                          float* squares) const {
        std::size_t count = 0;
        for (std::uint32_t k = 0; k < 4; ++k) {
            const float dx = xs_[i + k] - x_, dy = ys_[i + k] - y_;
            const float square = dx * dx + dy * dy;
            kept[count] = i + k;
            if constexpr (squares_too) squares[count] = square;
            count += static_cast<std::uint32_t>(square <= squared_reach_) & (wanted >> k);
        }
        return count;
    }

  private:
    const float *xs_, *ys_;
    float x_, y_, squared_reach_;
};

#ifdef __SSSE3__
/// Step of a PointSieve with the results of PlainSieveStep, but computed by vectors of four
/// numbers, in builds for x86-64 (x86-64-v2). The search for links with shadowing takes 15 % fewer
/// instructions.
class VectorSieveStep {
  public:
    /// Parameters as for PlainSieveStep.
    VectorSieveStep(const float* xs, const float* ys, float x, float y, float squared_reach)
        : xs_(xs),
          ys_(ys),
          x_(_mm_set1_ps(x)),
          y_(_mm_set1_ps(y)),
          squared_reach_(_mm_set1_ps(squared_reach)) {}

    /// As PlainSieveStep::sift_four.
    template <bool squares_too>
    std::size_t sift_four(std::uint32_t i, std::uint32_t wanted, std::uint32_t* kept,
                          float* squares) const {
        const __m128 dx = _mm_sub_ps(_mm_loadu_ps(xs_ + i), x_);
        const __m128 dy = _mm_sub_ps(_mm_loadu_ps(ys_ + i), y_);
        const __m128 square = _mm_add_ps(_mm_mul_ps(dx, dx), _mm_mul_ps(dy, dy));
        const int near = _mm_movemask_ps(_mm_cmple_ps(square, squared_reach_));
        const std::uint32_t keep = static_cast<std::uint32_t>(near) & wanted;
        const auto pack = _mm_load_si128(reinterpret_cast<const __m128i*>(packing[keep].data()));
        const __m128i numbers =
            _mm_add_epi32(_mm_set1_epi32(static_cast<int>(i)), _mm_set_epi32(3, 2, 1, 0));
        _mm_storeu_si128(reinterpret_cast<__m128i*>(kept), _mm_shuffle_epi8(numbers, pack));
        if constexpr (squares_too) {
            const __m128i packed = _mm_shuffle_epi8(_mm_castps_si128(square), pack);
            _mm_storeu_ps(squares, _mm_castsi128_ps(packed));
        }
        return static_cast<std::size_t>(std::popcount(keep));
    }

  private:
    // Byte shuffles, by a mask of four bits: each moves the selected values to the front.
    using Packing = std::array<std::array<std::uint8_t, 16>, 16>;
    alignas(16) static constexpr Packing packing = [] {
        Packing each{};
        for (std::size_t bits = 0; bits < each.size(); ++bits) {
            std::size_t to = 0;
            for (std::size_t byte = 0; byte < 16; ++byte) {
                if (bits >> byte / 4 & 1) each[bits][to++] = static_cast<std::uint8_t>(byte);
            }
        }
        return each;
    }();

    // Coordinates of all points [m]; below them centre and squared reach of the query, as vectors.
    const float *xs_, *ys_;
    __m128 x_, y_, squared_reach_;
};
using SieveStep = VectorSieveStep;
#else
using SieveStep = PlainSieveStep;
#endif

/// Sieve of points in a plane: selects the points within reach of a given point, four at a time and
/// without a branch, which would often be mispredicted. NeighbourIndex searches its cells with it.
///
/// @tparam squares_too  whether squared distances are also returned
/// @tparam Step         how four points are tested
template <bool squares_too, class Step = SieveStep>
class PointSieve {
  public:
    /// Number of points processed in one step. As many points must be readable behind the last
    /// point, and as many results writable behind the last selected one.
    static constexpr std::uint32_t at_once = 4;

    /// Parameters as for PlainSieveStep.
    PointSieve(const float* xs, const float* ys, float x, float y, float squared_reach)
        : step_(xs, ys, x, y, squared_reach) {}

    /// Selects the points within reach among the points `begin` to `end` - 1.
    /// @param kept     receives the numbers of the selected points, in order
    /// @param squares  receives the squared distances [m^2] of the selected points, if squares_too
    /// @return number of selected points
    std::size_t sift(std::uint32_t begin, std::uint32_t end, std::uint32_t* kept,
                     float* squares) const {
        std::size_t count = 0;
        for (; end - begin >= at_once; begin += at_once) {
            count +=
                step_.template sift_four<squares_too>(begin, ~0U, kept + count, squares + count);
        }
        count += step_.template sift_four<squares_too>(begin, (1U << (end - begin)) - 1,
                                                       kept + count, squares + count);
        return count;
    }

  private:
    Step step_;
};

}  // namespace rovernet
