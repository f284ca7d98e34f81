// SPDX-License-Identifier: MIT
#pragma once

#include "live/carriers/input_rate.hpp"
#include "live/carriers/listeners.hpp"
#include "live/carriers/request.hpp"

#include <boost/asio.hpp>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <string>
#include <utility>

namespace rovernet {

/// Connection of one external program to a live run.
struct ClientConnection {
    using Clock = std::chrono::steady_clock;
    using Socket = boost::asio::generic::stream_protocol::socket;

    ClientConnection(Socket taken, Listeners::Connection number, const Listeners::Streams& users)
        : socket(std::move(taken)), id(number), streams(users) {}

    bool carries_lines() const { return streams.line_error != nullptr; }
    /// Whether the bytes received so far contain a complete line.
    bool has_line() {
        const std::size_t end = input.find('\n', searched);
        searched = std::min(end, input.size());
        return end != std::string::npos;
    }

    /// Whether the bytes received so far cannot be the start of a JSON object.
    bool cannot_be_json() const {
        const std::size_t first = input.find_first_not_of(" \t\r");
        return first != input.npos && input[first] != '{';
    }
    RequestError not_json_error() const {
        constexpr std::size_t shown = 16;  // size of the input shown in the message [bytes]
        std::string found = input.substr(0, std::min(input.find_first_of("\r\n"), shown));
        const auto is_odd = [](char c) { return c < ' ' || c > '~'; };
        std::replace_if(found.begin(), found.end(), is_odd, '?');
        return {"bad_json", "",
                "found \"" + found + "\"; expected a JSON object in the first line"};
    }

    Socket socket;
    Listeners::Connection id;
    const Listeners::Streams& streams;
    Clock::time_point since = Clock::now();
    InputRate rate = {};
    /// Time at which the connection is closed, even if queued data is not sent yet.
    Clock::time_point closes_at = Clock::time_point::max();
    std::string input, sending, queued;
    std::size_t messages = 0;  ///< number of queued messages to the client
    std::size_t searched = 0;  ///< number of bytes of `input` already searched for an end of line
    bool has_sent = false;     ///< whether the client has sent a complete line or message
    bool is_reading = false, is_writing = false;
    bool is_answered = true;  ///< whether the client's last line was answered
    bool has_ended = false;   ///< whether the client has closed its sending side
    bool is_closing = false;  ///< whether the connection is to be closed once all data is sent
};

}  // namespace rovernet
