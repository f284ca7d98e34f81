// SPDX-License-Identifier: MIT
#include "pictures/picture.hpp"

#include "experiment/build.hpp"
#include "experiment/run.hpp"
#include "pictures/heat_layer.hpp"
#include "pictures/link_lines.hpp"
#include "pictures/map_layer.hpp"
#include "pictures/robot_marks.hpp"
#include "pictures/trail_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

namespace rovernet {
namespace {

constexpr double margin = 16;        // [px] around everything
constexpr double title_size = 16;    // [px]
constexpr double bold = 1.15;        // times as wide as other text, at most
constexpr double caption_size = 12;  // [px]
constexpr double title_line = 22;    // [px]
constexpr double caption_line = 17;  // [px]
constexpr Color faint{0x44, 0x44, 0x44};
constexpr double gap = 10;  // [px] between the parts
constexpr std::uint32_t most_robots = 100'000;

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
    Extent extent() const;
    Plot plot() const;
    /// How far from the robot whose coverage is drawn an open field is shown [m].
    double shown_reach(const Extent& robots) const;
    /// The robots' models, each once.
    std::vector<std::string> models() const;
    std::vector<std::string> caption() const;
    /// Room for the colour bar beside the plot [px]; 0 if there is none.
    double bar_room() const { return source_ ? gap + HeatLayer::bar_width : 0; }
    Legend legend(const Plot& plot, const RobotMarks& robots) const;
    void draw_world(Svg& svg, const Plot& plot, const RobotMarks& robots) const;

