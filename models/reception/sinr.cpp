// SPDX-License-Identifier: MIT
#include "models/reception/sinr_receiver.hpp"

namespace rovernet {

/// Whether the node begins to transmit after `after`, not later than `until`.
bool SinrReceiver::sends_within(Time after, Time until) const {
    return std::any_of(here_.begin(), here_.end(), [&](const Arrival* a) {
        return a->own && a->begin > after && a->begin <= until;
    });
}

/// Whether the receiver was not locked onto another frame when this one began.
bool SinrReceiver::is_free_for(const Arrival& arrival) const {
    return std::none_of(here_.begin(), here_.end(), [&](const Arrival* a) {
        if (a == &arrival || a->begin > arrival.begin || a->end <= arrival.begin) return false;
        if (a->own) return true;
        return a->lock && *a->lock == Lock::held && !sends_within(a->begin, arrival.begin);
    });
}

/// Whether the node transmits while the frame arrives.
bool SinrReceiver::sends_during(const Arrival& judged) const {
    return std::any_of(here_.begin(), here_.end(),
                       [&](const Arrival* a) { return a->own && a->overlaps(judged); });
}

/// Sum of log_success over the bits of the payload, with the interference of the frames in here_.
double SinrReceiver::log_success_of(const Arrival& judged, const SinrFrame& frame) {
    const double signal = math::exp10(judged.level_dbm / 10);
    const double noise_mw = math::exp10(frame.noise.value / 10);
    if (here_.empty()) {
        const double bits = seconds(frame.payload) * frame.rate;
        return bits * frame.phy->log_success(frame.coding, signal / noise_mw);
    }
    const Time begin = judged.end - frame.payload;
    changes_.assign({begin, judged.end});
    power_mw_.clear();
    for (const Arrival* a : here_) {
        power_mw_.push_back(frame.phy->rejection(frame.coding, a->coding) *
                            math::exp10(a->level_dbm / 10));
        for (const Time t : {a->begin, a->end}) {
            if (t > begin && t < judged.end) changes_.push_back(t);
        }
    }
    std::sort(changes_.begin(), changes_.end());
    double sum = 0;
    for (std::size_t i = 0; i + 1 < changes_.size(); ++i) {
        const Time from = changes_[i], to = changes_[i + 1];
        if (from == to) continue;
        double interference_mw = noise_mw;  // and noise
        for (std::size_t k = 0; k < here_.size(); ++k) {
            if (here_[k]->begin <= from && here_[k]->end >= to) interference_mw += power_mw_[k];
        }
        sum += seconds(to - from) * frame.rate *
               frame.phy->log_success(frame.coding, signal / interference_mw);
    }
    return sum;
}

}  // namespace rovernet
