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

/// Layout and drawing of one chart: texts, axes, marks and legend in a column of a given width.
/// Coordinates are relative to the upper left corner of the column's plot area.
class ChartPanel {
  public:
    /// @param chart   must outlive the panel
    /// @param number  number of the chart in the SVG document, from 0
    ChartPanel(const Chart& chart, const ChartLayout& layout, std::size_t number);

    double head() const;  ///< height of the texts above the plot area [px]
    double foot() const;  ///< height of the texts below the plot area [px]
    /// Draws the chart with the top of the plot area at corner.y.
    /// @param head_of_row  distance from corner.y up to the title of the chart [px]
    void draw(Svg& svg, PicturePoint corner, double head_of_row) const;

  private:
    bool heat_map() const { return chart_.kind == ChartKind::heat_map; }
    void place_axes(double height);
    void place_numbers();
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
    double width_;  // width of the column [px]
    std::size_t number_;
    ChartView view_;
    ChartFrame frame_ = {};
    ChartAxis colors_ = {};
    std::vector<std::string> title_ = {}, notes_ = {};
    Legend legend_ = {};
    bool slanted_ = false;    // whether labels of the x axis are slanted
    double texts_below_ = 0;  // height of the x axis's labels [px]
};

/// Text, shortened to fit into `width` [px] at text size `size` [px].
std::string fitted(std::string_view text, double width, double size);

}  // namespace rovernet
