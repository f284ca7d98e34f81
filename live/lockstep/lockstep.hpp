// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/session.hpp"
#include "live/carriers/request.hpp"
#include "live/lockstep/answer.hpp"
#include "live/lockstep/controllers.hpp"
#include "scenario/scenario.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// Reaction to a controller that disconnects without "bye".
enum class OnLoss {
    end,   ///< the run ends
    stop,  ///< the controller's robots stop, the run continues
    wait,  ///< simulated time stands still until it reconnects
};

/// Lock-step protocol: simulated time advances only when every controller has requested a step.
///
/// A controller owns robots and chooses its length of step. Its request is answered when the
/// simulation has reached the end of its step. Once every controller has sent its request, all
/// commands are executed in the order of robots, and simulated time advances to the earliest end of
/// a step. So results depend neither on the order of arrival nor on the computing time of
/// controllers.
///
///   Lockstep lockstep({}, [](Lockstep::Connection to, std::string_view line) { ... });
///   lockstep.begin(session, scenario, [&] { return fingerprint->text(); });
///   lockstep.receive(0, R"({"type":"hello","protocol":1,"robots":["A"],"step":"100 ms"})");
///   if (lockstep.is_due()) lockstep.advance([] { return true; });
///
/// The class uses neither sockets nor clocks: the code that transports the lines calls it, from one
/// thread.
class Lockstep {
  public:
    using Connection = Controller::Connection;
    /// Sends a line, without its end, to a controller. Must not call this object back.
    using Tell = std::function<void(Connection to, std::string_view line)>;

    struct Settings {
        std::size_t wait_for = 1;  ///< number of controllers needed to start the run
        OnLoss on_loss = OnLoss::end;
    };

    Lockstep(Settings settings, Tell tell);

    /// Starts a run: the first run, or a run after a reset. Connected controllers get "welcome".
    /// @param session      session at its start; session and scenario must live until the next
    /// begin()
    /// @param fingerprint  returns the fingerprint of the run so far
    void begin(Session& session, const Scenario& scenario,
               std::function<std::string()> fingerprint);

    /// Handles a line of a controller, without its end. Errors are sent to the controller.
    /// @return whether the line is a JSON object
    bool receive(Connection from, std::string_view line);
    /// Sends the error of an unreadable line to a controller.
    void refuse(Connection to, const RequestError& fault) { tell_(to, error_line(fault, {})); }
    /// Handles the loss of a controller's connection, before or after its "hello".
    void lost(Connection connection);

    /// Whether every controller has sent its next request, so that advance() can run.
    bool is_due() const {
        return state_ == State::runs && has_started_ && controllers_.have_all_asked();
    }
    /// Executes the controllers' commands, runs to the earliest end of a step, and answers.
    /// @param go_on  called now and then; returning false ends the run
    /// @throws InputError, RunError as Session::step()
    void advance(const std::function<bool()>& go_on);
    /// Ends the lock-step run.
    /// @param reason  reason in the `end` lines: stopped, patience
    /// @param fault   error that ended the run; may be empty
    void end_run(std::string reason, std::string fault);

    enum class State {
        runs,
        restarts,  ///< begin() must be called, with a new session with the seed seed()
        over,      ///< the run is over: tell_end() must be called
    };
    State state() const { return state_; }
    std::uint64_t seed() const { return seed_; }
    /// Error that ended the run; empty if the controllers ended it.
    const std::string& fault() const { return fault_; }
    /// Sends the `end` line to all connected controllers.
    void tell_end(std::string_view fingerprint, const Table& metrics);

    const Controllers& controllers() const { return controllers_; }
    /// Number of controllers needed to start the run.
    std::size_t wanted() const { return settings_.wait_for; }
    bool has_started() const { return has_started_; }

  private:
    void handle(Connection from, HelloRequest& hello);
    void handle(Connection from, StepRequest& step);
    void handle(Connection from, ResetRequest& reset);
    void handle(Connection from, ByeRequest& bye);
    Controller& asking(Connection from);
    bool come_back(Connection from, const HelloRequest& hello);
    void check_claims(const HelloRequest& hello);
    void start_if_complete();
    void remove_leaving();
    void carry_out();
    void answer(Controller& controller);
    bool is_done() const { return session_->network().now() >= session_->end(); }

    Settings settings_;
    Tell tell_;
    Session* session_ = nullptr;
    const Scenario* scenario_ = nullptr;
    std::function<std::string()> fingerprint_;
    std::optional<AnswerWriter> answers_;
    RequestReader reader_;
    Controllers controllers_;
    std::vector<Connection> leaving_;  // connections that sent "bye" and wait for the last line
    bool has_started_ = false;
    State state_ = State::runs;
    std::uint64_t seed_ = 0;
    std::string reason_, fault_;
};

}  // namespace rovernet
