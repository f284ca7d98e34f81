// SPDX-License-Identifier: MIT
#include "experiment/movement_play.hpp"

#include "mobility/straight.hpp"

#include <memory>
#include <optional>
#include <utility>

namespace rovernet {
namespace {

/// A movement file that is being played: one pending event, for the next command.
struct Player {
    Network& network;
    MovementFile file;
    std::vector<NodeId> nodes;
    std::optional<MovementCommand> next;

    void obey(const MovementCommand& command) {
        const NodeId node = nodes[command.robot];
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
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (file.robots()[i].appears > network.now()) {
            network.take_away(nodes[i], Presence::not_departed);
        }
    }
    const auto player =
        std::make_shared<Player>(Player{network, std::move(file), std::move(nodes), std::nullopt});
    player->next = player->file.next();
    Player::go_on(player);
}

}  // namespace rovernet
