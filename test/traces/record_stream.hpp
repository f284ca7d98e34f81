// SPDX-License-Identifier: MIT
#pragma once

#include "models/access/wifi_frames.hpp"
#include "sim/legs.hpp"
#include "sim/record.hpp"
#include "sim/sink.hpp"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <unistd.h>
#include <utility>
#include <vector>

namespace rovernet::testing {

using namespace std::chrono_literals;

inline Time at(std::int64_t ns) { return Time{Duration{ns}}; }

/// Temporary folder, removed by the destructor.
class TempFolder {
  public:
    TempFolder() {
        auto name = (std::filesystem::temp_directory_path() / "rovernet-test-XXXXXX").string();
        if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
        path_ = name;
    }
    TempFolder(const TempFolder&) = delete;
    ~TempFolder() { std::filesystem::remove_all(path_); }
    std::string operator/(const std::string& name) const { return (path_ / name).string(); }
    bool has(const std::string& name) const { return exists(path_ / name); }
    std::vector<std::string> names() const {
        std::vector<std::string> all;
        for (const auto& entry : std::filesystem::directory_iterator(path_)) {
            all.push_back(entry.path().filename());
        }
        return all;
    }

  private:
    std::filesystem::path path_;
};

inline std::string content(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

inline void write_file(const std::string& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

/// Functions that emit single records to sinks.
class Stream {
  public:
    Legs legs;
    MessageTable messages;
    std::vector<Sink> sinks;

    void emit(const Record& record) {
        for (Sink& sink : sinks) {
            if (sink.kinds() & (KindMask{1} << record.index())) sink.on(record, {legs, messages});
        }
    }
    NodeId place(Leg leg) {
        const NodeId node = legs.add(leg);
        emit(Moved{leg.start, node, leg});
        return node;
    }
    NodeId place(Vec3 p) { return place(Leg{.from = p, .velocity = {}, .to = p}); }

    MessageId send(Time t, NodeId node, std::uint8_t ttl, std::uint32_t size = 64,
                   std::optional<std::uint32_t> reachable = {}) {
        const auto id = messages.add({.origin = node,
                                      .uid = next_uid_++,
                                      .number = 0,
                                      .key = 0,
                                      .size = size,
                                      .created = t,
                                      .payload = {}});
        emit(Sent{t, node, id, ttl, static_cast<std::uint32_t>(legs.size()), reachable});
        return id;
    }
    void transmit(Time t, const Frame& frame, std::optional<NodeId> heard_from = {}) {
        emit(Transmitted{t, frame, heard_from});
        emit(AirSent{t, {.frame = frame, .heard_from = heard_from}, messages[frame.message].size});
    }
    void control(Time t, NodeId from, NodeId to, const ControlFrame& kind, Fate fate) {
        AirFrame air{.control = &kind};
        air.frame.sender = from;
        air.frame.next_hop = to;
        emit(AirSent{t, air, 20});
        emit(ControlReceived{air, {t, to, fate}, 20});
    }
    void receive(const Frame& frame, const std::vector<Reception>& receptions) {
        emit(Received{frame, receptions});
    }

  private:
    std::uint64_t next_uid_ = 0;
};

inline Frame frame(MessageId m, NodeId sender, unsigned ttl, unsigned hops) {
    return {.message = m,
            .sender = sender,
            .path = 0,
            .ttl = static_cast<std::uint8_t>(ttl),
            .hops = static_cast<std::uint8_t>(hops)};
}

/// Random sequence of records as a network may emit it, determined by a seed: moving robots, echoes
/// to the origin, duplicates, copies whose ttl has expired, radios switched off.
class RandomRecords {
  public:
    RandomRecords(Stream& stream, unsigned seed) : stream_(stream), draw_(seed) {}

    void run(int robots, int records) {
        for (int i = 0; i < robots; ++i) stream_.place(leg());
        send();
        for (int i = 0; i < records; ++i) step();
    }

  private:
    std::uint32_t below(std::size_t n) { return static_cast<std::uint32_t>(draw_() % n); }
    NodeId robot() { return {below(stream_.legs.size())}; }
    Leg leg() {
        const Vec3 from{below(100'000) / 1e3, below(100'000) / 1e3, below(3000) / 1e3};
        const Vec3 to{below(100'000) / 1e3, below(100'000) / 1e3, from.z};
        return {.start = now_,
                .end = now_ + 10s,
                .from = from,
                .velocity = 0.1 * (to - from),
                .to = to};
    }
    void send() {
        std::optional<std::uint32_t> reachable;
        if (below(4) > 0) reachable = below(stream_.legs.size());
        const auto ttl = static_cast<std::uint8_t>(below(40));
        ttls_.push_back(ttl);
        sent_.push_back(stream_.send(now_, robot(), ttl, below(1000), reachable));
    }
    Frame any_frame() {
        const std::uint32_t i = below(sent_.size());
        unsigned hops = 1 + below(std::max<unsigned>(ttls_[i], 1));
        const NodeId sender = robot();
        if (sender == stream_.messages[sent_[i]].origin) hops = 1;
        return frame(sent_[i], sender, ttls_[i] + 1U - hops, hops);
    }
    Reception reception(MessageId message) {
        const Fate fates[] = {Fate::waiting, Fate::ttl,      Fate::duplicate, Fate::off,
                              Fate::garbled, Fate::collided, Fate::busy};
        const NodeId node = robot();
        Reception rx{now_ + Duration{below(1000)}, node, fates[below(7)], false};
        const bool may_be = (rx.fate == Fate::waiting || rx.fate == Fate::ttl) && below(2) == 0;
        rx.delivered = may_be && node != stream_.messages[message].origin &&
                       got_.insert({message.index(), node.index()}).second;
        return rx;
    }
    void step() {
        now_ += Duration{below(3) == 0 ? 0 : below(2'000'000'000)};
        const Frame f = any_frame();
        const auto kind = below(20);
        if (kind == 0) return send();
        if (kind == 1) {
            const NodeId node = robot();
            stream_.legs.replace(node, leg());
            return stream_.emit(Moved{now_, node, stream_.legs.leg(node)});
        }
        if (kind == 2) {
            return stream_.emit(Dropped{now_, robot(), f, static_cast<DropReason>(below(4))});
        }
        if (kind == 3) return (void)stream_.place(leg());
        if (kind < 9) {
            const Fate fates[] = {Fate::waiting, Fate::collided, Fate::busy};
            const ControlFrame* const types[] = {&wifi_rts, &wifi_cts, &wifi_ack};
            stream_.control(now_, f.sender, NodeId{0}, *types[f.hops % 3], fates[kind % 3]);
            return stream_.transmit(now_, f, f.hops > 1 ? std::optional(robot()) : std::nullopt);
        }
        std::vector<Reception> receptions(below(5));
        for (auto& rx : receptions) rx = reception(f.message);
        stream_.receive(f, receptions);
    }

    Stream& stream_;
    std::mt19937 draw_;
    Time now_{};
    std::vector<MessageId> sent_;
    std::vector<std::uint8_t> ttls_;
    /// pairs of message and robot for which the message was delivered
    std::set<std::pair<std::size_t, std::size_t>> got_;
};

}  // namespace rovernet::testing
