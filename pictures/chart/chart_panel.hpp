// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/chart/chart.hpp"
#include "pictures/chart/chart_axis.hpp"
#include "pictures/chart/chart_marks.hpp"
#include "pictures/chart/chart_view.hpp"
#include "pictures/draw/legend.hpp"
#include "pictures/draw/svg.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// Chart of a picture: its texts, axes, marks and legend in a column of a given width. All its
/// places are from the upper left corner of that column's part between the axes and their texts.
class ChartPanel {
  public:
    /// @param chart   lives longer
    /// @param number  of the chart in its document
    ChartPanel(const Chart& chart, const ChartLayout& layout, std::size_t number);

    double head() const;  ///< [px] above the part between the axes
    double foot() const;  ///< [px] below it
    /// Draws it with the part between its axes below corner.y.
    /// @param head_of_row  [px] from there up to its title
    void draw(Svg& svg, PicturePoint corner, double head_of_row) const;

  private:
    bool heat_map() const { return chart_.kind == ChartKind::heat_map; }
    void place_axes(double height);
    void place_left();
    void place_below();
    std::size_t stride_below() const;
    std::vector<std::string> notes() const;
    void append_ticks(SvgPath& lines, SvgPath& ticks) const;
    void draw_axes(Svg& svg) const;
    void draw_points(Svg& svg) const;
    void draw_texts_beside(Svg& svg) const;
    void draw_texts_below(Svg& svg) const;
    void draw_labels(Svg& svg) const;
    void draw_foot(Svg& svg) const;

    const Chart& chart_;
    double width_;  // [px]
    std::size_t number_;
    ChartView view_;
    ChartFrame frame_ = {};
    ChartAxis colors_ = {};
    std::vector<std::string> title_ = {}, notes_ = {};
    Legend legend_ = {};
    bool slanted_ = false;    // the texts below the x axis
    double texts_below_ = 0;  // [px] that they need
};

/// A text cut to fit into `width` [px].
std::string fitted(std::string_view text, double width, double size);

}  // namespace rovernet
