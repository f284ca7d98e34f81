// SPDX-License-Identifier: MIT
#include "live/viewer/view_server.hpp"

#include "live/carriers/listeners.hpp"
#include "live/carriers/web_sockets.hpp"
#include "pictures/viewer/view_page.hpp"

#include <chrono>
#include <utility>

namespace rovernet {

using namespace std::chrono_literals;

struct ViewServer::State {
    Listeners listeners;
    WebSockets sockets{listeners};
    Address address;
};

ViewServer::ViewServer(const Address& address, std::string view_file,
                       std::function<std::string(std::string_view)> answer, std::string other)
    : state_(std::make_unique<State>()) {
    Listeners::Streams users;
    users.received = [state = state_.get(), answer = std::move(answer)](WebSockets::Connection from,
                                                                        std::string_view question) {
        state->sockets.send(from, answer(question));
        return std::size_t{1};
    };
    WebPages pages;
    pages["/"] = {"text/html; charset=utf-8", served_page(!other.empty()), true, served_policy()};
    pages["/run.rvw"] = {"application/octet-stream", std::move(view_file)};
    if (!other.empty()) pages["/other.rvw"] = {"application/octet-stream", std::move(other)};
    state_->address = state_->sockets.listen(address, std::move(users), std::move(pages));
}

ViewServer::~ViewServer() = default;

std::string ViewServer::url() const { return state_->sockets.page_address(state_->address); }

void ViewServer::serve(const std::function<bool()>& go_on) {
    while (go_on()) state_->listeners.wait(100ms);
    state_->sockets.close(500ms, 2s);
}

}  // namespace rovernet
