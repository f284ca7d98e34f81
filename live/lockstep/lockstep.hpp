// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/session.hpp"
#include "live/carriers/front.hpp"
#include "live/carriers/request.hpp"
#include "live/lockstep/answer.hpp"
#include "live/lockstep/controllers.hpp"
#include "scenario/scenario.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// Reaction to a controller that disconnects without "bye".
enum class OnLoss {
    end,   ///< the run ends
    stop,  ///< the controller's robots stop, the run continues
    wait,  ///< simulated time stands still until the controller reconnects
};

/// Lock-step protocol: simulated time advances only when every controller has requested a step.
///
/// A controller owns robots and chooses its length of step. A controller's request is answered when
/// the simulation has reached the end of its step. Once every controller has sent its request, all
/// commands are executed in the order of robots, and simulated time advances to the earliest end of
/// a step. So results depend neither on the order in which requests arrive nor on the controllers'
/// computing time. A message that arrives during a step takes effect at the end of the step.
class Lockstep : public Front {
  public:
    struct Settings {
        std::size_t wait_for = 1;  ///< number of controllers needed to start the run
        OnLoss on_loss = OnLoss::end;
        /// Timeout for a request of a controller, and for the "hello" of a started program, in real
        /// time; none: no timeout.
        std::optional<std::chrono::nanoseconds> patience = {};
        /// Number of started programs if only these can connect; none: other programs can connect.
        std::optional<std::size_t> programs = {};
        /// Called with notices for the user, such as awaited controllers.
        std::function<void(std::string_view)> say = [](std::string_view) {};
    };

    Lockstep(Settings settings, Carrier carrier);

    /// Starts a run. After a restart of the run, connected controllers get the answer "welcome".
    void begin(Session& session, const Scenario& scenario) override;
    void opened(Connection, ListenerId) override {}
    void started(Connection program, const std::string& command) override;
    /// Handles a line of a controller, without its end. Errors are sent to the controller.
    /// @return 1; 0 if the line is no JSON object
    std::size_t received(Connection from, std::string_view line) override;
    /// Handles the loss of a controller's connection, before or after its "hello".
    void closed(Connection gone) override;
    Time next() const override { return step_end_.value_or(never); }
    /// Answers the controllers whose steps end now.
    void tell() override;
    Time limit() const override { return step_end_.value_or(now()); }
    void held(std::chrono::nanoseconds waited) override;
    bool failed_to_begin() const override { return !has_started_ && !fault_.empty(); }
    bool is_done() const override { return is_over_; }
    bool holds_end() const override { return !is_over_; }
    std::optional<std::uint64_t> new_seed() const override { return new_seed_; }
    void ended(std::string_view fingerprint, const Table& metrics) override;
    /// Error that ended the run; empty if the controllers ended it.
    std::string fault() const override { return fault_; }
    /// The patience if the patience has ended the run, between 0.4 s and 10 s; else 10 s.
    std::chrono::milliseconds time_to_end() const override;

    const Controllers& controllers() const { return controllers_; }

  private:
    bool is_object(std::string_view line);
    bool handle_line(Connection from, std::string_view line);
    void handle(Connection from, HelloRequest& hello);
    void handle(Connection from, StepRequest& step);
    void handle(Connection from, ResetRequest& reset);
    void handle(Connection from, ByeRequest& bye);
    Controller& asking(Connection from);
    void join(Connection from, const HelloRequest& hello);
    bool come_back(Connection from, const HelloRequest& hello);
    void check_claims(const HelloRequest& hello);
    void start_if_complete();
    void remove_leaving();
    void lose(Connection gone);
    void answer(Controller& controller);
    void go_on();
    void catch_up();
    void end_if_slow();
    void end_run(std::string reason, std::string fault);
    Time now() const { return session_->network().now(); }
    bool is_at_end() const { return now() >= session_->end(); }
    bool goes_on() const { return !is_over_ && !new_seed_; }

    Settings settings_;
    Carrier carrier_;
    Session* session_ = nullptr;
    const Scenario* scenario_ = nullptr;
    std::optional<AnswerWriter> answers_;
    RequestReader reader_;
    Controllers controllers_;
    std::map<Connection, std::string> silent_;  // commands of started programs before their "hello"
    std::vector<Connection> leaving_;  // connections that sent "bye" and wait for the last line
    std::deque<std::function<void()>> after_step_;  // calls deferred to the end of the step
    std::optional<Time> step_end_;                  // end of the current step; none: between steps
    bool has_started_ = false;
    bool is_over_ = false;
    std::optional<std::size_t> told_present_;
    std::uint64_t seed_ = 0;                 // seed that the controllers agree on
    std::optional<std::uint64_t> new_seed_;  // set if the run must start again
    std::string reason_ = "stopped", fault_;
};

}  // namespace rovernet
