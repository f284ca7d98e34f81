// SPDX-License-Identifier: MIT
#include "pictures/map/picture_caption.hpp"

#include "experiment/reports/range_of_model.hpp"
#include "pictures/draw/svg.hpp"
#include "pictures/map/model_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace rovernet {
namespace {

std::string time_text(Time at, Time end) {
    std::string text = fmt::format("t = {:.6g} s", seconds(at));
    if (at > end) text += fmt::format(", after the end of the run at {:.6g} s", seconds(end));
    return text;
}

/// Number of robots that are not there: "of 9 robots, 3 not departed yet, 1 already left".
std::string absent_text(const Network& network) {
    std::size_t to_come = 0, left = 0;
    for (std::uint32_t i = 0; i < network.size(); ++i) {
        const Presence presence = network.robot(NodeId{i}).presence;
        to_come += presence == Presence::not_departed;
        left += presence == Presence::left;
    }
    if (to_come + left == 0) return "";
    std::string text;
    if (to_come > 0) text = fmt::format("{} not departed yet", to_come);
    if (left > 0) text += fmt::format("{}{} already left", text.empty() ? "" : ", ", left);
    return fmt::format("of {} robots, {}", network.size(), text);
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
        case Presence::off: return " (switched off, drawn as if it were on)";
        case Presence::not_departed: return " (not departed yet, drawn as if it had departed)";
        case Presence::left: return " (has left, drawn as if it were present)";
    }
    return "";
}

std::string name_text(const Network& network, NodeId node) {
    constexpr std::size_t longest_name = 40;
    return shortened(network.name(node), longest_name);
}

/// Names of the robots whose coverage is drawn: "ap1 or ap2, whichever is stronger".
std::string sources_text(const Network& network, const std::vector<NodeId>& sources) {
    std::string text;
    for (const NodeId source : sources) {
        text += fmt::format("{}{}{}", text.empty() ? "" : " or ", name_text(network, source),
                            presence_text(network.robot(source).presence));
    }
    return text + (sources.size() > 1 ? ", whichever is stronger" : "");
}

/// Words for the assumed receivers.
std::string receiver_text(const Network& network, const std::vector<NodeId>& sources,
                          std::optional<NodeId> receiver) {
    if (receiver) return "the radio of " + name_text(network, *receiver);
    if (sources.size() == 1) return "a radio like its own";
    return "a radio like that of " + name_text(network, sources.front());
}

void append_coverage(std::vector<std::string>& parts, const Network& network,
                     const std::vector<NodeId>& sources, std::optional<NodeId> receiver) {
    const std::string names = sources_text(network, sources);
    if (range_of(network.robot(sources.front()).propagation)) {
        parts.push_back("coverage of " + names);
        return;
    }
    const bool is_random = std::any_of(sources.begin(), sources.end(), [&](NodeId source) {
        return network.robot(source).propagation.is_random();
    });
    parts.push_back(
        fmt::format("coverage of {}: {} for {}, antenna {:.6g} m up", names,
                    is_random ? "median level" : "level", receiver_text(network, sources, receiver),
                    network.robot(receiver.value_or(sources.front())).radio.antenna_height.value));
    std::vector<std::string> powers;
    for (const NodeId source : sources) {
        const Radio& radio = network.robot(source).radio;
        std::string text =
            fmt::format("{:.4g} dBm at {:.6g} MHz", radio.power.value, radio.frequency.value / 1e6);
        if (std::find(powers.begin(), powers.end(), text) == powers.end())
            powers.push_back(std::move(text));
    }
    parts.push_back(fmt::format("{}", fmt::join(powers, " or ")));
}

}  // namespace

std::vector<std::string> picture_caption(const Network& network, Time at, Time end,
                                         std::size_t storey, const std::vector<NodeId>& sources,
                                         std::optional<NodeId> receiver) {
    constexpr std::size_t most_models = 3;
    std::vector<std::string> parts{time_text(at, end)};
    if (network.scene().storeys().size() > 1) parts.push_back(storey_text(network.scene(), storey));
    if (std::string absent = absent_text(network); !absent.empty()) parts.push_back(absent);
    const auto models = model_texts(network);
    const auto shown = static_cast<std::ptrdiff_t>(std::min(models.size(), most_models));
    parts.insert(parts.end(), models.begin(), models.begin() + shown);
    if (models.size() > most_models) {
        parts.push_back(fmt::format("and {} more models", models.size() - most_models));
    }
    if (sources.empty()) return parts;
    append_coverage(parts, network, sources, receiver);
    if (models.size() > 1 && sources.size() == 1) {
        parts.push_back(name_text(network, sources[0]) + " has the model " +
                        model_text(network.robot(sources[0]).propagation));
    }
    return parts;
}

}  // namespace rovernet
