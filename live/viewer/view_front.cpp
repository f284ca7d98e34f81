// SPDX-License-Identifier: MIT
#include "live/viewer/view_front.hpp"

#include "experiment/command_keys.hpp"
#include "live/carriers/command_reader.hpp"
#include "live/carriers/json_object.hpp"
#include "pictures/viewer/view_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace rovernet {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto part_length = 100ms;           // real time between two parts
constexpr auto patience = 10s;                // real time without pages after which nothing is kept
constexpr Duration unpaced_part = 100ms;      // simulated time between two parts, without a speed
constexpr std::size_t much_unsent = 256'000;  // [bytes] from which on a page gets no more
constexpr Range speeds{.low = 1e-6, .high = 1e6, .text = "from 1e-6 to 1e6"};
constexpr std::uint64_t longest_step = 1'000'000'000'000'000;  // [ns]

/// Reader of a page's commands, which name robots.
class PageCommands : public CommandReader {
  public:
    explicit PageCommands(const Network& network) : network_(network) {}

  protected:
    NodeId robot(const JsonElement& name) const override {
        const auto found = network_.find(name.text());
        if (!found) name.fail("unknown_robot", fmt::format("no robot {}", name.text()));
        return *found;
    }
    std::string bytes(const JsonElement& text) const override { return std::string(text.text()); }

  private:
    const Network& network_;
};

Table accepted() {
    Table answer;
    answer.set("ok", true);
    return answer;
}

}  // namespace

ViewFront::ViewFront(ViewControl control, Carrier carrier)
    : control_(control),
      carrier_(std::move(carrier)),
      parser_(std::make_unique<JsonParser>()),
      speed_(control.speed) {}

ViewFront::~ViewFront() = default;

void ViewFront::prepare(Session& session, const Scenario& scenario) {
    session_ = &session;
    scenario_ = &scenario;
    network_ = session.shared_network();
    if (control_.is_for_page) observe();
}

void ViewFront::begin(Session&, const Scenario&) {
    answers_.emplace(network_,
                     ViewerAnswers::History{
                         .of_message = [&](std::uint64_t uid) { return history().of_message(uid); },
                         .of_present = [&] { return history().of_present(); }});
    waits_ = control_.is_for_page;
    if (waits_) limit_ = now();
}

/// Begins to keep what happens.
void ViewFront::observe() {
    if (stream_ || is_over_) return;
    stream_.emplace(*scenario_, network_);
    history_.emplace(*scenario_, network_);
    log_.clear();
    next_ = now();
}

/// @throws RequestError if nothing was kept
ViewHistory& ViewFront::history() {
    if (!history_)
        throw RequestError(
            "over", "op",
            "the run has ended, and no data of the run were kept, because no page was open at the "
            "end");
    return *history_;
}

void ViewFront::opened(Connection client, ListenerId) {
    observe();
    if (log_.is_empty()) log_.begin(stream_->start(live()));
    if (std::exchange(waits_, false)) {
        limit_ = never;
        is_changed_ = true;
    }
    watching_[client] = 0;
    send_parts();
}

void ViewFront::closed(Connection gone) {
    watching_.erase(gone);
    last_seen_ = Clock::now();
    if (!watching_.empty() || !session_) return;
    for (auto* clients : {&drives_, &sends_}) {
        for (const auto& [robot, client] : *clients) session_->detach(client);
        clients->clear();
    }
    if (!control_.is_for_page) limit_ = never;  // nobody is left who could let it go on
}

std::size_t ViewFront::received(Connection from, std::string_view question) {
    const auto others = [&](std::string_view op, const JsonElement& asked) -> std::optional<Table> {
        if (op == "series") return series();
        if (op == "pace") return pace(asked);
        if (op == "step") return step(asked);
        if (op == "command") return command(asked);
        return std::nullopt;
    };
    carrier_.send(from, answers_->answer(question, others));
    return 1;
}

/// Series for the page's charts, and the metrics of a run that is over.
Table ViewFront::series() const {
    if (!stream_)
        throw RequestError(
            "over", "op",
            "the run has ended, and no data of the run were kept, because no page was open at the "
            "end");
    Table answer;
    answer.set("from_ns", (stream_->begin() - start_of_run).count());
    answer.set("series", stream_->series());
    answer.set("metrics", metrics_);
    return answer;
}

/// State of the run, the entry `live` of a head.
Table ViewFront::live() const {
    Table live;
    live.set("now_ns", (now() - start_of_run).count());
    live.set("speed", speed_ ? Value(*speed_) : Value());
    live.set("paused", !is_over_ && limit_ <= now());
    live.set("ended", is_over_);
    live.set("controls_time", control_.of_time && !is_over_);
    live.set("controls_robots", control_.of_robots && !is_over_);
    live.set("left_out", std::uint64_t{log_.left_out()});
    if (is_over_) live.set("fingerprint", fingerprint_);
    return live;
}

Time ViewFront::next() const {
    if (!stream_) return never;
    return is_changed_ ? now() : std::min(next_, limit_ > now() ? limit_ : never);
}

