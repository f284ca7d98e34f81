// SPDX-License-Identifier: MIT
#include "pictures/chart/chart.hpp"
#include "pictures/chart/chart_axis.hpp"
#include "pictures/chart/chart_heat_map.hpp"
#include "pictures/chart/chart_style.hpp"
#include "pictures/chart/chart_view.hpp"
#include "pictures/draw/legend.hpp"
#include "pictures/draw/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rovernet {
namespace {

constexpr double note_width = 640;       // [px]
constexpr std::size_t most_in_key = 40;  // series

/// Text quoted for gnuplot, shortened to at most `most` characters. In single quotes neither
/// backslash nor backquote is special. A doubled single quote fails at the beginning of a text in
/// gnuplot, so that a typographic quote replaces it.
std::string in_quotes(const std::string& text, std::size_t most = 100) {
    std::string out = "'";
    for (const char c : shortened(text, most)) {
        const bool control = static_cast<unsigned char>(c) < 0x20;
        out += c == '\'' ? "\xe2\x80\x99" : std::string(1, control ? ' ' : c);
    }
    return out + "'";
}

class Script {
  public:
    explicit Script(const Chart& chart) : chart_(chart), view_(view_of(chart)) {}

    std::string text() {
        head();
        if (view_.points == 0) {
            line("set label 'no results' at graph 0.5, graph 0.5 center");
            line("set xrange [0:1]\nset yrange [0:1]\nplot NaN notitle");
            return out_;
        }
        chart_.kind == ChartKind::heat_map ? cells() : axes_of_series();
        return out_;
    }

  private:
    void line(std::string_view text) {
        out_ += text;
        out_ += '\n';
    }
    template <class... Arguments>
    void line(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
        line(std::string_view(fmt::format(format, std::forward<Arguments>(arguments)...)));
    }

    void head() {
        line("# gnuplot THIS_FILE > chart.svg; for a PNG: set terminal pngcairo noenhanced");
        line("set terminal svg noenhanced size 800,500 font 'DejaVu Sans,12' background 'white'");
        line("set encoding utf8");
        line("set title {}", in_quotes(chart_.title));
        std::string below = in_quotes(chart_.x_label);
        for (const auto& note : wrapped(view_.notes, note_width, 12)) {
            if (!note.empty()) below += " . \"\\n\" . " + in_quotes(note);
        }
        line("set xlabel {}", below);
        line("set ylabel {}", in_quotes(chart_.y_label, 45));
        line("set key outside right top vertical Left reverse{}",
             chart_.legend_title.empty() ? "" : " title " + in_quotes(chart_.legend_title, 30));
        line("set tics nomirror\nset border 3");
    }

    void words(std::string_view axis, const std::vector<std::string>& words) {
        constexpr std::size_t most_of_word = 24;  // characters
        std::string list;
        for (std::size_t i = 0; i < words.size(); ++i) {
            // A per cent sign would begin the format of a number.
            std::string text;
            for (const char c : shortened(words[i], most_of_word))
                text += c == '%' ? "%%" : std::string(1, c);
            list += fmt::format("{}{} {}", i > 0 ? ", " : "", in_quotes(text), i);
        }
        line("set {}tics ({}){}", axis, list,
             axis == "x" && long_words(view_) ? " rotate by -35" : "");
        line("set {}range [-0.5:{}]", axis, static_cast<double>(words.size()) - 0.5);
    }
    void numbers(std::string_view axis, const ChartAxis& shown) {
        line("set {}range [{}:{}]", axis, shown.low, shown.high);
        if (!shown.log) return;
        std::string list;
        for (const auto& tick : shown.ticks) {
            list += fmt::format("{}{} {} {}", list.empty() ? "" : ", ", in_quotes(tick.text),
                                tick.value, tick.text.empty() ? 1 : 0);
        }
        line("set logscale {}\nset {}tics ({})", axis, axis, list);
    }

    void axes_of_series() {
        x_ = number_axis(view_.x_range, chart_.log_x, most_ticks, chart_.x_limits);
        y_ = number_axis(view_.y_range, chart_.log_y, most_ticks, view_.y_limits);
        view_.has_words ? words("x", view_.words) : numbers("x", x_);
        numbers("y", y_);
        line("set grid back linecolor rgb '#e4e4e4'");
        if (chart_.kind == ChartKind::bars) bars();
        if (chart_.kind == ChartKind::scatter) labels();
        for (std::size_t i = 0; i < view_.series.size(); ++i) block(i);
        std::vector<std::string> clauses;
        for (std::size_t i = 0; i < view_.series.size(); ++i) plots(i, clauses);
        for (std::size_t i = 0; i < clauses.size(); ++i) {
            line("{}{}{}", i == 0 ? "plot " : "     ", clauses[i],
                 i + 1 < clauses.size() ? ", \\" : "");
        }
    }

    void bars() {
        const auto count = static_cast<double>(view_.series.size());
        line("set style fill solid 0.75 border\nset boxwidth {}", bars_at_word / count);
    }
    void labels() {
        for (const auto& points : view_.series) {
            for (const auto& p : points) {
                if (p.source->label.empty()) continue;
                line("set label {} at first {}, first {} offset 0.8,0.4 font ',10'",
                     in_quotes(p.source->label, 40), p.x, p.y);
            }
        }
    }

