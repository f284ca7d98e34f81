// SPDX-License-Identifier: MIT
#include "models/reception/interference.hpp"
#include "models/reception/sinr_receiver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace rovernet {
namespace {

class SinrJudge final : public Judge {
  public:
    explicit SinrJudge(const Sinr& model) : model_(model), receiver_(model) {}

    bool looks_back() const override { return true; }
    std::optional<Db> interference_cut() const override { return model_.interference_cut; }
    std::size_t most_on_air() const override { return most_on_air_; }
    void check(const Phy& phy, BitRate rate) const override {
        if (phy.coding(rate)) return;
        throw std::invalid_argument(
            fmt::format("found the rate {} bit/s; reception model \"sinr\" knows only the rates of "
                        "802.11a, b and g",
                        rate.value));
    }
    void begins(const SentFrame& frame) override;
    void judge(Interference& air, const Emission& judged, Frames others,
               Reception& reception) override;

  private:
    /// Data of a frame on air, in addition to its Emission.
    struct Sent {
        SinrFrame frame;                ///< without the noise, which is the receiver's
        std::uint32_t number;           ///< number among the frames of its sender
        std::vector<NodeId> receivers;  ///< nodes that can decode it ...
        std::vector<Lock> locks;        ///< ... and what they made of it
    };
    static Lock* lock_of(Sent& sent, NodeId node);

    Sinr model_;
    SinrReceiver receiver_;
    std::vector<Sent> sent_;              // by Emission::flight
    std::vector<std::uint32_t> numbers_;  // by node: of its next frame
    std::vector<Arrival> arrivals_;       // at the receiver of what is judged
    std::vector<Time> ends_;              // of the frames on air
    std::size_t most_on_air_ = 0;
};

void SinrJudge::begins(const SentFrame& frame) {
    const Emission& emission = frame.emission;
    std::erase_if(ends_, [&](Time each) { return each <= emission.begin; });
    ends_.push_back(emission.end);
    most_on_air_ = std::max(most_on_air_, ends_.size());

    if (emission.from.index() >= numbers_.size()) numbers_.resize(emission.from.index() + 1);
    if (emission.flight >= sent_.size()) sent_.resize(emission.flight + std::size_t{1});
    Sent& sent = sent_[emission.flight];
    sent.frame = {.phy = &frame.phy,
                  .coding = frame.transmission.coding,
                  .rate = frame.transmission.rate.value,
                  .payload = frame.transmission.payload};
    sent.number = numbers_[emission.from.index()]++;
    sent.receivers.clear();
    for (const Reception& r : frame.receptions) sent.receivers.push_back(r.node);
    sent.locks.assign(sent.receivers.size(), Lock::open);
}

/// Lock of `node` on a frame; null if the node could not decode it.
Lock* SinrJudge::lock_of(Sent& sent, NodeId node) {
    const auto found = std::find(sent.receivers.begin(), sent.receivers.end(), node);
    if (found == sent.receivers.end()) return nullptr;
    return &sent.locks[static_cast<std::size_t>(found - sent.receivers.begin())];
}

void SinrJudge::judge(Interference& air, const Emission& judged, Frames others,
                      Reception& reception) {
    const NodeId node = reception.node;
    arrivals_.clear();
    const auto add = [&](const Emission& frame) {
        const auto arrives = air.arrival(frame, node);
        if (!arrives) return;
        arrivals_.push_back(*arrives);
        constexpr double slack = 1 + 1e-9;  // of a square root, squared
        const double heard_within2 = frame.heard_within * frame.heard_within * slack;
        if (arrives->squared_distance > heard_within2) return;  // not a receiver
        arrivals_.back().lock = lock_of(sent_[frame.flight], node);
    };
    add(judged);
    for (const Emission* frame : others) add(*frame);
    const Sent& sent = sent_[judged.flight];
    SinrFrame frame = sent.frame;
    frame.noise = air.medium().stations().noise(node);
    const Fate fate = receiver_.judge(
        arrivals_.front(), arrivals_, frame,
        [&](const Arrival& a) { return air.level(a, node).value; },
        [&] { return air.draw(Purpose::bit_errors, judged.from, node, sent.number); },
        [&](NodeId a, NodeId b) { return air.key(a) < air.key(b); });
    reception.locked = *arrivals_.front().lock == Lock::held && fate != Fate::busy;
    const bool decoded_but_garbled = is_decoded(fate) && reception.fate == Fate::garbled;
    if (!decoded_but_garbled) reception.fate = fate;
}

}  // namespace

std::unique_ptr<Judge> Sinr::make_judge() const { return std::make_unique<SinrJudge>(*this); }

}  // namespace rovernet