void ViewFront::tell() {
    if (!stream_) return;
    const auto real = Clock::now();
    const Duration simulated = speed_ ? from_seconds(seconds(part_length) * *speed_) : unpaced_part;
    next_ = now() + std::max<Duration>(simulated, 1ns);
    if (watching_.empty() && !control_.is_for_page && real > last_seen_ + patience) {
        stream_.reset();
        history_.reset();
        log_.clear();
        return;
    }
    const bool is_stop = limit_ <= now();
    if (!is_changed_ && !is_stop && real < last_part_ + part_length / 2) return;
    last_part_ = real;
    is_changed_ = false;
    add_part(false);
}

void ViewFront::add_part(bool is_last) {
    if (log_.is_empty()) log_.begin(stream_->start(live()));
    log_.add(stream_->part(live(), is_last));
    send_parts();
}

/// Sends the next parts to the pages that have read the ones before.
void ViewFront::send_parts() {
    const bool is_leaving = is_over_ && !stays();
    for (auto& [client, place] : watching_) {
        log_.send(
            place, [&, to = client] { return is_leaving || carrier_.unsent(to) < much_unsent; },
            [&, to = client](std::string_view file) { carrier_.send_binary(to, file); });
    }
}

Time ViewFront::limit() const { return limit_; }

void ViewFront::held(std::chrono::nanoseconds) { send_parts(); }

/// @throws RequestError if pages are not allowed to do something, or if the run is over
void ViewFront::check_control(bool is_allowed, std::string_view what) const {
    if (!is_allowed) {
        throw RequestError(
            "not_allowed", "op",
            fmt::format("the page is not allowed to {}; the option --view-control allows this",
                        what));
    }
    if (is_over_) throw RequestError("over", "op", "the run has ended");
}

/// Sets the speed of the run, and whether it is paused.
Table ViewFront::pace(const JsonElement& question) {
    const auto [id, op, speed, paused] =
        members(question, std::array<std::string_view, 4>{"id", "op", "speed", "paused"});
    check_control(control_.of_time, "pause this run or change its speed");
    if (speed) {
        speed_ = speed->value.is_null() ? std::nullopt : std::optional(speed->number(speeds));
        carrier_.set_speed(speed_);
        next_ = now();
    }
    if (paused) limit_ = paused->truth() ? now() : never;
    is_changed_ = true;
    return accepted();
}

/// Lets the run go on for a simulated time, then pauses it.
Table ViewFront::step(const JsonElement& question) {
    const auto [id, op, length] =
        members(question, std::array<std::string_view, 3>{"id", "op", "ns"});
    check_control(control_.of_time, "pause this run or change its speed");
    const std::uint64_t ns =
        needed(length, question, "ns", "\"ns\":1000").whole_number(1, longest_step);
    limit_ = now() + Duration{static_cast<std::int64_t>(ns)};
    is_changed_ = true;
    return accepted();
}

/// Client of the session by which pages command a robot. One that only sends does not drive the
/// robot, which goes on with its own movement.
ClientId ViewFront::client_of(NodeId robot, bool drives) {
    auto& clients = drives ? drives_ : sends_;
    if (const auto found = clients.find(robot); found != clients.end()) return found->second;
    if (!drives) return sends_[robot] = session_->attach_radios({robot}, "viewer", false);
    if (session_->driver(robot)) {
        throw RequestError("taken", "robot",
                           "robot " + network_->name(robot) +
                               " is driven by another program, so this page cannot drive it");
    }
    return drives_[robot] = session_->attach({robot}, "viewer", false);
}

/// Carries out a command to a robot.
Table ViewFront::command(const JsonElement& question) {
    const auto [id, op, index, what] =
        members(question, std::array<std::string_view, 4>{"id", "op", "robot", "do"});
    check_control(control_.of_robots, "command robots");
    const NodeId robot{static_cast<std::uint32_t>(
        needed(index, question, "robot", "0").whole_number(0, network_->size() - 1))};
    const JsonElement& given = needed(what, question, "do", R"({"stop":true})");
    const auto command =
        read_one_of(AllCommands{}, PageCommands(*network_), given, *network_, robot);
    if (!command) given.fail("bad_value", "expected a command, such as {\"goal\":[3,4]}");
    const std::string why = session_->why_not(robot, *command);
    if (!why.empty()) throw RequestError("no_room", "do", why);
    const bool drives = !std::holds_alternative<SendCommand>(*command);
    const auto uid = session_->carry_out(client_of(robot, drives), robot, *command, ++commands_);
    is_changed_ = true;
    Table answer = accepted();
    if (uid) answer.set("uid", *uid);
    return answer;
}

void ViewFront::ended(std::string_view fingerprint, const Table& metrics) {
    metrics_ = metrics;
    session_ = nullptr;
    is_over_ = true;
    fingerprint_ = fingerprint;
    if (stream_) add_part(true);
}

FrontListeners view_listener(const Address& at, const ViewControl& control) {
    WebPages pages;
    pages["/"] = {"text/html; charset=utf-8", live_page(), true, served_policy()};
    return {.entries = {{.at = at, .is_web = true}},
            .make =
                [control](Front::Carrier carrier) {
                    return std::make_unique<ViewFront>(control, std::move(carrier));
                },
            .pages = std::move(pages)};
}

}  // namespace rovernet
