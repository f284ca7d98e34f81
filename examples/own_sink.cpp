// SPDX-License-Identifier: MIT
// A sink of one's own: it gets the records of a run as they happen. This one writes what a robot
// heard, and how strongly, as a table for a plotting program.
#include "rovernet.hpp"

#include <fmt/format.h>

using namespace rovernet;
using namespace std::chrono_literals;

/// Prints a line of comma-separated values for every frame that one robot gets, or loses.
class LevelTable {
  public:
    explicit LevelTable(NodeId robot) : robot_(robot) {}

    /// What it wants to know: receptions with their levels, and its links as they come and go.
    KindMask kinds() const { return kind_of<Received>() | kind_levels | kind_links; }

    void begin(const RunInfo& run) {
        name_ = run.name;
        fmt::print("# seed {}, robot {}\ntime_s,event,from,level_dbm\n", run.seed, name_(robot_));
    }
    void on(const Record& record, const RecordContext&) {
        if (const auto* got = std::get_if<Received>(&record)) {
            for (std::size_t i = 0; i < got->receptions.size(); ++i) {
                const Reception& at = got->receptions[i];
                if (at.node != robot_) continue;
                const auto code = reason_of(at.fate).code;  // of a frame that is lost
                write(at.time, is_decoded(at.fate) ? "heard" : code, got->frame.sender,
                      fmt::format("{:.1f}", got->levels[i].value));
            }
        } else if (const auto* down = std::get_if<LinkDown>(&record)) {
            if (down->to == robot_) write(down->time, "link lost", down->from, "");
        }
    }
    void finish() { fmt::print("# {} lines\n", lines_); }

  private:
    void write(Time time, std::string_view event, NodeId from, const std::string& level) {
        ++lines_;
        fmt::print("{:.3f},{},{},{}\n", seconds(time), event, name_(from), level);
    }
    NodeId robot_;
    std::function<std::string_view(NodeId)> name_;
    int lines_ = 0;
};

int main() {
    Network net{{.propagation = LogDistance{.exponent = 3}, .reception = Collision{}}};
    const auto base = net.add({.name = "base", .at = {0, 0}});
    const auto rover = net.add({.name = "rover", .at = {5, 0}, .move = ToGoal{{90, 0}, {10}}});
    net.add({.name = "left", .at = {40, 10}});
    net.add({.name = "right", .at = {40, -10}});
    net.route(Flood{.jitter = 500us});
    net.add_sink(LevelTable{rover});
    net.every(2s, [&] { net.send(base, everyone, "where are you?"); });
    net.run_for(10s);
    net.finish();
}