    /// The points of a series: an empty line breaks a line.
    void block(std::size_t series) {
        line("$series{} << EOD", series);
        const auto& points = view_.series[series];
        const bool cdf = chart_.kind == ChartKind::cdf;
        line(cdf ? "# x share" : "# x y low high n");
        const double offset =
            chart_.kind == ChartKind::bars ? bar_offset(series, view_.series.size()) : 0;
        if (cdf && !points.empty()) line("{} 0", x_.low);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const DrawnPoint& p = points[i];
            if (cdf) {
                line("{} {}", p.x, p.y);
                continue;
            }
            if (chart_.kind == ChartKind::lines && i > 0 && !p.joined) line("");
            row(p, offset);
        }
        if (cdf && !points.empty()) line("{} 1", x_.high);
        line("EOD");
    }
    void row(const DrawnPoint& p, double offset) {
        if (!p.low && !p.high) {
            line("{} {} NaN NaN {}", p.x + offset, p.y, p.source->n);
            return;
        }
        // Intervals end at a logarithmic axis: there is nothing below it to draw to.
        const double low = std::max(p.low.value_or(p.y), y_.log ? y_.low : p.low.value_or(p.y));
        line("{} {} {} {} {}", p.x + offset, p.y, low, p.high.value_or(p.y), p.source->n);
    }

    /// Appends what `plot` draws of a series.
    void plots(std::size_t series, std::vector<std::string>& clauses) const {
        if (view_.series[series].empty()) return;
        const ChartStyle style = style_in(chart_, series);
        const std::string color = fmt::format("linecolor rgb '{}'", hex(style.color));
        const std::string dashes = fmt::format("({})", fmt::join(style.dashes, ","));
        const std::string line_style =
            fmt::format("{} linewidth 2 dashtype {}", color, style.dashes.empty() ? "1" : dashes);
        const std::string point = fmt::format("pointtype {} pointsize 0.6", style.marker.gnuplot);
        const auto clause = [&](const std::string& with) {
            return fmt::format("$series{} using 1:2 with {} {}", series, with, title(series));
        };
        const bool bars = chart_.kind == ChartKind::bars && !view_.dots;
        if (bars) clauses.push_back(clause("boxes " + color));
        intervals(series, bars ? "linecolor rgb '#222222'" : color, clauses);
        if (chart_.kind == ChartKind::lines && !style.hollow) {
            clauses.push_back(clause("linespoints " + line_style + " " + point));
        } else if (chart_.kind == ChartKind::cdf) {
            clauses.push_back(clause("steps " + line_style));
        } else if (!bars) {
            clauses.push_back(clause("points " + color + " " + point));
        }
    }
    std::string title(std::size_t series) const {
        const std::string& name = chart_.series[series].name;
        return series < most_in_key && !name.empty() ? "title " + in_quotes(name, 30) : "notitle";
    }
    void intervals(std::size_t series, const std::string& color,
                   std::vector<std::string>& clauses) const {
        if (!has_intervals(view_.series[series])) return;
        if (chart_.kind == ChartKind::lines && has_band(view_, series)) {
            clauses.push_back(
                fmt::format("$series{} using 1:3:4 with filledcurves fillstyle "
                            "transparent solid 0.16 noborder {} notitle",
                            series, color));
        } else {
            // The style of error bars, yerrorbars, leaves gaps around the points.
            clauses.push_back(
                fmt::format("$series{} using 1:3:(0):($4-$3) with vectors heads size graph "
                            "0.006,90 {} notitle",
                            series, color));
        }
    }
    static bool has_intervals(const std::vector<DrawnPoint>& points) {
        return std::any_of(points.begin(), points.end(),
                           [](const DrawnPoint& p) { return p.low || p.high; });
    }

    void palette() {
        constexpr int colors = 12;
        std::string list;
        for (int i = 0; i <= colors; ++i) {
            const double share = i / double{colors};
            list += fmt::format("{}{} '{}'", i > 0 ? ", " : "", i, hex(lagoon.at(share)));
        }
        line("set palette defined ({})", list);
    }
    void cells() {
        constexpr std::size_t most_texts = 400;
        std::vector<std::string> names;
        for (const auto& series : chart_.series) names.push_back(series.name);
        words("x", view_.words);
        words("y", names);
        const ChartAxis values = number_axis(view_.y_range, false, most_ticks, view_.y_limits);
        numbers("cb", values);
        line("set cblabel {}", in_quotes(chart_.value_label, 45));
        palette();
        line("set style fill solid 1 noborder\n$cells << EOD\n# column row value n");
        for (std::size_t row = 0; row < view_.series.size(); ++row) {
            for (const auto& p : view_.series[row]) {
                line("{} {} {} {}", p.x, row, p.y, p.source->n);
            }
        }
        line("EOD");
        const bool texts = view_.points <= most_texts;
        line("plot $cells using 1:2:(0.5):(0.5):3 with boxxyerror linecolor palette notitle{}",
             texts ? ", \\" : "");
        if (!texts) return;
        line(
            "     $cells using 1:2:(sprintf('%.3g', $3)):($3 < {} ? 0xffffff : 0x111111) with "
            "labels font ',9' textcolor rgb variable notitle",
            dark_text_from(values));
    }

    const Chart& chart_;
    ChartView view_;
    ChartAxis x_ = {}, y_ = {};
    std::string out_ = {};
};

}  // namespace

std::string chart_gnuplot(const Chart& chart) { return Script(chart).text(); }

}  // namespace rovernet
