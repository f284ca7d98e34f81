// SPDX-License-Identifier: MIT
#include "experiment/network.hpp"

#include "sim/error.hpp"
#include "sim/random.hpp"

#include <fmt/format.h>

#include <cassert>
#include <deque>
#include <stdexcept>

namespace rovernet {
namespace {

/// What an event is about; `data` means what `kind` says.
struct Occurrence {
    enum class Kind : std::uint32_t { frame, router_timer, leg_end, handed_over, action };
    Kind kind;
    NodeId node;
    std::uint64_t data;
};

/// A frame on its way to its receivers, some of which it may have reached already.
struct Flight {
    Frame frame;
    std::vector<Reception> receptions;
    std::size_t arrived = 0;
};

/// Shared, so that a callback keeps its state and outlives its being replaced while it runs.
template <class... Arguments>
using Callback = std::shared_ptr<std::function<void(Arguments...)>>;

struct Action {
    Callback<> call = nullptr;
    Duration period{0};
};

Callback<> callback(std::function<void()> call) {
    return std::make_shared<std::function<void()>>(std::move(call));
}

/// What the network keeps of a robot beyond its leg and its radio.
struct Node {
    std::string name;
    std::uint64_t key;
    Meters radius;
    Movement movement;
    std::uint32_t messages_sent = 0;
    bool moving = false;                  // its movement has begun
    std::optional<Leg> interrupted = {};  // by switching off
    std::vector<Callback<const Message&>> on_receive = {};
    std::vector<Callback<>> on_arrival = {};
};

const Scene open_field;

}  // namespace

class Network::Engine final : public LinkLayer {
  public:
    explicit Engine(NetworkSettings settings)
        : settings_(std::move(settings)),
          scene_(settings_.scene ? settings_.scene.get() : &open_field),
          planners_(*scene_),
          medium_({.scene = scene_,
                   .floor_height = settings_.floor_height,
                   .propagation_delay = settings_.propagation_delay,
                   .seed = settings_.seed,
                   .replication = settings_.replication}) {
        if (!positive.contains(settings_.floor_height.value)) {
            throw_out_of_range("network", "floor_height", positive.text,
                               settings_.floor_height.value);
        }
        if (settings_.metrics) {
            metrics_ = std::make_shared<Metrics>();
            add_sink(Sink{metrics_});
        }
    }

    // LinkLayer, for the router.
    Time now() const override { return now_; }
    std::size_t size() const override { return nodes_.size(); }
    const Message& message(MessageId id) const override { return messages_[id]; }
    bool is_on(NodeId node) const override { return medium_.is_on(node); }
    std::uint64_t key(NodeId node) const override { return nodes_[node.index()].key; }
    void broadcast(const Frame& frame, std::optional<NodeId> heard_from) override;
    void drop(NodeId node, const Frame& frame, DropReason reason) override {
        emit(Dropped{now_, node, frame, reason});
    }
    void timer(NodeId node, Time at, std::uint64_t tag) override {
        queue_.schedule(at, Priority::timer, {Occurrence::Kind::router_timer, node, tag});
    }
    void hold(MessageId id) override { messages_.hold(id); }
    void release(MessageId id) override {
        if (messages_.release(id)) router_->forget(id);
    }
    double draw(Purpose purpose, NodeId node, MessageId id, std::uint64_t index) const override {
        return uniform(
            {settings_.seed, settings_.replication, purpose, key(node), messages_[id].key, index});
    }

    // Network.
    NodeId add(Robot robot);
    void route(Router router);
    void add_sink(Sink sink) {
        wanted_ |= sink.kinds();
        sinks_.push_back(std::move(sink));
    }
    void send(NodeId node, std::string payload, std::uint32_t bytes);
    void move(NodeId node, Movement movement);
    void switch_robot(NodeId node, bool on);
    void schedule(Time time, Action action);
    bool advance(Time end, std::uint64_t most_events);
    Node& node(NodeId id) { return nodes_.at(id.index()); }

    // What the public class shows.
    NetworkSettings settings_;
    const Scene* scene_;
    Planners planners_;
    Medium medium_;
    Legs legs_;
    std::deque<Node> nodes_;  // stable: a reaction may add robots
    std::map<std::string, NodeId, std::less<>> by_name_;
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
    void check_event_limit() const;
    template <class Key>
    bool comes_next(Key key) {
        return key.time() <= end_of_run_ && queue_.runs_before_next(key);
    }
    void arrive(const Scheduler<Occurrence>::Event& event);
    void receive(Flight& flight, std::span<Reception> receptions);
    void hand_over(const Flight& flight, std::span<const Reception> receptions);
    void react(NodeId node, MessageId id);
    void act(std::size_t slot);
    void begin_movements();
    void next_leg(NodeId id);
    void take(NodeId id, const Leg& leg);
    Mover mover(NodeId id) { return {now_, legs_.position(id, now_), node(id).radius, planners_}; }

