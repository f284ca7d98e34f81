// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/planners.hpp"
#include "models/medium/reachability.hpp"
#include "models/reception/on_air.hpp"
#include "network/engine_parts.hpp"
#include "network/link_watch.hpp"
#include "network/name_table.hpp"
#include "network/network.hpp"
#include "sim/chunks.hpp"
#include "sim/scheduler.hpp"
#include "sim/slots.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// What stands behind a Network: serves the events, and is the link layer to the router.
class Engine final : public LinkLayer, public Air {
  public:
    explicit Engine(NetworkSettings settings);

    // LinkLayer, for the router.
    Time now() const override { return now_; }
    std::size_t size() const override { return nodes_.size(); }
    const Message& message(MessageId id) const override { return messages_[id]; }
    bool is_on(NodeId node) const override { return medium_.is_on(node); }
    std::uint64_t key(NodeId node) const override { return medium_.key(node); }
    void broadcast(const Frame& frame, std::optional<NodeId> heard_from) override;
    void unicast(const Frame& frame, std::optional<NodeId> heard_from) override {
        broadcast(frame, heard_from);
    }
    void drop(NodeId node, const Frame& frame, DropReason reason) override {
        emit(Dropped{now_, node, frame, reason});
    }
    void timer(NodeId node, Time at, std::uint64_t tag) override;
    void hold(MessageId id) override { messages_.hold(id); }
    void release(MessageId id) override {
        if (messages_.release(id) && router_) router_->forget(id);
    }
    double draw(Purpose purpose, NodeId node, MessageId id, std::uint64_t index) const override {
        return uniform(
            {settings_.seed, settings_.replication, purpose, key(node), messages_[id].key, index});
    }

    // Air, for the access rungs.
    Time transmit(const AirFrame& frame) override;
    Duration airtime(const AirFrame& frame) const override;
    std::uint32_t bytes(const AirFrame& frame) const override;
    void access_timer(NodeId node, Time at, std::uint32_t tag) override;
    double access_draw(NodeId node, std::uint64_t index) const override;
    void sent(const QueuedFrame& frame) override;
    void lost(const QueuedFrame& frame, DropReason reason) override;

    // Network.
    void reserve(std::size_t robots);
    NodeId add(Robot robot);
    void route(Router router);
    void add_sink(Sink sink);
    void send(NodeId node, std::string payload, Outgoing what);
    void send_to(NodeId node, NodeId to, std::string payload, Outgoing what);
    void saturate(NodeId node, NodeId to, Outgoing what);
    void cut_off();
    void move(NodeId node, Movement movement);
    void place(NodeId node, Vec3 at);
    void switch_robot(NodeId node, bool on);
    void schedule(Time time, Action action);
    bool advance(Time end, std::uint64_t most_events);
    void watch_links() { links_wanted_ = true; }  ///< from now on
    std::optional<Db> interference_left_out() const;
    Node& node(NodeId id) { return nodes_.at(id.index()); }
    const Body& body(NodeId id) const { return bodies_[nodes_[id.index()].body]; }
    NodeId known(NodeId id) { return nodes_.at(id.index()), id; }  ///< @throws std::out_of_range

    // What the public class shows.
    NetworkSettings settings_;
    const Scene* scene_;
    std::shared_ptr<Planners> planners_;
    Medium medium_;
    Legs legs_;
    Chunks<Node> nodes_;  // stable: a reaction may add robots
    NameTable names_;
    std::map<NodeId, std::vector<Callback<>>> on_arrival_;
    std::map<NodeId, std::vector<Callback<NodeId>>> on_link_lost_;
    std::map<NodeId, Presence> away_;  // robots that are not there: off, and why
    std::shared_ptr<Metrics> metrics_;
    std::uint64_t served_ = 0;
    bool has_reactions_ = false;  // some node has an on_receive

  private:
    template <class R>
    void emit(const R& record) {
        if (!(wanted_ & kind_of<R>())) return;
        for (auto& sink : sinks_) {
            if (sink.kinds() & kind_of<R>()) sink.on(record, {legs_, messages_});
        }
    }

