// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/propagation.hpp"
#include "network/network.hpp"
#include "scenario/document/value.hpp"
#include "sim/ids.hpp"

#include <cstddef>
#include <optional>

namespace rovernet {

/// Current links of a network, as the answer to the page's question `links`
/// (docs/formats/view-format.md): all links, or only links from and to the robot `of`.
/// @throws RunError if there are more links or robots than a picture can show
Table answer_links(const Network& network, std::optional<NodeId> of);

/// Parameters of the page's question `coverage`.
struct CoverageQuestion {
    NodeId robot;
    std::size_t storey = 0;  ///< storey of the receivers
    int cells = 1000;        ///< approximate number of cells, see coverage()
    /// Second propagation model, with which the coverage is compared; empty: no comparison.
    std::optional<Propagation> other = {};
};

/// Current coverage of a robot's transmitter, as the answer to the page's question `coverage`
/// (docs/formats/view-format.md): levels, contours, and differences to the levels of a second
/// model.
/// @throws RunError if a model of the comparison is `disc`, which has no levels
Table answer_coverage(const Network& network, const CoverageQuestion& question);

}  // namespace rovernet
