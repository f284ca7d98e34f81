// SPDX-License-Identifier: MIT
#include "pictures/map/picture.hpp"

#include "experiment/build.hpp"
#include "experiment/reports/range_of_model.hpp"
#include "experiment/reports/scene_report.hpp"
#include "experiment/run.hpp"
#include "mobility/planners.hpp"
#include "models/link_gain.hpp"
#include "pictures/map/heat_layer.hpp"
#include "pictures/map/link_lines.hpp"
#include "pictures/map/map_axes.hpp"
#include "pictures/map/map_layer.hpp"
#include "pictures/map/margin_survey.hpp"
#include "pictures/map/picture_caption.hpp"
#include "pictures/map/robot_marks.hpp"
#include "pictures/map/route_lines.hpp"
#include "pictures/map/search_marks.hpp"
#include "pictures/map/trail_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

namespace rovernet {
namespace {

constexpr double margin = 16;        // [px] around everything
constexpr double title_size = 16;    // [px]
constexpr double bold = 1.15;        // times as wide as other text, at most
constexpr double caption_size = 12;  // [px]
constexpr double title_line = 22;    // [px]
constexpr double caption_line = 17;  // [px]
constexpr Color faint{0x44, 0x44, 0x44};
constexpr double part_gap = 10;  // [px] between the parts
constexpr std::uint32_t most_robots = 100'000;
// A picture is laid out in points ("px" below). Its width is 1200 points at the default text size;
// a larger text size means fewer points, with everything else unchanged.
constexpr double page_width = 1200, usual_font_size = 12;

void check_range(const char* name, double value, double low, double high) {
    if (value >= low && value <= high) return;
    throw std::invalid_argument(
        fmt::format("picture: {} must be from {} to {}, got {}", name, low, high, value));
}

/// The lines above a picture.
class Heading {
  public:
    Heading(const std::string& title, const std::vector<std::string>& parts, double width)
        : titles_(wrapped({title}, width, bold * title_size)),
          captions_(wrapped(parts, width, caption_size)) {}

    double height() const {
        return title_line * static_cast<double>(titles_.size()) +
               caption_line * static_cast<double>(captions_.size());
    }
    void draw(Svg& svg) const {
        double y = margin - 2;
        for (const auto& line : titles_) {
            svg.text(margin, y + title_size, line, {.size = title_size, .bold = true});
            y += title_line;
        }
        for (const auto& line : captions_) {
            svg.text(margin, y + caption_size, line, {.size = caption_size, .color = faint});
            y += caption_line;
        }
    }

  private:
    std::vector<std::string> titles_;
    std::vector<std::string> captions_;
};

/// Draws one scenario at one time.
class Painter {
  public:
    Painter(const Scenario& scenario, const PictureOptions& options);
    std::string paint();

  private:
    void run();
    /// Number of the storey that is drawn; the lowest is 0.
    std::size_t storey() const { return static_cast<std::size_t>(options_.storey - 1); }
    void check_storey() const;
    Extent extent() const;
    Plot plot() const;
    void check_levels() const;
    /// Distance from a robot whose coverage is drawn up to which an open field is shown [m].
    double shown_reach(const Transmitter& transmitter, const Extent& robots) const;
    /// Whether the coverage of the robot is drawn.
    bool is_source(NodeId node) const {
        return std::find(sources_.begin(), sources_.end(), node) != sources_.end();
    }
    /// Room for the colour bar beside the plot [px]; 0 if there is none.
    double bar_room() const {
        const bool has_levels = !transmitters_.empty() && !range_of(transmitters_.front().model);
        return has_levels ? part_gap + HeatLayer::bar_width : 0;
    }
    Legend legend(const Plot& plot, const RobotMarks& robots) const;
    void draw_world(Svg& svg, const Plot& plot, const RobotMarks& robots) const;

