// SPDX-License-Identifier: MIT
#include "experiment/warmup.hpp"

#include "experiment/build.hpp"
#include "study/statistics/mser5.hpp"
#include "traces/delivery_series.hpp"

#include <utility>

namespace rovernet {

Duration warmup_of(const Scenario& scenario, NetworkSettings settings,
                   const std::function<Router()>& router) {
    if (!scenario.study.warmup.mser5) return scenario.study.warmup.given;
    settings.metrics = false;
    Network network(std::move(settings));
    router ? populate(network, scenario, router()) : populate(network, scenario);
    const auto series = std::make_shared<DeliverySeries>();
    network.add_sink(series);
    network.run_for(scenario.scenario.duration);
    const std::size_t deleted = mser5(series->delivered()).observations;
    return deleted == 0 ? Duration{0} : series->sent()[deleted] - start_of_run;
}

}  // namespace rovernet
