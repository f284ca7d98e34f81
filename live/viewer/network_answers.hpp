// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/propagation.hpp"
#include "network/network.hpp"
#include "scenario/document/value.hpp"
#include "sim/ids.hpp"

#include <cstddef>
#include <optional>

namespace rovernet {

/// Links of a network now, as the answer to the page's question `links`
/// (docs/formats/view-format.md): all links, or those from and to the robot `of`.
/// @throws RunError for more links, or more robots, than a picture can show
Table answer_links(const Network& network, std::optional<NodeId> of);

/// Question for the coverage of a robot's transmitter.
struct CoverageQuestion {
    NodeId robot;
    std::size_t storey = 0;  ///< storey of the receivers
    int cells = 1000;        ///< approximate number of cells, see coverage()
    /// Other model of propagation, with which the coverage is compared.
    std::optional<Propagation> other = {};
};

/// Coverage of a robot's transmitter now, as the answer to the page's question `coverage`
/// (docs/formats/view-format.md): levels and contours, and differences to those of another model.
/// @throws RunError if levels of the model disc, which gives none, are compared
Table answer_coverage(const Network& network, const CoverageQuestion& question);

}  // namespace rovernet
