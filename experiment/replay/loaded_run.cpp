// SPDX-License-Identifier: MIT
#include "experiment/replay/loaded_run.hpp"

#include "experiment/build.hpp"

namespace rovernet {

LoadedRun::LoadedRun(const RecordedRun& run, const std::string& path)
    : replayed(run, path),
      names(run.robots),
      scenario(replayed.with({})),
      settings(network_settings(scenario)) {
    check_robots(run, scenario, path);
}

}  // namespace rovernet
