// SPDX-License-Identifier: MIT
#include "study/calibration/prediction_errors.hpp"

#include <algorithm>
#include <cmath>

namespace rovernet {

void Predictions::add(std::size_t i, std::optional<double> loss, bool up) {
    const KnownLink& link = known_.links[i];
    GroupErrors& group = decisions_.groups[link.group];
    if (loss && !link.unseen) {
        const double error = *loss - link.loss;
        errors_.emplace_back(error, i);
        ++group.losses;
        group.squares += error * error;
    }
    if (link.distance() > decided_within_.value) return;
    ++group.decisions;
    group.wrong += up != link.up();
    ++decisions_.decisions;
    if (up && !link.up()) ++decisions_.false_up;
    if (!up && link.up()) ++decisions_.false_down;
}

PredictionErrors Predictions::errors() const {
    PredictionErrors out = decisions_;
    out.losses = errors_.size();
    if (errors_.empty()) return out;
    std::vector<double> sizes;
    double sum = 0, squares = 0;
    for (const auto& [error, link] : errors_) {
        sum += error;
        squares += error * error;
        sizes.push_back(std::abs(error));
    }
    std::sort(sizes.begin(), sizes.end());
    const double n = static_cast<double>(sizes.size());
    out.rmse = std::sqrt(squares / n);
    out.bias = sum / n;
    out.most_in_95 = sizes[static_cast<std::size_t>(std::ceil(0.95 * n)) - 1];
    return out;
}

std::vector<WorstLink> Predictions::worst() const {
    constexpr std::size_t most = 5;
    auto errors = errors_;
    std::stable_sort(errors.begin(), errors.end(), [](const auto& a, const auto& b) {
        return std::abs(a.first) > std::abs(b.first);
    });
    std::vector<WorstLink> out;
    for (std::size_t i = 0; i < std::min(most, errors.size()); ++i) {
        out.push_back({known_.links[errors[i].second].name, errors[i].first});
    }
    return out;
}

}  // namespace rovernet
