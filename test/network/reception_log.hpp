// SPDX-License-Identifier: MIT
#pragma once

#include "models/access/list.hpp"
#include "models/propagation/list.hpp"
#include "models/reception/list.hpp"
#include "network/network.hpp"
#include "routing/flood.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

namespace rovernet::test {

inline bool in_order(std::span<const Reception> receptions) {
    return std::is_sorted(receptions.begin(), receptions.end());
}

/// Log of all receptions of a run, of their groups, and of the order of transmissions.
struct ReceptionLog {
    using Entry = std::tuple<std::uint64_t, std::uint64_t, Time, NodeId, Fate, bool>;

    std::vector<Entry> receptions{};
    std::vector<std::pair<Time, NodeId>> sendings{};
    bool always_in_order = true;
    Time end_of_run = never;

    KindMask kinds() const { return kind_of<Transmitted>() | kind_of<Received>(); }
    void on(const Record& record, const RecordContext& context) {
        if (const auto* sent = std::get_if<Transmitted>(&record)) {
            sendings.emplace_back(sent->time, sent->frame.sender);
            return;
        }
        const auto& received = std::get<Received>(record);
        always_in_order = always_in_order && in_order(received.receptions);
        REQUIRE(!received.receptions.empty());
        const std::uint64_t uid = context.messages[received.frame.message].uid;
        for (const Reception& r : received.receptions) {
            REQUIRE(r.time <= end_of_run);
            receptions.emplace_back(uid, received.frame.path, r.time, r.node, r.fate, r.delivered);
        }
    }
};

/// Models and radio of a network.
struct Setting {
    Propagation propagation = Disc{.range = {150}};
    ReceptionModel reception = Threshold{};
    Flood flood = {.jitter = std::chrono::microseconds{100}};
    AccessModel access = NoAccess{};
    Radio radio = {.sensitivity = {-90}};
    bool reference = false;
};

/// Settings that together use every model and every kind of flood.
inline std::vector<Setting> settings() {
    using namespace std::chrono_literals;
    const LogDistance shadowed{.exponent = 3, .sigma = 4_dB};
    const Flood at_once{.jitter = 0us};
    const Flood forward{.ttl = 2, .duplicates = Duplicates::forward, .jitter = 0us};
    return {{},
            {.flood = at_once},
            {.flood = {.ttl = 2, .upgrade = false, .jitter = 0us}},
            {.flood = forward},
            {.propagation = shadowed, .flood = at_once},
            // propagation delays above 1 us
            {.propagation = Disc{.range = 320_m}, .flood = at_once},
            {.reception = Collision{}},
            {.propagation = shadowed, .reception = Collision{.capture_ratio = Db{3}}},
            {.propagation = LogDistance{.exponent = 3}, .reception = Sinr{}},
            {.reception = Collision{}, .access = Csma{}},
            // Frames so short that they end before earlier frames have arrived at all receivers.
            {.radio = {.sensitivity = {-90}, .rate = {1e12}, .preamble = 0ns}}};
}

}  // namespace rovernet::test
