// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace rovernet {

/// One axis of a grid whose cells wrap around: so many cells, each so wide, serve the whole line.
class WrappedAxis {
  public:
    explicit WrappedAxis(double width = 1, std::size_t cells = 1)
        : width_(width), per_meter_(1 / width), cells_(cells) {}

    double width() const { return width_; }       ///< [m] of a cell
    std::size_t cells() const { return cells_; }  ///< of the axis

    /// The cell of `x` [m].
    std::size_t cell_at(double x) const { return wrapped(unwrapped(x)); }

    /// Cells in one row, or in two where they wrap around: the second begins with cell 0.
    struct Cells {
        std::size_t begin, end, wrapped_end;

        std::size_t count() const { return end - begin + wrapped_end; }
        /// Calls use(begin, end) for each row.
        template <class Use>
        void each(Use use) const {
            use(begin, end);
            if (wrapped_end > 0) use(std::size_t{0}, wrapped_end);
        }
    };
    /// Those from `centre` - `reach` to `centre` + `reach` [m], each once; `reach` may be infinite.
    Cells near(double centre, double reach) const {
        const double rounding = 1e-9 * (std::abs(centre) + reach);
        const std::int64_t first = unwrapped(centre - reach - rounding);
        const std::int64_t last = unwrapped(centre + reach + rounding);
        const auto count = std::min(static_cast<std::size_t>(last - first) + 1, cells_);
        const std::size_t begin = wrapped(first), end = begin + count;
        return {begin, std::min(end, cells_), end > cells_ ? end - cells_ : 0};
    }

  private:
    static constexpr double far = 1e15;  // [cells] positions beyond it share the last cell

    std::int64_t unwrapped(double x) const {
        return static_cast<std::int64_t>(std::floor(std::min(far, std::max(-far, x * per_meter_))));
    }
    std::size_t wrapped(std::int64_t cell) const {
        const auto n = static_cast<std::int64_t>(cells_);
        // Most are on the axis as they are: a division would take longer than all else here.
        const std::int64_t rest = cell >= 0 && cell < n ? cell : cell % n;
        return static_cast<std::size_t>(rest < 0 ? rest + n : rest);
    }

    double width_;
    double per_meter_;  // [cells]
    std::size_t cells_;
};

}  // namespace rovernet
