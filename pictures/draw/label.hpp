// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/draw/plot.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace rovernet {

/// An upright box of a picture [px]; y points down.
struct Box {
    double left = 0, top = 0, right = 0, bottom = 0;

    bool overlaps(const Box& b) const {
        return left < b.right && b.left < right && top < b.bottom && b.top < bottom;
    }
    bool inside(const Box& b) const {
        return left >= b.left && right <= b.right && top >= b.top && bottom <= b.bottom;
    }
};

/// Keeps labels of points apart from one another, and from what else is in the way.
class LabelPlaces {
  public:
    /// @param area  labels stay inside
    explicit LabelPlaces(const Box& area);

    /// Takes a place: nothing is put there from now on.
    void keep_free(const Box& box);
    /// A line that labels should rather not lie on.
    void avoid(PicturePoint from, PicturePoint to);
    /// A free place for a label of that size beside a disc: right, left, above, below, then at the
    /// corners; the first that lies on the fewest lines. It counts as taken from now on. None if
    /// every place is taken.
    std::optional<Box> place(PicturePoint centre, double radius, double width, double height);
    /// A free place for a label of that size below the end of an upright line, or above it: as near
    /// to its middle as others let it, and never wholly to one side. It counts as taken from now
    /// on. None if every place is taken.
    std::optional<Box> place_at_end(PicturePoint end, bool below, double width, double height);

  private:
    struct Tile {
        std::vector<Box> taken;
        std::vector<PicturePoint> lines;  // points along them
    };

    bool free(const Box& box) const;
    std::size_t points_of_lines(const Box& box) const;
    template <class Visit>
    void for_each_tile(const Box& box, Visit visit) const;

    Box area_;
    std::size_t columns_ = 1, rows_ = 1;
    std::vector<Tile> tiles_;  // places taken, by tile, so that many labels stay cheap
};

}  // namespace rovernet
