// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/session.hpp"
#include "live/carriers/request.hpp"
#include "live/lockstep/answer.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rovernet {

/// Controller (program) of robots in a lock-step run: connected, lost, or in this process.
struct Controller {
    /// Number of the connection that carries the controller's lines, unique in the run.
    using Connection = std::uint32_t;
    enum class State {
        owes,         ///< the controller's next request is missing, so that time stands still
        waits,        ///< the controller waits for the answer to its step
        wants_reset,  ///< the controller has requested a reset of the run
        leaves,       ///< the controller has sent "bye"
    };

    /// @param from   connection of the controller; none: a controller in this process
    /// @param hello  request whose robots must not belong to any other controller
    Controller(std::optional<Connection> from, HelloRequest hello);

    /// Starts a run: attaches the controller's robots in the session, and waits for a request.
    void join(Session& session);
    /// Stores the request of a step, which starts now and ends with the scenario at the latest.
    /// @param request  gets the previous step's list of commands in exchange, to reuse its memory
    void ask(const Session& session, StepRequest& request);

    std::optional<Connection> connection;  ///< connection; none: lost, or in this process
    HelloRequest hello;
    std::vector<NodeId> own;  ///< robots of the controller's "hello", in ascending order
    ClientId client = 0;      ///< id of the controller as a client of the session
    State state = State::owes;
    Time step_end = start_of_run;  ///< end of the step that the controller requested
    StepRequest step = {};         ///< last step request, with commands not executed yet
    bool has_stepped = false;
    std::optional<std::uint64_t> reset_seed = {};
    std::vector<SentMessage> sent = {};  ///< messages sent in the controller's last step
    std::string last_state = {};  ///< last "state" line, sent again if the controller reconnects
};

/// Controllers of a lock-step run, in the order of their "hello" requests. Executes the steps that
/// controllers request. References to controllers are valid until a controller joins or leaves.
class Controllers {
  public:
    using Connection = Controller::Connection;

    auto begin() { return all_.begin(); }
    auto end() { return all_.end(); }
    auto begin() const { return all_.begin(); }
    auto end() const { return all_.end(); }
    std::size_t size() const { return all_.size(); }
    bool empty() const { return all_.empty(); }

    /// Controller at the other end of a connection; null before its "hello".
    Controller* of(Connection connection);
    /// Controller with this name, connected or lost; null if no controller has the name.
    Controller* named(std::string_view name);

    void add(Controller controller) { all_.push_back(std::move(controller)); }
    void remove(Connection connection);
    /// Removes all controllers.
    void clear() { all_.clear(); }
    /// Removes controllers that sent "bye". @return the removed controllers, in the order of their
    /// first robots
    std::vector<Controller> take_leaving();

    /// Names of controllers whose next request is missing.
    std::vector<std::string> owing() const;
    /// Whether at least one controller exists, and all controllers have sent their next requests.
    bool have_all_asked() const;
    /// Earliest end of the steps that controllers requested; `never` if no controller waits.
    Time next_end() const;

    /// Executes the commands of the current requests now: in the order of robots, for each robot in
    /// the order of the request.
    void carry_out(Session& session);

  private:
    /// Command for a robot from a controller's request.
    struct Due {
        NodeId robot;
        Controller* controller;
        const RobotCommand* command;
    };

    std::vector<Controller> all_;
    std::vector<Due> due_;  // commands being executed
};

}  // namespace rovernet
