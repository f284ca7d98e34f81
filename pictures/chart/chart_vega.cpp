// SPDX-License-Identifier: MIT
#include "pictures/chart/chart.hpp"
#include "pictures/chart/chart_axis.hpp"
#include "pictures/chart/chart_heat_map.hpp"
#include "pictures/chart/chart_style.hpp"
#include "pictures/chart/chart_view.hpp"
#include "pictures/draw/legend.hpp"
#include "scenario/document/json.hpp"

#include <fmt/format.h>

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace rovernet {
namespace {

constexpr int width = 560;  // [px] between the axes
constexpr const char* with_interval = "isValid(datum.low) && isValid(datum.high)";

Value object(std::initializer_list<std::pair<const char*, Value>> entries) {
    Table out;
    for (const auto& [key, value] : entries) out.set(key, value);
    return out;
}

Value list(const std::vector<std::string>& texts) { return Array(texts.begin(), texts.end()); }

Value or_null(const std::string& text) { return text.empty() ? Value() : Value(text); }

class Specification {
  public:
    explicit Specification(const Chart& chart) : chart_(chart), view_(view_of(chart)) {
        for (const auto& series : chart.series) names_.push_back(series.name);
        x_ = number_axis(view_.x_range, chart.log_x, most_ticks, chart.x_limits);
        y_ = number_axis(view_.y_range, chart.log_y, most_ticks, view_.y_limits);
    }

    Value value() const {
        Table out;
        out.set("$schema", "https://vega.github.io/schema/vega-lite/v5.json");
        std::vector<std::string> notes;
        if (!view_.notes.empty()) notes = wrapped(view_.notes, width, 12);
        out.set("title", object({{"text", chart_.title}, {"subtitle", list(notes)}}));
        // Titles of axes are given, or Vega-Lite writes them into expressions, with quotes and all.
        out.set("config", object({{"aria", false},
                                  {"title", object({{"limit", 700}})},
                                  {"axis", object({{"titleLimit", 500}})}}));
        out.set("width", width);
        out.set("height", 320);
        if (view_.points == 0) {
            out.set("data", object({{"values", Array{object({{"text", "no results"}})}}}));
            out.set("mark", object({{"type", "text"}, {"fontSize", 14}}));
            out.set("encoding", object({{"text", object({{"field", "text"}})}}));
            return out;
        }
        const bool cells = chart_.kind == ChartKind::heat_map;
        out.set("data", object({{"values", rows()}}));
        out.set("encoding", cells ? cells_encoding() : encoding());
        out.set("layer", cells ? cell_layers() : layers());
        return out;
    }

  private:
    /// Rows of the data, one for each point; `part` counts the pieces of a broken line.
    Value rows() const {
        Array out;
        for (std::size_t i = 0; i < view_.series.size(); ++i) {
            if (chart_.kind == ChartKind::cdf) add_end(out, i, x_.low, 0);
            int part = 0;
            for (const auto& p : view_.series[i]) {
                part += p.joined ? 0 : 1;
                out.push_back(row(i, p, part));
            }
            if (chart_.kind == ChartKind::cdf) add_end(out, i, x_.high, 1);
        }
        return out;
    }
    Value row(std::size_t series, const DrawnPoint& p, int part) const {
        Table out;
        out.set("series", names_[series]);
        if (view_.has_words) {
            out.set("x", view_.words[static_cast<std::size_t>(p.x)]);
        } else {
            out.set("x", p.x);
        }
        out.set("y", p.y);
        if (chart_.kind == ChartKind::cdf) return out;
        out.set("low", p.low);
        out.set("high", p.high);
        out.set("n", p.source->n);
        if (!p.source->label.empty()) out.set("label", p.source->label);
        if (chart_.kind == ChartKind::lines) out.set("part", part);
        return out;
    }
    /// Points where the steps of a series begin and end.
    void add_end(Array& rows, std::size_t series, double x, double share) const {
        if (view_.series[series].empty()) return;
        rows.push_back(object({{"series", names_[series]}, {"x", x}, {"y", share}}));
    }

    static Value tooltip() { return object({{"content", "data"}}); }

    static Value scale(const ChartAxis& axis) {
        return object({{"type", axis.log ? "log" : "linear"},
                       {"domain", Array{axis.low, axis.high}},
                       {"nice", false},
                       {"clamp", true}});
    }
    Value words(const char* field, const std::string& title, const std::vector<std::string>& order,
                int angle) const {
        return object({{"field", field},
                       {"type", "nominal"},
                       {"sort", list(order)},
                       {"axis", object({{"labelAngle", angle}})},
                       {"title", or_null(title)}});
    }
    Value x() const {
        if (view_.has_words)
            return words("x", chart_.x_label, view_.words, long_words(view_) ? -35 : 0);
        return object({{"field", "x"},
                       {"type", "quantitative"},
                       {"title", or_null(chart_.x_label)},
                       {"scale", scale(x_)}});
    }
    Value y(const char* field) const {
        return object({{"field", field},
                       {"type", "quantitative"},
                       {"title", or_null(chart_.y_label)},
                       {"scale", scale(y_)}});
    }
    Value by_series(Array range) const {
        return object({{"field", "series"},
                       {"type", "nominal"},
                       {"title", or_null(chart_.legend_title)},
                       {"legend", object({{"symbolOpacity", 1}})},
                       {"scale", object({{"domain", list(names_)}, {"range", std::move(range)}})}});
    }

    Value colors() const {
        Array range;
        for (std::size_t i = 0; i < names_.size(); ++i) range.push_back(hex(chart_style(i).color));
        return by_series(range);
    }
    Value shapes() const {
        Array range;
        for (std::size_t i = 0; i < names_.size(); ++i) range.push_back(chart_style(i).marker.vega);
        return by_series(range);
    }
    Value dashes() const {
        Array range;
        for (std::size_t i = 0; i < names_.size(); ++i) {
            const auto lengths = chart_style(i).dashes;
            range.push_back(Array(lengths.begin(), lengths.end()));
        }
        return by_series(range);
    }

    Value encoding() const {
        Table out;
        out.set("x", x());
        out.set("color", colors());
        if (chart_.kind == ChartKind::lines) out.set("detail", object({{"field", "part"}}));
        if (chart_.kind == ChartKind::bars) {
            out.set("xOffset", object({{"field", "series"}, {"sort", list(names_)}}));
        }
        return out;
    }
    static Value mark_layer(Value mark, Value layer_encoding) {
        return object({{"mark", std::move(mark)}, {"encoding", std::move(layer_encoding)}});
    }
    Value line_layer() const {
        const bool steps = chart_.kind == ChartKind::cdf;
        return mark_layer(
            object({{"type", "line"}, {"interpolate", steps ? "step-after" : "linear"}}),
            object({{"y", y("y")}, {"strokeDash", dashes()}}));
    }
    Value points_layer() const {
        return mark_layer(object({{"type", "point"},
                                  {"filled", true},
                                  {"size", 45},
                                  {"opacity", 1},
                                  {"tooltip", tooltip()}}),
                          object({{"y", y("y")}, {"shape", shapes()}}));
    }
    Value bars_layer() const {
        return mark_layer(object({{"type", "bar"}, {"opacity", 0.8}, {"tooltip", tooltip()}}),
                          object({{"y", y("y")}}));
    }
    Value intervals_layer(bool band, bool dark) const {
        Table out;
        out.set("transform", Array{object({{"filter", with_interval}})});
        out.set("mark",
                band ? object({{"type", "area"}, {"opacity", 0.16}}) : object({{"type", "rule"}}));
        Table ends;
        ends.set("y", y("low"));
        ends.set("y2", object({{"field", "high"}}));
        if (dark) ends.set("color", object({{"value", "#222222"}}));
        out.set("encoding", ends);
        return out;
    }
    Value labels_layer() const {
        return mark_layer(object({{"type", "text"}, {"align", "left"}, {"dx", 7}, {"dy", -5}}),
                          object({{"y", y("y")},
                                  {"text", object({{"field", "label"}, {"type", "nominal"}})},
                                  {"color", object({{"value", "#222222"}})}}));
    }
    bool any_band() const {
        for (std::size_t i = 0; i < view_.series.size(); ++i) {
            if (has_band(view_, i)) return true;
        }
        return false;
    }

    Value layers() const {
        switch (chart_.kind) {
            case ChartKind::lines:
                return Array{intervals_layer(any_band(), false), line_layer(), points_layer()};
            case ChartKind::bars:
                if (!view_.dots) return Array{bars_layer(), intervals_layer(false, true)};
                return Array{intervals_layer(false, false), points_layer()};
            case ChartKind::cdf: return Array{line_layer()};
            default: return Array{intervals_layer(false, false), points_layer(), labels_layer()};
        }
    }

    Value cells_encoding() const {
        const std::vector<std::string> downwards(names_.rbegin(), names_.rend());
        return object({{"x", words("x", chart_.x_label, view_.words, long_words(view_) ? -35 : 0)},
                       {"y", words("series", chart_.y_label, downwards, 0)}});
    }
    Value cell_layers() const {
        constexpr std::size_t most_texts = 400;
        constexpr int colors = 12;
        Array range, out;
        for (int i = 0; i <= colors; ++i) range.push_back(hex(lagoon.at(i / 12.0)));
        const Value color =
            object({{"field", "y"},
                    {"type", "quantitative"},
                    {"title", or_null(chart_.value_label)},
                    {"scale", object({{"domain", Array{y_.low, y_.high}}, {"range", range}})}});
        out.push_back(mark_layer(object({{"type", "rect"}, {"tooltip", tooltip()}}),
                                 object({{"color", color}})));
        if (view_.points > most_texts) return out;
        const std::string is_dark = fmt::format("datum.y >= {}", dark_text_from(y_));
        out.push_back(mark_layer(
            object({{"type", "text"}}),
            object(
                {{"text", object({{"field", "y"}, {"type", "quantitative"}, {"format", ".3g"}})},
                 {"color", object({{"condition", object({{"test", is_dark}, {"value", "#111111"}})},
                                   {"value", "#ffffff"}})}})));
        return out;
    }

    const Chart& chart_;
    ChartView view_;
    ChartAxis x_ = {}, y_ = {};
    std::vector<std::string> names_ = {};
};

}  // namespace

std::string chart_vega_lite(const Chart& chart) { return to_json(Specification(chart).value()); }

}  // namespace rovernet
