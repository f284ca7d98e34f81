// SPDX-License-Identifier: MIT
// A physical layer of one's own: its codings have sensitivities, preambles and rejection.
#include "models/access/access.hpp"
#include "models/access/list.hpp"
#include "models/medium/medium.hpp"
#include "models/propagation/friis.hpp"
#include "models/propagation/log_distance.hpp"
#include "models/reception/list.hpp"
#include "network/network.hpp"

#include <doctest/doctest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <set>
#include <vector>

namespace own_phy_test {
using namespace rovernet;
using namespace std::chrono_literals;

namespace {

constexpr BitRate slow{1000}, fast{8000};

/// Two codings, as spreading factors are: the slow one reaches 10 dB farther, and neither disturbs
/// the other.
struct Chirp {
    static constexpr std::string_view name = "chirp";
    static constexpr std::array known{slow, fast};
    double other = 1e-6;  ///< rejection of the other coding

    Transmission transmission(const Radio& radio, BitRate rate, std::uint32_t bytes) const {
        return {.rate = rate,
                .coding = *coding(rate),
                .bandwidth = radio.bandwidth,
                .preamble = rate == slow ? 80ms : 10ms,
                .payload = from_seconds(8 * bytes / rate.value),
                .bytes = bytes};
    }
    std::span<const BitRate> rates() const { return known; }
    std::optional<Coding> coding(BitRate rate) const { return Coding(rate == slow ? 0 : 1); }
    double log_success(Coding, double sinr) const { return sinr > 1 ? 0 : -10; }
    Db certain_sinr(Coding) const { return Db{300}; }
    Dbm sensitivity(const Radio& radio, Coding coding) const {
        return coding == Coding{0} ? radio.sensitivity - Db{10} : radio.sensitivity;
    }
    double rejection(Coding wanted, Coding interferes) const {
        return wanted == interferes ? 1 : other;
    }
    PreambleDetection preamble_detection(Coding) const { return {5ms, Db{-20}}; }
};

/// Sends at once, by this layer.
class SendsAtOnce final : public Access {
  public:
    SendsAtOnce(const Chirp& phy, std::optional<BitRate> rate) : phy_(phy), rate_(rate) {
        if (rate) rates_.push_back(*rate);
    }
    void send(Air& air, const QueuedFrame& frame) override {
        air.transmit({.frame = frame.frame, .heard_from = frame.heard_from});
        air.sent(frame);
    }
    bool queues() const override { return false; }
    Phy phy() const override { return phy_; }
    BitRate rate(const AirFrame&, BitRate sender, BitRate) const override {
        return rate_.value_or(sender);
    }
    std::span<const BitRate> own_rates() const override { return rates_; }

  private:
    Chirp phy_;
    std::optional<BitRate> rate_;
    std::vector<BitRate> rates_;
};

/// Settings of it; with `rate`, all frames go at that rate.
struct AtOnce {
    static constexpr std::string_view name = "at_once";
    Chirp phy{};
    std::optional<BitRate> rate = {};

    std::unique_ptr<Access> make_access() const { return std::make_unique<SendsAtOnce>(phy, rate); }
};

/// Distance [m] that the fast coding reaches in free space, with the default radio.
double reach() {
    const Radio radio;
    const double wavelength = 299792458 / radio.frequency.value;
    const double budget = radio.power.value - radio.sensitivity.value;
    return wavelength / (4 * 3.14159265358979323846) * std::pow(10, budget / 20);
}

/// A sender, and receivers just within and just beyond the range of each coding.
struct Line {
    Network net;
    std::vector<NodeId> heard{};

    explicit Line(NetworkSettings settings, BitRate rate) : net(std::move(settings)) {
        for (const double part : {0.0, 0.999, 1.001, 3.16, 3.165}) {
            const NodeId node =
                net.add({.name = {}, .at = {part * reach(), 0, 0}, .radio = {.rate = rate}});
            net.on_receive(node, [this, node](const Message&) { heard.push_back(node); });
        }
    }
    std::size_t hear() {
        heard.clear();
        net.send({0}, everyone, "", {.size = 10, .one_hop = true});
        net.run_for(1s);
        return heard.size();
    }
};

}  // namespace

TEST_CASE("user's phy: the coding of a frame decides which robots receive the frame") {
    for (const bool reference : {false, true}) {
        for (const auto& model :
             {Propagation{Friis{}}, Propagation{LogDistance{.exponent = 2, .sigma = Db{0}}}}) {
            NetworkSettings settings{
                .propagation = model, .access = AtOnce{}, .reference = reference};
            CAPTURE(model.name());
            Line fast_line(settings, fast), slow_line(settings, slow);
            CHECK(fast_line.hear() == 1);
            CHECK(slow_line.hear() == 3);
            CHECK(fast_line.net.links({1}, fast_line.net.now()).size() == 2);
            settings.access = AtOnce{.rate = slow};  // the access model's rate, not the radio's
            Line by_access(settings, fast);
            CHECK(by_access.hear() == 3);
        }
    }
}

TEST_CASE("user's phy: a radio may change its coding during the run") {
    Line line({.access = AtOnce{}}, fast);
    CHECK(line.hear() == 1);
    line.net.set_rate({0}, slow);
    CHECK(line.hear() == 3);
    line.net.set_rate({0}, fast);
    CHECK(line.hear() == 1);
}

TEST_CASE("user's phy: the coding determines the duration of the preamble") {
    for (const auto& [rate, expected] :
         {std::pair{slow, Duration{80ms + 80ms}}, std::pair{fast, Duration{10ms + 10ms}}}) {
        Network net({.access = AtOnce{}, .propagation_delay = false});
        for (const double x : {0.0, 10.0})
            net.add({.name = {}, .at = {x, 0, 0}, .radio = {.rate = rate}});
        Time heard{};
        net.on_receive({1}, [&](const Message&) { heard = net.now(); });
        net.send({0}, {1}, "", {.size = 10});
        net.run_for(1s);
        CHECK(heard - start_of_run == expected + 1us);
    }
}

TEST_CASE(
    "user's phy: a phy can reject interference from other codings, with the models `sinr` and "
    "`collision`") {
    const auto delivered = [](const ReceptionModel& reception, BitRate second, double other) {
        Network net({.reception = reception, .access = AtOnce{.phy = {.other = other}}});
        for (const double x : {0.0, 10.0, 20.0}) {
            net.add({.name = {}, .at = {x, 0, 0}, .radio = {.rate = x > 15 ? second : fast}});
        }
        std::set<NodeId> from;
        net.on_receive({1}, [&](const Message& m) { from.insert(m.origin); });
        for (const NodeId sender : {NodeId{0}, NodeId{2}})
            net.send(sender, everyone, "", {.size = 10, .one_hop = true});
        net.run_for(1s);
        return from.size();
    };
    const ReceptionModel capture =
        Collision{.capture_ratio = Db{6}, .capture = CaptureOrder::later};
    CHECK(delivered(capture, fast, 1e-6) == 0);
    CHECK(delivered(capture, slow, 1e-6) == 2);
    CHECK(delivered(capture, slow, 1) == 0);  // not rejected
    // Both begin at the same time, and the receiver locks onto one of them.
    CHECK(delivered(Collision{.capture_ratio = Db{6}}, slow, 1e-6) == 1);
    // A receiver of sinr is locked onto one frame; its bits are right only if the other is
    // rejected.
    CHECK(delivered(Sinr{}, fast, 1e-6) == 0);
    CHECK(delivered(Sinr{}, slow, 1e-6) == 1);
    CHECK(delivered(Sinr{}, slow, 1) == 0);
}

}  // namespace own_phy_test
