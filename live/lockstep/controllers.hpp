// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/session.hpp"
#include "live/lockstep/answer.hpp"
#include "live/carriers/request.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rovernet {

/// Controller of robots in a lock-step run: one that is there, or one that time waits for.
struct Controller {
    /// Number of whoever carries a controller's lines, never used twice.
    using Connection = std::uint32_t;
    enum class State {
        owes,         ///< a question: time stands still
        waits,        ///< for the answer to its step
        wants_reset,  ///< of the run
        leaves,       ///< has said bye
    };

    /// @param hello  its robots belong to nobody else
    Controller(Connection from, HelloRequest hello);

    /// Begins a run: takes its robots in the session, and owes the first question.
    void join(Session& session);

    std::optional<Connection> connection;  ///< none: it was lost
    HelloRequest hello;
    std::vector<NodeId> own;  ///< robots of the hello, in ascending order
    ClientId client = 0;      ///< in the session
    State state = State::owes;
    Time step_end = start_of_run;          ///< of the step that it waits for
    std::optional<StepRequest> step = {};  ///< not carried out yet
    std::uint64_t number = 0;              ///< of its last step
    bool has_stepped = false;
    std::optional<std::uint64_t> reset_seed = {};
    std::vector<SentMessage> sent = {};  ///< in its last step
    std::string last_state = {};         ///< for when it comes back
};

/// Controllers of a lock-step run, in the order of their hellos. References to one are good until
/// another one comes or leaves.
class Controllers {
  public:
    using Connection = Controller::Connection;

    auto begin() { return all_.begin(); }
    auto end() { return all_.end(); }
    auto begin() const { return all_.begin(); }
    auto end() const { return all_.end(); }
    std::size_t size() const { return all_.size(); }
    bool empty() const { return all_.empty(); }

    /// Controller of a connection; null if it has not said hello.
    Controller* of(Connection connection);
    /// Controller of that name, whether or not it is lost; null if there is none.
    Controller* named(std::string_view name);

    void add(Controller controller) { all_.push_back(std::move(controller)); }
    void remove(Connection connection);
    /// Takes out those who said bye. @return them, in the order of their first robots
    std::vector<Controller> take_leaving();

    /// Names of those who owe a question.
    std::vector<std::string> owing() const;
    /// Whether nobody owes a question, and somebody is there.
    bool have_all_asked() const;
    /// Nearest end of a step that one waits for; `never` if none does.
    Time next_end() const;

  private:
    std::vector<Controller> all_;
};

}  // namespace rovernet
