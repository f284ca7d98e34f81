// SPDX-License-Identifier: MIT
#include "pictures/viewer/view_stream.hpp"

#include "experiment/version.hpp"
#include "pictures/viewer/view_file.hpp"
#include "pictures/viewer/view_head.hpp"
#include "pictures/viewer/view_map.hpp"
#include "scenario/scenario.hpp"
#include "sim/legs.hpp"
#include "sim/message.hpp"

#include <utility>

namespace rovernet {

ViewStream::ViewStream(const Scenario& scenario, std::shared_ptr<Network> network)
    : scenario_(scenario),
      network_(std::move(network)),
      motion_(std::make_shared<MotionColumns>(false,
                                              [network = network_.get()](NodeId robot, Time) {
                                                  return network->robot(robot).presence ==
                                                         Presence::left;
                                              })),
      series_(std::make_shared<ViewSeries>(start_of_run + scenario.scenario.duration, false)),
      begin_(network_->now()) {
    for (std::uint32_t i = 0; i < network_->size(); ++i)
        robots_.push_back(network_->name(NodeId{i}));
    sinks_ = {network_->add_sink(motion_), network_->add_sink(frames_),
              network_->add_sink(series_)};
}

ViewStream::~ViewStream() {
    for (const SinkId sink : sinks_) network_->remove_sink(sink);
}

std::string ViewStream::start(Table live) const {
    MotionColumns now;
    const MessageTable no_messages;
    const RecordContext context{network_->legs(), no_messages};
    for (NodeId robot{0}; robot.index() < robots_.size(); ++robot.value) {
        const Leg leg = network_->legs().leg(robot);
        now.on(Moved{leg.start, robot, leg}, context);
        now.begin(robot, network_->robot(robot).presence);
    }
    ViewDraft draft{ViewFile(false)}, no_frames;
    ViewFile& file = draft.file;
    Table& head = draft.head;
    head = view_head(scenario_, robots_, version());
    head.set("metrics", Table{});
    head.set("follow", Array{});
    head.set("damage", Array{});
    head.set("thinned", Array{});
    head.set("series", Array{});
    head.set("live", std::move(live));
    head.set("map", view_map(scenario_, network_->settings(), now.bounds(), file));
    now.write(file, robots_.size());
    const Time end = start_of_run + scenario_.scenario.duration;
    head.set("blocks", Array{});
    FrameColumns().write_part(draft, no_frames, robots_.size(), end, never);
    return std::move(draft).bytes();
}

ViewStream::Part ViewStream::part(const Table& live, bool is_last) {
    ViewDraft rest{ViewFile(false)}, frames{ViewFile(false)};
    for (ViewDraft* each : {&rest, &frames}) {
        each->head.set("rvw", 1);
        each->head.set("live", live);
    }
    motion_->write(rest.file, robots_.size());
    motion_->forget();
    const Time end = start_of_run + scenario_.scenario.duration;
    const Time now = is_last ? never : network_->now();
    Part part;
    part.number_of_frames = frames_->write_part(rest, frames, robots_.size(), end, now);
    part.rest = std::move(rest).bytes();
    if (part.number_of_frames > 0) part.frames = std::move(frames).bytes();
    return part;
}

}  // namespace rovernet
