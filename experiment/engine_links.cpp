// SPDX-License-Identifier: MIT
#include "experiment/engine.hpp"

namespace rovernet {

/// Looks at all links once; from then on the watch is told of every leg and switch.
void Engine::start_watch() {
    watch_.emplace(LinkWatch::Settings{
        .medium = &medium_, .legs = &legs_, .scene = scene_, .search = settings_.links});
    watch_->start(now_);
    expect_link_change();
}

/// Queues an event for the next link change, unless there is one that comes no later.
void Engine::expect_link_change() {
    const Time next = std::max(watch_->next().value_or(never), now_);
    if (next >= link_event_) return;
    link_event_ = next;
    queue_.schedule(next, Priority::timer, {Occurrence::Kind::link_change, NodeId{0}, 0});
}

void Engine::change_links() {
    if (link_event_ != now_) return;  // an earlier one took its place
    link_event_ = never;
    watch_->advance(now_, [this](const LinkChange& change) {
        if (change.up) return emit(LinkUp{change.time, change.from, change.to});
        emit(LinkDown{change.time, change.from, change.to});
        const auto reactions = on_link_lost_.find(change.to);
        if (reactions == on_link_lost_.end()) return;
        for (const auto& react : reactions->second) {
            auto call = std::make_shared<std::function<void()>>(
                [react, from = change.from] { (*react)(from); });
            schedule(now_ + least_reaction, {std::move(call)});
        }
    });
    expect_link_change();
}

}  // namespace rovernet
