// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/draw/plot.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace rovernet {

/// Axis-parallel box of a picture [px]; y points down.
struct Box {
    double left = 0, top = 0, right = 0, bottom = 0;

    bool overlaps(const Box& b) const {
        return left < b.right && b.left < right && top < b.bottom && b.top < bottom;
    }
    bool inside(const Box& b) const {
        return left >= b.left && right <= b.right && top >= b.top && bottom <= b.bottom;
    }
};

/// Placement of labels beside points, so that labels overlap neither each other nor other parts of
/// the picture.
class LabelPlaces {
  public:
    /// @param area  box of the picture inside which labels must lie
    explicit LabelPlaces(const Box& area);

    /// Reserves a box of the picture: no label is placed there from now on.
    void keep_free(const Box& box);
    /// Adds a line of the picture. place() puts labels on such lines only if all free places lie on
    /// lines.
    void avoid(PicturePoint from, PicturePoint to);
    /// Finds and reserves a free place for a label beside a disc. The candidates are the places
    /// right, left, above, below, then at the corners. The first candidate that lies on the fewest
    /// lines is chosen. None if no place is free.
    std::optional<Box> place(PicturePoint centre, double radius, double width, double height);
    /// Finds and reserves a free place for a label below or above the end of a vertical line. The
    /// label is centred on the line, or shifted sideways by at most half its width if other labels
    /// require a shift. None if no place is free.
    std::optional<Box> place_at_end(PicturePoint end, bool below, double width, double height);

  private:
    struct Tile {
        std::vector<Box> taken;
        std::vector<PicturePoint> lines;  // points along lines that labels avoid
    };

    bool free(const Box& box) const;
    std::size_t points_of_lines(const Box& box) const;
    template <class Visit>
    void for_each_tile(const Box& box, Visit visit) const;

    Box area_;
    std::size_t columns_ = 1, rows_ = 1;
    // Reserved places by tile, so that a search with many labels stays fast.
    std::vector<Tile> tiles_;
};

}  // namespace rovernet
