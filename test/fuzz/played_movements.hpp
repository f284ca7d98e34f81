// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/files/movement_file.hpp"
#include "sim/error.hpp"
#include "test/fuzz/fuzz_file.hpp"

#include <cstdlib>

namespace rovernet::test {

/// Reads the bytes as a movement file. Aborts unless the reader throws an InputError or returns
/// valid commands in order of time.
inline void play_movements(const std::uint8_t* bytes, std::size_t size) {
    const FuzzFile file(bytes, size);
    for (const auto syntax : {MovementSyntax::strict, MovementSyntax::tolerant}) {
        try {
            MovementFile movements(file.path(), syntax);
            Time last = start_of_run;
            while (const auto command = movements.next()) {
                if (command->time < last || command->robot >= movements.robots().size()) abort();
                if (command->kind == MovementCommand::Kind::reach &&
                    command->arrival <= command->time) {
                    abort();
                }
                last = command->time;
            }
            if (movements.end() < last) abort();
        } catch (const InputError&) {
        }
    }
}

}  // namespace rovernet::test
