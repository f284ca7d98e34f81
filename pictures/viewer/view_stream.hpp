// SPDX-License-Identifier: MIT
#pragma once

#include "network/network.hpp"
#include "pictures/viewer/frame_columns.hpp"
#include "pictures/viewer/motion_columns.hpp"
#include "pictures/viewer/view_series.hpp"
#include "scenario/document/value.hpp"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace rovernet {

struct Scenario;

/// View of a running network, as a sequence of view files (docs/formats/view-format.md). The first
/// file contains the map and the robots; each later file contains the events since the previous
/// file. The view files are made by the same sinks as the view file of a recorded trace.
///
/// Only the records since the last file take memory; for the bytes of each record see MotionColumns
/// and FrameColumns.
class ViewStream {
  public:
    /// Adds the sinks of this object to the network.
    /// @param scenario  scenario of the network; must outlive this object
    ViewStream(const Scenario& scenario, std::shared_ptr<Network> network);
    ~ViewStream();
    ViewStream(const ViewStream&) = delete;  // removes the sinks from the network
    ViewStream& operator=(const ViewStream&) = delete;

    /// First file: map, robots with their current legs and states, no frames.
    /// @param live  entry `live` of the head
    std::string start(Table live) const;

    /// Events since the last part, as two view files. A viewer needs `rest` to understand later
    /// parts; `frames` may be left out.
    struct Part {
        std::string rest, frames;  ///< `frames` is empty if no frame has ended
        std::size_t number_of_frames = 0;
    };
    /// @param live     entry `live` of the heads
    /// @param is_last  whether the run is over, so that frames on air are written, too
    Part part(const Table& live, bool is_last);

    /// Series for charts, from the time on at which this object was made, see ViewSeries::table().
    Array series() const { return series_->table(network_->now()); }
    /// Time at which this object was made.
    Time begin() const { return begin_; }

  private:
    const Scenario& scenario_;
    std::shared_ptr<Network> network_;
    std::vector<std::string> robots_;
    std::shared_ptr<MotionColumns> motion_;
    std::shared_ptr<FrameColumns> frames_ = std::make_shared<FrameColumns>();
    std::shared_ptr<ViewSeries> series_;
    Time begin_;
    std::vector<SinkId> sinks_;
};

}  // namespace rovernet