    Time now_ = start_of_run;
    Time end_of_run_ = start_of_run;  // of the current run_until
    Scheduler<Occurrence> queue_;
    MessageTable messages_;
    std::uint64_t next_uid_ = 0;
    std::optional<Router> router_;
    std::vector<Sink> sinks_;
    KindMask wanted_ = 0;
    std::deque<Flight> flights_;  // stable: a sink may not move one under work
    std::vector<std::size_t> free_flights_;
    std::vector<Action> actions_;
    std::vector<std::size_t> free_actions_;
    std::size_t begun_ = 0;  // nodes whose movement has begun
    bool running_ = false;
    bool receiving_ = false;
};

// ---- Robots and their movement

NodeId Network::Engine::add(Robot robot) {
    if (robot.name.empty()) robot.name = fmt::format("r{}", nodes_.size());
    if (by_name_.contains(robot.name)) {
        throw std::invalid_argument(fmt::format("two robots are named \"{}\"", robot.name));
    }
    if (!non_negative.contains(robot.radius.value)) {
        throw_out_of_range("robot", "radius", non_negative.text, robot.radius.value);
    }
    for (const double x : {robot.at.x, robot.at.y, robot.at.z}) {
        if (!any.contains(x)) throw_out_of_range("robot", "at", "finite", x);
    }
    const auto key = name_key(robot.name);
    medium_.add(robot.radio, key, robot.propagation.value_or(settings_.propagation));
    const NodeId id = legs_.add({.start = now_, .from = robot.at, .to = robot.at});
    by_name_[robot.name] = id;
    nodes_.push_back({std::move(robot.name), key, robot.radius, std::move(robot.move)});
    if (running_) begin_movements();
    return id;
}

void Network::Engine::begin_movements() {
    while (begun_ < nodes_.size()) {
        const NodeId id{static_cast<std::uint32_t>(begun_++)};
        if (medium_.is_on(id)) {
            next_leg(id);
        } else {
            take(id, standing_leg(mover(id)));
        }
    }
}

void Network::Engine::next_leg(NodeId id) {
    Mover asking = mover(id);
    const Step step = node(id).movement.next_leg(asking);
    const bool begins = !std::exchange(node(id).moving, true);
    if (const auto* leg = std::get_if<Leg>(&step)) return take(id, *leg);

    const Leg rest = standing_leg(asking);
    if (begins)
        take(id, rest);  // where it is has not been told yet
    else
        legs_.replace(id, rest);
    if (const auto* blocked = std::get_if<Blocked>(&step)) {
        emit(NoWay{now_, id, blocked->goal});
        return;
    }
    emit(Arrived{now_, id});
    for (std::size_t i = 0; i < node(id).on_arrival.size(); ++i) {
        schedule(now_ + least_reaction, {node(id).on_arrival[i]});
    }
}

void Network::Engine::take(NodeId id, const Leg& leg) {
    legs_.replace(id, leg);
    emit(Moved{now_, id, leg});
    if (leg.end == never) return;
    queue_.schedule(leg.end, Priority::timer, {Occurrence::Kind::leg_end, id, legs_.version(id)});
}

void Network::Engine::move(NodeId id, Movement movement) {
    node(id).movement = std::move(movement);
    node(id).moving = false;
    node(id).interrupted.reset();
    if (running_ && medium_.is_on(id)) next_leg(id);
}

void Network::Engine::switch_robot(NodeId id, bool on) {
    if (medium_.is_on(id) == on) return;
    medium_.switch_radio(id, on);
    emit(Switched{now_, id, on});
    if (!running_) return;
    Node& robot = node(id);
    if (!on) {
        robot.interrupted = legs_.leg(id);
        take(id, standing_leg(mover(id)));
    } else if (!robot.moving) {
        next_leg(id);
    } else if (const auto leg = std::exchange(robot.interrupted, std::nullopt)) {
        const Duration off = now_ - legs_.leg(id).start;
        const bool unending = leg->end == never;
        take(id, {.start = now_,
                  .end = unending ? never : leg->end + off,
                  .from = legs_.position(id, now_),
                  .velocity = leg->velocity,
                  .to = unending ? legs_.position(id, now_) : leg->to});
    }
}

// ---- Messages

void Network::Engine::route(Router router) {
    if (router_) throw std::invalid_argument("this network has a routing protocol already");
    router_.emplace(std::move(router));
}

void Network::Engine::send(NodeId id, std::string payload, std::uint32_t bytes) {
    if (!router_) throw std::invalid_argument("no routing protocol: call route() before sending");
    if (!medium_.is_on(id)) return;
    Node& origin = node(id);
    const std::uint32_t number = origin.messages_sent++;
    const MessageId message = messages_.add({.origin = id,
                                             .uid = next_uid_++,
                                             .number = number,
                                             .key = combine(origin.key, number),
                                             .size = bytes,
                                             .created = now_,
                                             .payload = std::move(payload)});
    Sent sent{now_, id, message, router_->initial_ttl(), static_cast<std::uint32_t>(size()), {}};
    if (wanted_ & kind_reachable) sent.reachable = medium_.reachable(id, now_, legs_);
    emit(sent);
    router_->send(*this, id, message);
    release(message);
}

void Network::Engine::broadcast(const Frame& frame, std::optional<NodeId> heard_from) {
    if (receiving_) {
        throw std::invalid_argument("a router may not send while it receives: set a timer");
    }
    emit(Transmitted{now_, frame, heard_from});
    std::size_t slot = flights_.size();
    if (free_flights_.empty()) {
        flights_.emplace_back();
    } else {
        slot = free_flights_.back();
        free_flights_.pop_back();
    }
    Flight& flight = flights_[slot];
    flight.frame = frame;
    flight.receptions.clear();
    flight.arrived = 0;
    const Time end = now_ + airtime(medium_.radio(frame.sender), messages_[frame.message].size);
    medium_.receivers(frame.sender, now_, end, legs_, flight.receptions);
    if (flight.receptions.empty()) {
        free_flights_.push_back(slot);
        return;
    }
    messages_.hold(frame.message);
    queue_.schedule(flight.receptions.front().time, Priority::frame_end,
                    {Occurrence::Kind::frame, frame.sender, slot});
}

/// Serves the receptions of a transmission by one event: as many as come before anything else can
/// happen, then the event is queued again for the rest, in its old place among equal times.
void Network::Engine::arrive(const Scheduler<Occurrence>::Event& event) {
    Flight& flight = flights_[event.payload.data];
    auto& all = flight.receptions;
    for (auto key = event.key;;) {
        const std::size_t first = flight.arrived;
        // Nothing that a reception sets off happens sooner than least_reaction after it.
        const Time horizon = all[first].time + least_reaction;
        std::size_t last = first + 1;
        while (last < all.size() && all[last].time <= horizon &&
               comes_next(event.key.at(all[last].time))) {
            ++last;
        }
        flight.arrived = last;
        now_ = all[last - 1].time;
        receive(flight, std::span{all}.subspan(first, last - first));
        if (last == all.size()) break;
        key = event.key.at(all[last].time);
        if (!comes_next(key)) {
            queue_.requeue(key, event.payload);
            return;
        }
    }
    const MessageId message = flight.frame.message;
    free_flights_.push_back(event.payload.data);
    release(message);
}

void Network::Engine::receive(Flight& flight, std::span<Reception> receptions) {
    receiving_ = true;
    auto next = receptions.begin();
    while (next != receptions.end()) {
        const auto heard = [&](const Reception& r) { return medium_.is_on(r.node); };
        const auto deaf = std::find_if_not(next, receptions.end(), heard);
        if (next != deaf) router_->on_receive(*this, flight.frame, {next, deaf});
        next = std::find_if(deaf, receptions.end(), heard);
        for (auto r = deaf; r != next; ++r) r->fate = Fate::off;
    }
    receiving_ = false;
    emit(Received{flight.frame, receptions});
    if (has_reactions_) hand_over(flight, receptions);
}

void Network::Engine::hand_over(const Flight& flight, std::span<const Reception> receptions) {
    for (const auto& r : receptions) {
        if (!r.delivered || node(r.node).on_receive.empty()) continue;
        messages_.hold(flight.frame.message);
        queue_.schedule(r.time + least_reaction, Priority::user,
                        {Occurrence::Kind::handed_over, r.node, flight.frame.message.value});
    }
}

void Network::Engine::react(NodeId id, MessageId message) {
    const Message heard = messages_[message];  // a copy: reactions may send
    release(message);
    if (!medium_.is_on(id)) return;
    auto& reactions = node(id).on_receive;
    for (std::size_t i = 0; i < reactions.size(); ++i) {
        const auto reaction = reactions[i];
        (*reaction)(heard);
    }
}

// ---- Events

void Network::Engine::schedule(Time time, Action action) {
    if (time < now_) {
        throw std::invalid_argument(
            fmt::format("an action at {} s, but it is {} s already", seconds(time), seconds(now_)));
    }
    std::size_t slot = actions_.size();
    if (free_actions_.empty()) {
        actions_.emplace_back();
    } else {
        slot = free_actions_.back();
        free_actions_.pop_back();
    }
    actions_[slot] = std::move(action);
    queue_.schedule(time, Priority::user, {Occurrence::Kind::action, NodeId{0}, slot});
}

void Network::Engine::act(std::size_t slot) {
    const Action action = actions_[slot];  // a copy: the call may add actions
    if (action.period > Duration{0}) {
        queue_.schedule(now_ + action.period, Priority::user,
                        {Occurrence::Kind::action, NodeId{0}, slot});
    } else {
        actions_[slot] = {};
        free_actions_.push_back(slot);
    }
    (*action.call)();
}

void Network::Engine::serve(const Scheduler<Occurrence>::Event& event) {
    const auto& [kind, node_id, data] = event.payload;
    switch (kind) {
        case Occurrence::Kind::frame: return arrive(event);
        case Occurrence::Kind::router_timer: return router_->on_timer(*this, node_id, data);
        case Occurrence::Kind::leg_end:
            if (legs_.version(node_id) == data) next_leg(node_id);
            return;
        case Occurrence::Kind::handed_over:
            return react(node_id, MessageId{static_cast<std::uint32_t>(data)});
        case Occurrence::Kind::action: return act(data);
    }
}

void Network::Engine::check_event_limit() const {
    if (queue_.scheduled() <= settings_.event_limit) return;
    throw RunError(fmt::format(
        "event limit of {} reached at {:.9f} s; raise [scenario] event_limit, or lower the load: "
        "under duplicates = \"forward\" it grows with every hop of the TTL",
        settings_.event_limit, seconds(now_)));
}

bool Network::Engine::advance(Time end, std::uint64_t most_events) {
    running_ = true;
    end_of_run_ = end;
    begin_movements();
    for (auto next = queue_.next_time(); next && *next <= end; next = queue_.next_time()) {
        if (most_events-- == 0) return false;
        check_event_limit();
        const auto event = queue_.pop();
        now_ = event.key.time();
        ++served_;
        serve(event);
    }
    now_ = std::max(now_, end);
    return true;
}

// ---- The public class

Network::Network(NetworkSettings settings)
    : engine_(std::make_unique<Engine>(std::move(settings))) {}
Network::~Network() = default;

NodeId Network::add(Robot robot) { return engine_->add(std::move(robot)); }
void Network::route(Router router) { engine_->route(std::move(router)); }
void Network::add_sink(Sink sink) { engine_->add_sink(std::move(sink)); }

void Network::broadcast(NodeId node, std::string payload, std::optional<std::uint32_t> size) {
    const auto bytes = size.value_or(static_cast<std::uint32_t>(payload.size()));
    engine_->send(node, std::move(payload), bytes);
}

void Network::on_receive(NodeId node, std::function<void(const Message&)> react) {
    engine_->node(node).on_receive.push_back(
        std::make_shared<std::function<void(const Message&)>>(std::move(react)));
    engine_->has_reactions_ = true;
}

void Network::on_arrival(NodeId node, std::function<void()> react) {
    engine_->node(node).on_arrival.push_back(callback(std::move(react)));
}

void Network::move(NodeId node, Movement movement) { engine_->move(node, std::move(movement)); }
void Network::switch_off(NodeId node) { engine_->switch_robot(node, false); }
void Network::switch_on(NodeId node) { engine_->switch_robot(node, true); }

void Network::at(Time time, std::function<void()> action) {
    engine_->schedule(time, {callback(std::move(action))});
}

void Network::every(Duration period, std::function<void()> action) {
    if (period <= Duration{0}) throw_out_of_range("every", "period", "> 0", seconds(period));
    engine_->schedule(now() + period, {callback(std::move(action)), period});
}

void Network::run_until(Time end) {
    engine_->advance(end, std::numeric_limits<std::uint64_t>::max());
}
bool Network::advance(Time end, std::uint64_t most_events) {
    return engine_->advance(end, most_events);
}
Time Network::now() const { return engine_->now(); }
std::size_t Network::size() const { return engine_->size(); }
std::uint64_t Network::events() const { return engine_->served_; }
const std::string& Network::name(NodeId node) const { return engine_->node(node).name; }

std::optional<NodeId> Network::find(std::string_view name) const {
    const auto found = engine_->by_name_.find(name);
    if (found == engine_->by_name_.end()) return std::nullopt;
    return found->second;
}

Vec3 Network::position(NodeId node) const { return engine_->legs_.position(node, now()); }
const Legs& Network::legs() const { return engine_->legs_; }
const Medium& Network::medium() const { return engine_->medium_; }
const Scene& Network::scene() const { return *engine_->scene_; }

MetricValues Network::metrics() const {
    if (!engine_->metrics_) throw std::invalid_argument("this network was made without metrics");
    return engine_->metrics_->values();
}

}  // namespace rovernet
