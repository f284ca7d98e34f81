// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#ifdef __SSSE3__
#include <tmmintrin.h>
#endif

// The innermost loop of the search for receivers, in single precision: it keeps a few points too
// many rather than one too few, as its caller adds what rounding may take.

namespace rovernet {

/// Sieve of points in a plane: picks those within reach of one, four at a time where the processor
/// can, and without a branch, which would be mispredicted for many. NeighbourIndex looks at its
/// cells with it.
///
/// @tparam squares_too  whether squared distances are wanted
template <bool squares_too>
class PointSieve {
  public:
    /// Points that are read at once: behind the last one there must be as many to read, and behind
    /// the last one kept as many places to write.
    static constexpr std::uint32_t at_once = 4;

    /// Makes a sieve of points for those within reach of (x, y) [m].
    /// @param xs, ys         coordinates of all points [m]
    /// @param squared_reach  square of the reach [m^2]
    PointSieve(const float* xs, const float* ys, float x, float y, float squared_reach)
        : xs_(xs), ys_(ys), x_(all(x)), y_(all(y)), squared_reach_(all(squared_reach)) {}

    /// Sifts the points from `begin` to `end`. Both compilations, with SSSE3 and without, keep the
    /// same ones.
    /// @param kept     gets the numbers of those that are kept, in order
    /// @param squares  gets their squared distances [m^2], if they are wanted
    /// @return how many are kept
    std::size_t sift(std::uint32_t begin, std::uint32_t end, std::uint32_t* kept,
                     float* squares) const {
        std::size_t count = 0;
#ifdef __SSSE3__
        for (; end - begin >= at_once; begin += at_once) {
            count += sift_four(begin, ~0U, kept + count, squares + count);
        }
        count += sift_four(begin, (1U << (end - begin)) - 1, kept + count, squares + count);
#else
        for (; begin < end; ++begin) {
            const float dx = xs_[begin] - x_, dy = ys_[begin] - y_;
            const float square = dx * dx + dy * dy;
            kept[count] = begin;
            if constexpr (squares_too) squares[count] = square;
            count += square <= squared_reach_;
        }
#endif
        return count;
    }

  private:
#ifdef __SSSE3__
    using Floats = __m128;
    // Four times the same number.
    static Floats all(float x) { return _mm_set1_ps(x); }

    // Shuffles of the bytes of four values that pack those that bits tell to the front.
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

    // Sifts points `i` to `i` + 3 among `wanted`, a bit for each.
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
#else
    using Floats = float;
    static Floats all(float x) { return x; }
#endif

    // Points; the place and the squared reach, as many times as points are looked at at once.
    const float *xs_, *ys_;
    Floats x_, y_, squared_reach_;
};

}  // namespace rovernet
