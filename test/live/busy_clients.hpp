// SPDX-License-Identifier: MIT
#pragma once

#include "test/live/emulate/datagrams.hpp"
#include "test/live/line_client.hpp"
#include "test/live/player/wire.hpp"
#include "test/live/web_client.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>
#include <thread>
#include <utility>

// Clients that send commands without pause until the end of the run: Player clients, ROS clients,
// and programs that send datagrams. Each function runs in a separate thread.

namespace rovernet::test {

/// Counts of a client's actions.
struct Busy {
    int said = 0;   ///< number of commands and packets sent
    int heard = 0;  ///< number of messages received
};

/// Velocity that differs from round to round.
inline double some_speed(int round) { return 0.1 * (round % 7) - 0.3; }

/// Reads the next message of a Player server. @return false if the connection has ended
inline bool read_message(LineClient& client, Wire& message) {
    std::string bytes = client.bytes(40);
    if (bytes.size() < 40) return false;
    const std::size_t size = number_at(bytes, 36, 4);
    bytes += client.bytes(size);
    if (bytes.size() < 40 + size) return false;
    message = take_messages(bytes).at(0);
    return true;
}

/// Player client that drives its robot, sends messages by the robot's radio, and receives data: in
/// PUSH mode, or on request.
inline Busy player_client(LineClient client, std::uint32_t how) {
    Busy busy;
    client.bytes(32);  // banner of the server
    client.send_bytes(mode(how) + device(4, 0) + device(23, 0) + device(51, 1));
    Wire message;
    for (int round = 0;; ++round) {
        std::string words = drive(some_speed(round), 0.5 - some_speed(round));
        if (round % 3 == 0) words += order(51, 1, counted("player " + std::to_string(round)));
        if (how == pull) words += ask();
        if (!client.send_bytes(words)) return busy;
        ++busy.said;
        do {  // read up to the end of the round, or the next data of position2d
            if (!read_message(client, message)) return busy;
            busy.heard += message.type == data;
        } while (how == pull ? message.type != sync_message : message.interface != 4);
    }
}

/// ROS client that drives a robot, sends it to a goal, places it elsewhere, and sends messages by
/// its radio.
inline Busy ros_client(WebClient client, const std::string& robot) {
    Busy busy;
    for (const char* topic : {"/odom", "/radio/received", "/radio/neighbors"}) {
        client.send(R"({"op":"subscribe","topic":"/)" + robot + topic + "\"}");
    }
    client.send(R"({"op":"subscribe","topic":"/tf","compression":"cbor","throttle_rate":100})");
    const auto publish = [&](const std::string& topic, const std::string& message) {
        ++busy.said;
        return client.send(R"({"op":"publish","topic":"/)" + robot + topic + R"(","msg":)" +
                           message + "}");
    };
    const auto number = [](double value) { return std::to_string(value); };
    for (int round = 0;; ++round) {
        const std::string x = number(20 + some_speed(round)), y = number(10 * some_speed(round));
        const std::string place = R"({"position":{"x":)" + x + R"(,"y":)" + y + "}}";
        switch (round % 4) {
            case 0:
                publish("/cmd_vel", R"({"linear":{"x":)" + number(some_speed(round)) + "}}");
                break;
            case 1: publish("/radio/send", R"({"data":"cm9z"})"); break;
            case 2: publish("/goal_pose", R"({"pose":)" + place + "}"); break;
            default:
                ++busy.said;
                client.send(R"({"op":"call_service","service":"/simulation/set_pose",)"
                            R"("args":{"name":")" +
                            robot + R"(","pose":)" + place + "}}");
        }
        client.send(R"({"op":"call_service","service":"rosapi/get_time"})");
        for (std::string told; told.find("rosapi/get_time") == told.npos; ++busy.heard) {
            told = client.message();
            if (told.empty()) return busy;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
}

/// Program that sends datagrams by a robot while `goes_on` is true, alternately to everyone and to
/// the robot `other`, and counts the datagrams that it receives.
inline Busy packet_program(int port, char other, const std::atomic<bool>& goes_on) {
    using namespace std::string_literals;
    const std::string to_all = "\xff\xff\xff\xff"s, to_one = std::string(1, other) + "\0\0\0"s;
    const Datagrams socket(port);
    Busy busy;
    for (int round = 0; goes_on; ++round) {
        const std::string head = "RN\x01\x00"s + (round % 2 == 0 ? to_all : to_one);
        busy.said += socket.offer(head + "packet " + std::to_string(round));
        busy.heard += !socket.next(std::chrono::milliseconds(5)).empty();
    }
    return busy;
}

}  // namespace rovernet::test