    void serve(const Scheduler<Occurrence>::Event& event);
    void count_events();
    void check_rate(BitRate rate) const;
    BitRate rate_of(const AirFrame& frame) const;
    std::uint32_t header() const { return dcf_ ? dcf_->settings().header : 0; }  // [bytes]
    void transmit_sensed(Flight& flight, Time end);
    static void sort(Medium::Receivers& receivers);
    void put_on_air(std::size_t slot, Time end);
    void forget_frames();
    void keep_past(NodeId id, bool on);
    void count_on_air(Time end);
    void garble(Flight& flight);
    using Frames = std::span<const Emission* const>;
    Duration longest_delay() const { return medium_.delay(on_air_.reach()); }
    void judge(const Flight& flight, std::span<Reception> receptions);
    void judge_collision(const Emission& judged, Frames others, Reception& reception);
    bool was_let_pass(const Emission& frame, Arrival& arrives, Frames others, NodeId node);
    void judge_sinr(const SinrFrame& sent, const Emission& judged, Frames others,
                    Reception& reception);
    SinrFrame sinr_frame(const Flight& flight) const;
    std::optional<Arrival> arrival(const Emission& frame, NodeId node);
    static Lock* lock_of(Flight& flight, NodeId node);
    Time served_until(EventKey key) const;
    std::span<Reception> next_of(Flight& flight, EventKey key);
    void arrive(const Scheduler<Occurrence>::Event& event);
    void receive(Flight& flight, std::span<Reception> receptions);
    void hand_up(const Flight& flight, std::span<Reception> receptions);
    void hand_up_heard(const Flight& flight, std::span<Reception> receptions);
    void receive_broadcast(Flight& flight, std::span<Reception> receptions);
    void receive_unicast(Flight& flight, std::span<Reception> receptions);
    void tell_stations(const Flight& flight, std::span<const Reception> receptions);
    void on_access_timer(NodeId node, std::uint32_t tag);
    void refill(NodeId node);
    MessageId new_message(NodeId node, NodeId to, std::string payload, Outgoing what);
    std::optional<std::uint32_t> reachable(NodeId from, NodeId to);
    void tell_if_unheard(const Flight& flight);
    void hand_over(const Flight& flight, std::span<const Reception> receptions);
    void react(NodeId node, std::uint64_t handed_over);
    void act(std::size_t slot);
    void begin_movements();
    void expect_leg_end(NodeId id);
    void tell_arrival(NodeId id);
    void next_leg(NodeId id);
    void begin_leg(NodeId id, const Leg& leg);
    void end_movement(NodeId id);
    void start_watch();
    void change_links();
    void tell_lost(NodeId node, NodeId from);
    void expect_link_change();
    void take(NodeId id, const Leg& leg);
    void put(NodeId id, const Leg& leg);
    Mover mover(NodeId id);

    Time now_ = start_of_run, end_of_run_ = start_of_run;  // of the current run_until
    std::uint64_t check_at_ = 0;  // scheduled events: no limit is reached before
    Scheduler<Occurrence> queue_;
    MessageTable messages_;
    Reachability reachability_;
    std::uint64_t transmissions_ = 0;  // so far
    std::uint64_t next_uid_ = 0;
    std::optional<Router> router_;
    std::vector<Sink> sinks_;
    KindMask wanted_ = 0;
    Slots<Flight> flights_;
    std::vector<Reception> heard_;      // of a flight: that are handed up ...
    std::vector<std::size_t> places_;   // ... and where they belong
    bool frames_meet_;                  // the rung is above threshold
    OnAir on_air_;                      // if frames meet
    std::vector<const Emission*> all_;  // what the flight that is judged may meet ...
    std::vector<Arrival> arrivals_;     // ... at one of its receivers
    SinrReceiver sinr_receiver_;
    std::vector<Time> ends_;       // at the rung sinr, of the frames that are on air
    std::size_t most_on_air_ = 0;  // of them at a time
    std::optional<AlohaAccess> aloha_;
    std::optional<Dcf> dcf_;
    std::map<NodeId, Saturated> saturated_;
    Slots<Action> actions_;
    std::vector<Body> bodies_;
    std::map<NodeId, Leg> interrupted_;  // by switching off
    std::map<NodeId, Leg> after_turn_;   // begins when the turn on the current leg is over
    std::size_t begun_ = 0;              // nodes whose movement has begun
    std::vector<NodeId> set_off_;        // of them, those that something comes of ...
    bool beginning_ = false;             // ... while movements begin
    bool links_wanted_ = false, running_ = false, receiving_ = false;
    std::optional<LinkWatch> watch_;  // once links are wanted and the run has begun
    Time link_event_ = never;         // the next one queued
};

}  // namespace rovernet
