// SPDX-License-Identifier: MIT
#pragma once

#include "live/carriers/address.hpp"

#include <functional>
#include <memory>
#include <string>

namespace rovernet {

/// Server of the viewer's page for one recorded run: the page at /, its view file at /run.rvw, and
/// answers by WebSocket (ViewerAnswers). The page cannot change the run.
class ViewServer {
  public:
    /// @param address    address of this machine; port 0: any free port
    /// @param view_file  bytes of the view file
    /// @param answer     function that returns the answer to a question, both as JSON
    /// @param other      view file of a second run, served at /other.rvw; empty: none
    /// @throws RunError if the address is in use
    ViewServer(const Address& address, std::string view_file,
               std::function<std::string(std::string_view)> answer, std::string other = {});
    ~ViewServer();

    /// URL of the page, such as "http://127.0.0.1:7007/". If other machines can reach the server,
    /// the URL includes the required token.
    std::string url() const;
    /// Serves pages until `go_on` returns false. `go_on` is called at least every 0.1 s.
    void serve(const std::function<bool()>& go_on);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace rovernet