    const Scenario& scenario_;
    const PictureOptions& options_;
    double width_;  // of the picture, in its own points
    Network network_;
    std::shared_ptr<Trails> trails_ = std::make_shared<Trails>();
    std::vector<NodeId> sources_ = {};
    std::optional<NodeId> receiver_ = std::nullopt;
    std::vector<Transmitter> transmitters_ = {};
    std::optional<MarginSurvey> survey_ = std::nullopt;
    std::optional<MapLayer> map_ = std::nullopt;
    std::optional<HeatLayer> heat_ = std::nullopt;
    std::optional<TrailLines> ways_ = std::nullopt;
    std::optional<LinkLines> links_ = std::nullopt;
    std::optional<RouteLines> route_ = std::nullopt;
    std::shared_ptr<LastSearch> search_ = std::make_shared<LastSearch>();
};

Painter::Painter(const Scenario& scenario, const PictureOptions& options)
    : scenario_(scenario),
      options_(options),
      width_(page_width * usual_font_size / options.font_size),
      network_(network_settings(scenario)) {
    check_range("width", options.width, 100, 10'000);
    check_range("font size", options.font_size, 4, 36);
    check_range("cells", options.cells, 1, most_coverage_cells);
    if (options.at < start_of_run) throw std::invalid_argument("picture: at must be >= 0 s");
}

void Painter::check_storey() const {
    const std::size_t all = network_.scene().storeys().size();
    if (options_.storey >= 1 && storey() < all) return;
    throw std::invalid_argument(
        all == 1
            ? fmt::format("picture: the scene has one storey, got storey {}", options_.storey)
            : fmt::format("picture: storey must be from 1 to {}, got {}", all, options_.storey));
}

void Painter::run() {
    check_storey();
    if (options_.trails) network_.add_sink(trails_);
    if (options_.search) network_.add_sink(search_);
    populate(network_, scenario_);
    if (network_.size() > most_robots) {
        throw RunError(fmt::format("a picture of {} robots cannot be drawn; expected at most {}",
                                   network_.size(), most_robots));
    }
    sources_ = partners_named(network_, options_.coverage, {}, "--coverage");
    if (options_.receiver) receiver_ = robot_named(network_, *options_.receiver);
    const auto& route = options_.route;
    const NodeId from = route ? robot_named(network_, route->from) : NodeId{};
    const NodeId to = route ? robot_named(network_, route->to) : NodeId{};
    if (route) search_->only(from);
    if (options_.trails && !options_.margin_to.empty()) {
        survey_.emplace(network_, partners_named(network_, options_.margin_to, {}, "--margin-to"),
                        partners_named(network_, options_.over, {}, "--over"));
        survey_->run_until(options_.at);
    }
    network_.run_until(options_.at);

    if (route) route_.emplace(route_way(network_, from, to));
    const Scene& scene = network_.scene();
    map_.emplace(scene.storey(storey()), network_.planners().scene().storey(storey()));
    for (const Door& door : doors_of(scenario_.scene)) {
        const bool here = scene.storeys().number_at(door.from.z) == storey();
        if (here) map_->add_door(door.corners(), door.is_closed(options_.at));
    }
    for (const Stairs& each : stairs_of(scenario_, scene.storeys())) {
        const auto is_here = [&](Vec3 p) { return scene.storeys().number_at(p.z) == storey(); };
        if (is_here(each.foot) || is_here(each.head)) map_->add_stairs(each.foot, each.head);
    }
    for (const NodeId source : sources_) {
        transmitters_.push_back(transmitter(network_, source, receiver_.value_or(sources_.front()),
                                            storey(), options_.at));
    }
    check_levels();
    if (options_.links) links_.emplace(network_, options_.at, storey());
    if (options_.trails) {
        ways_.emplace(*trails_, network_, options_.at, storey(), survey_ ? &*survey_ : nullptr);
    }
}

/// Checks that all robots whose coverage is drawn have levels, or all have a range.
void Painter::check_levels() const {
    for (const Transmitter& each : transmitters_) {
        if (range_of(each.model).has_value() == range_of(transmitters_.front().model).has_value())
            continue;
        throw std::invalid_argument(
            "picture: the model disc computes no received levels, but the models of the other "
            "robots compute levels; expected a coverage only of robots with disc, or only of "
            "robots "
            "with other models");
    }
}

double Painter::shown_reach(const Transmitter& transmitter, const Extent& robots) const {
    constexpr double most = 4;  // times the size of the robots' extent
    const Radio& radio = transmitter.radio;
    const double reach =
        transmitter.model.reach(link_budget(radio, transmitter.receiver), radio.frequency).value;
    const double size = std::max(robots.width(), robots.height());
    const double limit = network_.size() > 1 ? most * size : 1e6;
    return std::min(reach, std::max(limit, 1.0));
}

Extent Painter::extent() const {
    constexpr double share = 0.03;  // of the margin in the larger side
    Extent out;
    for (std::uint32_t i = 0; i < network_.size(); ++i) {
        const NodeId node{i};
        const RobotState robot = network_.robot(node);
        const bool there = robot.presence == Presence::on || robot.presence == Presence::off;
        if (!there && !is_source(node)) continue;
        if (network_.scene().storeys().number_at(robot.at.z) != storey()) continue;
        out.include(robot.at, robot.radius.value);
    }
    if (ways_) ways_->include_in(out);
    const Scene& scene = network_.scene().storey(storey());
    if (!scene.open_field()) {
        out.include(scene.lower_left());
        out.include(scene.upper_right());
    } else if (!transmitters_.empty()) {
        const Extent robots = out;
        for (const Transmitter& each : transmitters_)
            out.include(each.antenna, shown_reach(each, robots));
    } else if (out.empty()) {
        out.include({});
        out.grow(5, 5);
    } else if (network_.size() == 1 && out.width() < 10 && out.height() < 10) {
        out.grow(5, 5);
    }
    const double more = share * std::max(out.width(), out.height());
    out.grow(more, more);
    return out;
}

Plot Painter::plot() const {
    constexpr double tallest = 0.75;  // of the picture's width
    constexpr double narrowest = 420, lowest = 160;
    const Extent extent = this->extent();
    const auto plot_beside = [&](double axis) {
        const double width = width_ - 2 * margin - bar_room() - axis;
        return Plot(extent, {margin + axis, margin},
                    {.width = width,
                     .height = tallest * width_,
                     .least_width = std::min(narrowest, width),
                     .least_height = lowest});
    };
    const Plot plot = plot_beside(0);
    return options_.axes ? plot_beside(MapAxes(plot).left()) : plot;
}

void Painter::draw_world(Svg& svg, const Plot& plot, const RobotMarks& robots) const {
    const SvgAttributes frame{
        {"x", plot.left}, {"y", plot.top}, {"width", plot.width}, {"height", plot.height}};
    svg.open("clipPath", {{"id", "plot"}});
    svg.add("rect", frame);
    svg.close();
    svg.open("g", {{"clip-path", "url(#plot)"}});
    if (heat_) heat_->draw_levels(svg, plot);
    map_->draw(svg, plot, heat_.has_value());
    if (heat_) heat_->draw_contours(svg, plot);
    if (ways_) ways_->draw(svg, plot, heat_.has_value());
    if (links_) links_->draw(svg, robots, heat_.has_value());
    if (options_.search) draw_search(svg, *search_, robots);
    if (route_) route_->draw(svg, robots);
    robots.draw(svg);
    svg.close();
    svg.add("rect", {{"x", plot.left},
                     {"y", plot.top},
                     {"width", plot.width},
                     {"height", plot.height},
                     {"fill", "none"},
                     {"stroke", "#555555"},
                     {"stroke-width", 1.0}});
}

Legend Painter::legend(const Plot& plot, const RobotMarks& robots) const {
    Legend out;
    out.add(scale_bar(plot));
    map_->append_to(out, heat_.has_value());
    robots.append_to(out);
    if (heat_) heat_->append_to(out);
    if (links_) links_->append_to(out);
    if (ways_) ways_->append_to(out);
    if (route_) route_->append_to(out);
    if (options_.search && !search_->senders().empty()) append_search(out);
    return out;
}

std::string Painter::paint() {
    run();
    Plot plot = this->plot();
    if (!transmitters_.empty()) heat_.emplace(transmitters_, plot, options_.cells);
    const double right = bar_room();
    const double text_width = plot.right() + right - margin;
    const Time end = start_of_run + scenario_.scenario.duration;
    std::vector<std::string> caption =
        picture_caption(network_, options_.at, end, storey(), sources_, receiver_);
    if (survey_) {
        for (std::string& text : survey_->gap_texts()) caption.push_back(std::move(text));
    }
    if (route_) caption.push_back(route_->text(network_));
    if (options_.search) caption.push_back(search_->text(network_));
    const Heading heading(shortened(scenario_.scenario.name, 100), caption, text_width);
    plot.top = margin + heading.height();

    RobotMarks robots(network_, storey(), sources_, options_.trails, plot);
    LabelPlaces places({plot.left, plot.top, plot.right(), plot.bottom()});
    if (links_) links_->keep_off(places, robots);
    if (options_.search) add_rings(robots, *search_);
    if (route_) route_->keep_off(places, robots);
    robots.place_names(places);
    if (route_) route_->place_ages(places, robots);
    const Legend legend = this->legend(plot, robots);
    const double foot = plot.bottom() + part_gap + (options_.axes ? MapAxes::below : 0);
    const double width = std::ceil(plot.right() + right + margin);
    const double height = std::ceil(foot + legend.height(text_width) + margin / 2);
    Svg svg(width, height, options_.width / width_);
    svg.title(scenario_.scenario.name);
    svg.add("rect", {{"width", width}, {"height", height}, {"fill", "#ffffff"}});
    heading.draw(svg);
    draw_world(svg, plot, robots);
    if (heat_ && heat_->has_levels()) {
        constexpr double highest_bar = 420;
        heat_->draw_bar(svg, {plot.right() + part_gap, plot.top},
                        std::min(plot.height, highest_bar));
    }
    if (options_.axes) MapAxes(plot).draw(svg, plot);
    legend.draw(svg, {margin, foot}, text_width);
    return svg.finish();
}

}  // namespace

std::string draw_svg(const Scenario& scenario, const PictureOptions& options) {
    return Painter(scenario, options).paint();
}

}  // namespace rovernet
