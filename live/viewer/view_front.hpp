// SPDX-License-Identifier: MIT
#pragma once

#include "live/carriers/address.hpp"
#include "live/carriers/front.hpp"
#include "live/paced_run.hpp"
#include "live/viewer/answers.hpp"
#include "live/viewer/view_history.hpp"
#include "live/viewer/view_log.hpp"
#include "pictures/viewer/view_stream.hpp"

#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <string_view>

namespace rovernet {

struct JsonElement;
class JsonParser;

/// Permissions of the viewer's page in a live run, and the start of the run.
struct ViewControl {
    bool of_time = false;    ///< true: the page may pause, step, and change the speed of the run
    bool of_robots = false;  ///< true: the page may move robots and send messages from them
    /// True: the run begins when the first page connects, and the server stays after the end of the
    /// run, until the last page is closed.
    bool is_for_page = false;
    /// Speed at the start of the run, see PacedOptions.
    std::optional<double> speed = 1;
};

/// Front of a live run for the viewer's page: sends the run's events as parts of a view file,
/// answers questions about the current state, and lets pages control the run as far as ViewControl
/// permits (docs/formats/view-format.md, "A run in progress").
///
/// The front observes the run while pages are connected, and for some seconds after the last page
/// has left. Without pages it costs the run nothing.
class ViewFront : public Front {
  public:
    ViewFront(ViewControl control, Carrier carrier);
    ~ViewFront() override;

    void prepare(Session& session, const Scenario& scenario) override;
    void begin(Session& session, const Scenario& scenario) override;
    void opened(Connection client, ListenerId at) override;
    std::size_t received(Connection from, std::string_view question) override;
    void closed(Connection gone) override;
    Time next() const override;
    void tell() override;
    bool is_exact() const override { return false; }
    Time limit() const override;
    void held(std::chrono::nanoseconds waited) override;
    void ended(std::string_view fingerprint, const Table& metrics) override;
    bool stays() const override { return control_.is_for_page && is_over_; }

  private:
    using RealTime = std::chrono::steady_clock::time_point;

    void observe();
    ViewHistory& history();
    Table live() const;
    void add_part(bool is_last);
    void send_parts();
    Table answer(const JsonElement& question, Connection from);
    Table series() const;
    Table pace(const JsonElement& question);
    Table step(const JsonElement& question);
    Table command(const JsonElement& question);
    void check_control(bool is_allowed, std::string_view what) const;
    ClientId client_of(NodeId robot, bool drives);
    Time now() const { return network_->now(); }

    ViewControl control_;
    Carrier carrier_;
    Session* session_ = nullptr;  // null after the end of the run
    const Scenario* scenario_ = nullptr;
    std::shared_ptr<Network> network_;
    std::optional<ViewStream> stream_;    // none: the run is not observed now
    std::optional<ViewHistory> history_;  // none: the run is not observed now
    std::optional<ViewerAnswers> answers_;
    std::unique_ptr<JsonParser> parser_;
    ViewLog log_;
    std::map<Connection, ViewLog::Place> watching_;
    // Clients of the session that act for the pages: a client for each driven robot, and a client
    // for each robot that sends messages.
    std::map<NodeId, ClientId> drives_, sends_;
    std::uint64_t commands_ = 0;
    std::optional<double> speed_;
    Time limit_ = never, next_ = never;
    RealTime last_part_ = {}, last_seen_ = {};
    // the run was paused or its speed was changed, so that a part is due immediately
    bool is_changed_ = false;
    bool waits_ = false;  // the run waits for its first page
    bool is_over_ = false;
    std::string fingerprint_;
    Table metrics_;
};

/// Listeners of the viewer's page for a live run. @param at  address of this machine
FrontListeners view_listener(const Address& at, const ViewControl& control);

}  // namespace rovernet
