// SPDX-License-Identifier: MIT
#include "experiment/movement_play.hpp"

#include "mobility/straight.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

namespace rovernet {
namespace {

/// Robot that a movement file moves.
struct PlayedRobot {
    static constexpr std::uint32_t absent = 0xffffffff, taken = 0xfffffffe;
    NodeId node;
    /// Network::movements() after the file's last command. `absent`: the robot is away until the
    /// file lets it appear. `taken`: something else has moved the robot, and the file no longer
    /// does.
    std::uint32_t movements;
};

/// A movement file that is being played: one pending event, for the next command.
struct Player {
    Network& network;
    MovementFile file;
    std::vector<PlayedRobot> robots;
    std::optional<MovementCommand> next;

    void obey(const MovementCommand& command) {
        PlayedRobot& robot = robots[command.robot];
        if (robot.movements == PlayedRobot::taken) return;
        const bool is_there = robot.movements != PlayedRobot::absent;
        if (is_there && network.movements(robot.node) != robot.movements) {
            robot.movements = PlayedRobot::taken;
            return;
        }
        move(robot.node, command);
        const bool vanishes = command.kind == MovementCommand::Kind::vanish;
        robot.movements = vanishes ? PlayedRobot::absent : network.movements(robot.node);
    }

    void move(NodeId node, const MovementCommand& command) {
        using Kind = MovementCommand::Kind;
        switch (command.kind) {
            case Kind::appear: network.place(node, command.to); return network.switch_on(node);
            case Kind::vanish: return network.take_away(node, Presence::left);
            case Kind::reach:
                return network.move(node, Straight{.to = command.to, .arrival = command.arrival});
            case Kind::go:
                if (command.speed == 0) return network.stop(node);
                return network.move(node, Straight{.to = command.to, .speed = {command.speed}});
        }
    }

    /// Executes the commands due now, and schedules the next one.
    static void go_on(const std::shared_ptr<Player>& player) {
        auto& next = player->next;
        for (; next && next->time <= player->network.now(); next = player->file.next()) {
            player->obey(*next);
        }
        if (next) player->network.at(next->time, [player] { go_on(player); });
    }
};

}  // namespace

void play(Network& network, MovementFile file, std::vector<NodeId> nodes) {
    std::vector<PlayedRobot> robots;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const bool is_there = file.robots()[i].appears <= network.now();
        if (!is_there) network.take_away(nodes[i], Presence::not_departed);
        robots.push_back({nodes[i], is_there ? network.movements(nodes[i]) : PlayedRobot::absent});
    }
    const auto player =
        std::make_shared<Player>(Player{network, std::move(file), std::move(robots), std::nullopt});
    player->next = player->file.next();
    Player::go_on(player);
}

}  // namespace rovernet
