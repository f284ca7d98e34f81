// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/session.hpp"
#include "live/lockstep/answer.hpp"
#include "live/lockstep/controllers.hpp"
#include "live/carriers/request.hpp"
#include "scenario/scenario.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rovernet {

/// What happens when a controller has gone without a word.
enum class OnLoss {
    end,   ///< the run ends
    stop,  ///< its robots stop, the others go on
    wait,  ///< time waits until it is back
};

/// Lock-step: a session whose time goes on only when every controller has asked for a step.
///
/// A controller owns robots and has a step of its own. It asks, and is answered once the simulation
/// has reached the end of its step. Simulated time goes to the nearest end of a step as soon as
/// nobody owes a question; the commands of all who asked are carried out before that, by robot. So
/// neither the order of arrival nor the time that a controller takes shows in a result.
///
///   Lockstep lockstep({}, [](Lockstep::Connection to, std::string_view line) { ... });
///   lockstep.begin(session, scenario, [&] { return fingerprint->text(); });
///   lockstep.receive(0, R"({"type":"hello","protocol":1,"robots":["A"],"step":"100 ms"})");
///   if (lockstep.is_due()) lockstep.advance([] { return true; });
///
/// It knows no sockets and no clocks: whoever carries the lines calls it, from one thread.
class Lockstep {
  public:
    using Connection = Controller::Connection;
    /// Carries a line, without its end, to a controller. It must not call back.
    using Tell = std::function<void(Connection to, std::string_view line)>;

    struct Settings {
        std::size_t wait_for = 1;  ///< controllers with which the run begins
        OnLoss on_loss = OnLoss::end;
    };

    Lockstep(Settings settings, Tell tell);

    /// Begins a run, the first one or that of a reset: controllers that are there are welcomed.
    /// @param session      at its start; it and `scenario` have to live until the next begin()
    /// @param fingerprint  of the run so far
    void begin(Session& session, const Scenario& scenario,
               std::function<std::string()> fingerprint);

    /// A controller's line, without its end. What is wrong with it is told to the controller.
    /// @return whether it is a JSON object
    bool receive(Connection from, std::string_view line);
    /// Tells a controller that its line cannot be read at all.
    void refuse(Connection to, const RequestError& fault) { tell_(to, error_line(fault, {})); }
    /// A connection has gone, whether or not it had said hello.
    void lost(Connection connection);

    /// Nobody owes a question: advance() has something to do.
    bool is_due() const {
        return state_ == State::runs && has_started_ && controllers_.have_all_asked();
    }
    /// Carries out what was commanded, runs to the nearest end of a step and answers.
    /// @param go_on  asked now and then; false ends the run
    /// @throws InputError, RunError as Session::step()
    void advance(const std::function<bool()>& go_on);
    /// Ends the run.
    /// @param reason  of the `end` lines: stopped, patience
    /// @param fault   why it is none of a controller's doing that the run ended well; may be empty
    void end_run(std::string reason, std::string fault);

    enum class State {
        runs,
        restarts,  ///< begin() is to be called with a session of seed()
        over,      ///< tell_end() is to be called with the results
    };
    State state() const { return state_; }
    std::uint64_t seed() const { return seed_; }
    /// Why the run ended otherwise than by its controllers' will; empty if it did not.
    const std::string& fault() const { return fault_; }
    /// Tells everybody who is still there that the run has ended.
    void tell_end(std::string_view fingerprint, const Table& metrics);

    const Controllers& controllers() const { return controllers_; }
    /// Number of controllers with which the run begins.
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
    void let_go();
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
    std::vector<Connection> leaving_;  // said bye, and wait for the last line
    bool has_started_ = false;
    State state_ = State::runs;
    std::uint64_t seed_ = 0;
    std::string reason_, fault_;
};

}  // namespace rovernet