    const Scenario& scenario_;
    const PictureOptions& options_;
    Network network_;
    std::shared_ptr<Trails> trails_ = std::make_shared<Trails>();
    std::vector<Meters> radii_ = {};  // of the robots
    std::optional<NodeId> source_ = std::nullopt;
    std::optional<Transmitter> transmitter_ = std::nullopt;
    std::optional<MapLayer> map_ = std::nullopt;
    std::optional<HeatLayer> heat_ = std::nullopt;
    std::optional<TrailLines> ways_ = std::nullopt;
    std::optional<LinkLines> links_ = std::nullopt;
};

Painter::Painter(const Scenario& scenario, const PictureOptions& options)
    : scenario_(scenario), options_(options), network_(network_settings(scenario)) {
    check_range("width", options.width, 400, 10'000);
    check_range("cells", options.cells, 1, most_coverage_cells);
    if (options.at < start_of_run) throw std::invalid_argument("picture: at must be >= 0 s");
    for (const auto& table : scenario.robots) {
        radii_.insert(radii_.end(), static_cast<std::size_t>(table.count.value_or(1)),
                      table.radius);
    }
    if (radii_.size() > most_robots) {
        throw RunError(fmt::format("a picture of {} robots cannot be drawn; expected at most {}",
                                   radii_.size(), most_robots));
    }
}

void Painter::run() {
    if (options_.trails) network_.add_sink(trails_);
    populate(network_, scenario_);
    if (options_.coverage) source_ = robot_named(network_, *options_.coverage);
    network_.run_until(options_.at);

    map_.emplace(network_.scene());
    if (source_) transmitter_ = transmitter(network_, scenario_, *source_, options_.at);
    if (options_.links) links_.emplace(network_, options_.at);
    if (options_.trails) {
        ways_.emplace(*trails_, static_cast<std::uint32_t>(network_.size()), options_.at);
    }
}

double Painter::shown_reach(const Extent& robots) const {
    constexpr double most = 4;  // times the size of the robots' extent
    const Radio& radio = transmitter_->radio;
    const double reach =
        transmitter_->model.reach(link_budget(radio, radio), radio.frequency).value;
    const double size = std::max(robots.width(), robots.height());
    const double limit = network_.size() > 1 ? most * size : 1e6;
    return std::min(reach, std::max(limit, 1.0));
}

Extent Painter::extent() const {
    constexpr double share = 0.03;  // of the margin in the larger side
    Extent out;
    for (std::uint32_t i = 0; i < network_.size(); ++i) {
        out.include(network_.legs().position(NodeId{i}, options_.at), radii_[i].value);
    }
    if (ways_) ways_->include_in(out);
    const Scene& scene = network_.scene();
    if (!scene.open_field()) {
        out.include(scene.lower_left());
        out.include(scene.upper_right());
    } else if (transmitter_) {
        out.include(transmitter_->antenna, shown_reach(out));
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
    const double width = options_.width - 2 * margin - bar_room();
    return Plot(extent(), {margin, margin},
                {.width = width,
                 .height = tallest * options_.width,
                 .least_width = std::min(narrowest, width),
                 .least_height = lowest});
}

/// The chosen model's name and parameters: "log_distance: exponent 4, sigma 5 dB".
std::string model_text(const PropagationTable& table) {
    std::string text;
    std::size_t index = 0;
    const auto append = [&]<class M>(const M& model) {
        if (index++ != table.model) return;
        Table parameters;
        append_fields(parameters, model);
        text = M::name;
        const char* between = ": ";
        for (const auto& entry : parameters.entries) {
            const std::string* quantity = entry.value.string();
            const auto* number = std::get_if<double>(&entry.value.data);
            const auto* whole = std::get_if<std::int64_t>(&entry.value.data);
            text += fmt::format("{}{} {}", std::exchange(between, ", "), entry.key,
                                quantity ? *quantity
                                : number ? fmt::format("{}", *number)
                                : whole  ? fmt::format("{}", *whole)
                                         : entry.value.description());
        }
    };
    std::apply([&](const auto&... each) { (append(each), ...); }, table.parameters);
    return text;
}

std::vector<std::string> Painter::models() const {
    std::vector<std::string> out;
    for (const auto& table : scenario_.robots) {
        std::string text = model_text(table.propagation.value_or(scenario_.propagation));
        if (std::find(out.begin(), out.end(), text) == out.end()) out.push_back(std::move(text));
    }
    return out;
}

std::vector<std::string> Painter::caption() const {
    constexpr std::size_t most_models = 3;
    std::vector<std::string> parts{fmt::format("t = {:.6g} s", seconds(options_.at))};
    const auto models = this->models();
    const auto shown = static_cast<std::ptrdiff_t>(std::min(models.size(), most_models));
    parts.insert(parts.end(), models.begin(), models.begin() + shown);
    if (models.size() > most_models) {
        parts.push_back(fmt::format("and {} models more", models.size() - most_models));
    }
    if (!source_) return parts;
    const PropagationTable own =
        robot_table(scenario_, *source_).propagation.value_or(scenario_.propagation);
    const Radio& radio = transmitter_->radio;
    parts.push_back(fmt::format("coverage of {}: {} for a radio like its own, antenna {:.6g} m up",
                                shortened(*options_.coverage, 40),
                                has_shadowing(own) ? "median level" : "level",
                                radio.antenna_height.value));
    parts.push_back(
        fmt::format("{:.4g} dBm at {:.6g} MHz", radio.power.value, radio.frequency.value / 1e6));
    if (models.size() > 1) parts.push_back("its model is " + model_text(own));
    return parts;
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
    LabelPlaces places({plot.left, plot.top, plot.right(), plot.bottom()});
    if (links_) links_->keep_off(places, robots);
    robots.draw(svg, places);
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
    return out;
}

std::string Painter::paint() {
    run();
    Plot plot = this->plot();
    if (transmitter_) heat_.emplace(*transmitter_, plot, options_.cells);
    const double right = bar_room();
    const double text_width = plot.width + right;
    const Heading heading(shortened(scenario_.scenario.name, 100), caption(), text_width);
    plot.top = margin + heading.height();

    const RobotMarks robots(network_, radii_, source_, options_.at, plot);
    const Legend legend = this->legend(plot, robots);
    const double width = std::ceil(plot.right() + right + margin);
    const double height = std::ceil(plot.bottom() + gap + legend.height(text_width) + margin / 2);
    Svg svg(width, height);
    svg.title(scenario_.scenario.name);
    svg.add("rect", {{"width", width}, {"height", height}, {"fill", "#ffffff"}});
    heading.draw(svg);
    draw_world(svg, plot, robots);
    if (heat_) {
        constexpr double highest_bar = 420;
        heat_->draw_bar(svg, {plot.right() + gap, plot.top}, std::min(plot.height, highest_bar));
    }
    legend.draw(svg, {margin, plot.bottom() + gap}, text_width);
    return svg.finish();
}

}  // namespace

std::string draw_svg(const Scenario& scenario, const PictureOptions& options) {
    return Painter(scenario, options).paint();
}

}  // namespace rovernet
