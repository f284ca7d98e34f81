// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <tmmintrin.h>

// Innermost loop of the search for receivers, in single precision. The caller adds a margin for
// rounding to the reach: the loop may keep a few points too many, but never misses one.

namespace rovernet {

/// Sieve of points in a plane: selects the points within reach of a given point, four at a time and
/// without a branch, which would often be mispredicted. NeighbourIndex searches its cells with it.
/// The code needs SSSE3, which every build has (x86-64-v2): the search for links with shadowing
/// takes 15 % fewer instructions.
///
/// @tparam squares_too  whether squared distances are also returned
template <bool squares_too>
class PointSieve {
  public:
    /// Number of points processed in one step. As many points must be readable behind the last
    /// point, and as many results writable behind the last selected one.
    static constexpr std::uint32_t at_once = 4;

    /// @param xs, ys         coordinates of all points [m]
    /// @param x, y           centre of the query [m]
    /// @param squared_reach  square of the reach [m^2]
    PointSieve(const float* xs, const float* ys, float x, float y, float squared_reach)
        : xs_(xs), ys_(ys), x_(all(x)), y_(all(y)), squared_reach_(all(squared_reach)) {}

    /// Selects the points within reach among the points `begin` to `end` - 1.
    /// @param kept     receives the numbers of the selected points, in order
    /// @param squares  receives the squared distances [m^2] of the selected points, if squares_too
    /// @return number of selected points
    std::size_t sift(std::uint32_t begin, std::uint32_t end, std::uint32_t* kept,
                     float* squares) const {
        std::size_t count = 0;
        for (; end - begin >= at_once; begin += at_once) {
            count += sift_four(begin, ~0U, kept + count, squares + count);
        }
        count += sift_four(begin, (1U << (end - begin)) - 1, kept + count, squares + count);
        return count;
    }

  private:
    using Floats = __m128;
    // Vector of four equal numbers.
    static Floats all(float x) { return _mm_set1_ps(x); }

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

    // Processes the points `i` to `i` + 3; `wanted` has a bit for each point to be tested.
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

    // Coordinates of all points [m]; below them centre and squared reach of the query, as vectors.
    const float *xs_, *ys_;
    Floats x_, y_, squared_reach_;
};

}  // namespace rovernet
