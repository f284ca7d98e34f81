// SPDX-License-Identifier: MIT
#include "pictures/map/picture_caption.hpp"

#include "experiment/reports/range_of_model.hpp"
#include "pictures/draw/svg.hpp"
#include "pictures/map/model_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace rovernet {
namespace {

std::string time_text(Time at, Time end) {
    std::string text = fmt::format("t = {:.6g} s", seconds(at));
    if (at > end) text += fmt::format(", after the end of the run at {:.6g} s", seconds(end));
    return text;
}

/// Number of robots that are not there: "3 robots not departed, 1 left".
std::string absent_text(const Network& network) {
    std::size_t to_come = 0, left = 0;
    for (std::uint32_t i = 0; i < network.size(); ++i) {
        const Presence presence = network.robot(NodeId{i}).presence;
        to_come += presence == Presence::not_departed;
        left += presence == Presence::left;
    }
    if (to_come + left == 0) return "";
    std::string text;
    if (to_come > 0) text = fmt::format("{} not departed", to_come);
    if (left > 0) text += fmt::format("{}{} left", text.empty() ? "" : ", ", left);
    return fmt::format("of {} robots {}", network.size(), text);
}

/// The robots' models, each once.
std::vector<std::string> model_texts(const Network& network) {
    std::vector<std::string> out;
    for (std::uint32_t i = 0; i < network.size(); ++i) {
        const Propagation& model = network.robot(NodeId{i}).propagation;
        if (i > 0 && model == network.robot(NodeId{i - 1}).propagation) continue;
        std::string text = model_text(model);
        if (std::find(out.begin(), out.end(), text) == out.end()) out.push_back(std::move(text));
    }
    return out;
}

std::string storey_text(const Scene& scene, std::size_t storey) {
    return fmt::format("storey {} of {}, floor at {:.6g} m", storey + 1, scene.storeys().size(),
                       scene.storeys().floor(storey));
}

std::string presence_text(Presence presence) {
    switch (presence) {
        case Presence::on: return "";
        case Presence::off: return ", which is switched off, as if it were on";
        case Presence::not_departed: return ", which has not departed, as if it had";
        case Presence::left: return ", which has left, as if it were there";
    }
    return "";
}

void append_coverage(std::vector<std::string>& parts, const Network& network, NodeId source,
                     std::optional<NodeId> receiver) {
    constexpr std::size_t longest_name = 40;
    const RobotState robot = network.robot(source);
    if (range_of(robot.propagation)) {
        parts.push_back(fmt::format("coverage of {}{}", shortened(robot.name, longest_name),
                                    presence_text(robot.presence)));
        return;
    }
    parts.push_back(fmt::format(
        "coverage of {}{}: {} for {}, antenna {:.6g} m up", shortened(robot.name, longest_name),
        presence_text(robot.presence), robot.propagation.is_random() ? "median level" : "level",
        receiver ? "the radio of " + shortened(network.name(*receiver), longest_name)
                 : "a radio like its own",
        network.robot(receiver.value_or(source)).radio.antenna_height.value));
    parts.push_back(fmt::format("{:.4g} dBm at {:.6g} MHz", robot.radio.power.value,
                                robot.radio.frequency.value / 1e6));
}

}  // namespace

std::vector<std::string> picture_caption(const Network& network, Time at, Time end,
                                         std::size_t storey, std::optional<NodeId> source,
                                         std::optional<NodeId> receiver) {
    constexpr std::size_t most_models = 3;
    std::vector<std::string> parts{time_text(at, end)};
    if (network.scene().storeys().size() > 1) parts.push_back(storey_text(network.scene(), storey));
    if (std::string absent = absent_text(network); !absent.empty()) parts.push_back(absent);
    const auto models = model_texts(network);
    const auto shown = static_cast<std::ptrdiff_t>(std::min(models.size(), most_models));
    parts.insert(parts.end(), models.begin(), models.begin() + shown);
    if (models.size() > most_models) {
        parts.push_back(fmt::format("and {} models more", models.size() - most_models));
    }
    if (!source) return parts;
    append_coverage(parts, network, *source, receiver);
    if (models.size() > 1) {
        parts.push_back("its model is " + model_text(network.robot(*source).propagation));
    }
    return parts;
}

}  // namespace rovernet
