// SPDX-License-Identifier: MIT
#pragma once

#include "live/carriers/front.hpp"
#include "live/rosbridge/api.hpp"
#include "live/rosbridge/clock.hpp"
#include "live/rosbridge/messages.hpp"
#include "live/rosbridge/request.hpp"
#include "live/rosbridge/robots.hpp"
#include "live/rosbridge/stream.hpp"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// Server of the rosbridge protocol, version 2, for ROS clients such as roslib. docs/guide/ros.md
/// lists its topics and services. The server receives and sends whole messages.
///
/// An error is answered with the id of the client's request: an error of a service call in the
/// response, any other error in a status message. The connection stays open.
class RosbridgeFront : public Front {
  public:
    explicit RosbridgeFront(Carrier carrier);
    ~RosbridgeFront() override;

    void begin(Session& session, const Scenario& scenario) override;
    void opened(Connection client, ListenerId at) override;
    std::size_t received(Connection from, std::string_view message) override;
    void closed(Connection gone) override;
    Time next() const override { return next_; }
    void tell() override;
    Time limit() const override { return clock_.limit(); }

  private:
    struct Client;

    void handle(Client& client, std::string_view message);
    void carry_out(Client& client, const RosSubscribe& request);
    void carry_out(Client& client, const RosUnsubscribe& request);
    void carry_out(Client& client, const RosPublish& request);
    void carry_out(Client& client, const RosCall& call);
    void carry_out(Client& client, RosLevel level);
    void carry_out(Client&, RosNothing) {}

    void refuse(Client& client, const std::string& why);
    void tell_status(const Client& client, RosLevel level, std::string_view text);
    void respond(Connection client, const RosOperation& call,
                 const std::function<void(RosWriter&)>& put_values);
    void answer(const std::vector<RosClock::Step>& over);

    void publish(const Client& client, RosStream& stream, std::string_view message);
    const std::string& written(const std::string& name, RosEncoding encoding,
                               const RosTopic& topic);
    void tell(Client& client, const std::vector<HeardMessage>& heard);
    void send(const Client& client, RosEncoding encoding, std::string_view message);
    void go_on();
    Time now() const { return session_->network().now(); }

    Carrier carrier_;
    Session* session_ = nullptr;
    std::optional<RosRobots> robots_;
    std::optional<RosMessages> messages_;
    std::optional<RosApi> api_;
    RosRequestReader reader_;
    std::map<Connection, Client> clients_;
    RosClock clock_;
    std::string buffer_;  // message being written
    // Messages written in the current tell(), by encoding and by topic name as written by the
    // subscriber.
    std::map<std::pair<std::string, RosEncoding>, std::string> written_;
    Time next_ = never;
};

}  // namespace rovernet
