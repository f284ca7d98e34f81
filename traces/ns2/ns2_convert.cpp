// SPDX-License-Identifier: MIT
#include "traces/ns2/ns2_convert.hpp"

#include "files/part_file.hpp"
#include "sim/geometry.hpp"
#include "traces/ns2/ns2_text.hpp"

#include <string_view>
#include <utility>
#include <vector>

namespace rovernet {
namespace {

/// Output file of lines.
class LinesOut {
  public:
    explicit LinesOut(const std::string& path) : file_(path) {}

    std::string& buffer() {
        constexpr std::size_t portion = 64 * 1024;
        if (buffer_.size() >= portion) flush();
        return buffer_;
    }
    void close() {
        flush();
        file_.close();
        file_.give_name();
    }

  private:
    void flush() {
        file_.write(buffer_);
        buffer_.clear();
    }
    PartFile file_;
    std::string buffer_;
};

/// Positions of robots by their M lines: straight to the goal, at constant speed.
class PlacesByMoves {
  public:
    void on(const Ns2Move& move) {
        if (moves_.size() <= move.node.index()) moves_.resize(move.node.index() + 1);
        moves_[move.node.index()] = move;
    }
    std::optional<Vec3> at(NodeId node, Time time) const {
        if (node.index() >= moves_.size() || !moves_[node.index()]) return std::nullopt;
        const Ns2Move& m = *moves_[node.index()];
        const double length = distance(m.from, m.to);
        const double way = m.speed * seconds(time - m.time);
        if (!(length > 0) || !(way > 0)) return m.from;
        return way >= length ? m.to : m.from + (way / length) * (m.to - m.from);
    }

  private:
    std::vector<std::optional<Ns2Move>> moves_;  ///< the last one, by robot
};

constexpr std::string_view no_place =
    "packets of robots without an earlier M line: the positions of these robots are unknown";

/// Converts and adds the event. @return reason if that is not possible
std::string_view convert_event(const Ns2Line& event, std::string_view text, TraceForm form,
                               PlacesByMoves& places, std::string& out) {
    if (form == TraceForm::csv) {
        write_csv_line(event, out);
        return "";
    }
    if (const auto* move = std::get_if<Ns2Move>(&event)) places.on(*move);
    const auto* packet = std::get_if<Ns2Packet>(&event);
    if (!packet) {
        out.append(text).push_back('\n');
        return "";
    }
    if (form == TraceForm::ns2_old) return write_old_line(*packet, out);
    const auto place = packet->position ? packet->position : places.at(packet->node, packet->time);
    return place ? write_new_line(*packet, *place, out) : no_place;
}

bool is_in(const TraceCut& cut, const Ns2Packet& p) {
    if (cut.from && p.time < *cut.from) return false;
    if (cut.robot && p.node != *cut.robot) return false;
    if (!cut.message) return true;
    return p.uid == *cut.message && p.ip && p.ip->from_port != routing_port;
}
bool is_in(const TraceCut& cut, const Ns2Move& m) { return !cut.robot || m.node == *cut.robot; }
bool is_in(const TraceCut& cut, const Ns2Energy& e) {
    return !cut.message && (!cut.robot || e.node == *cut.robot) &&
           (!cut.from || e.time >= *cut.from);
}
bool is_in(const TraceCut& cut, const Ns2Reachable& r) {
    return (!cut.message || r.uid == *cut.message) && (!cut.from || r.time >= *cut.from);
}

}  // namespace

Converted convert_ns2(Ns2Source in, const std::string& out, TraceForm form,
                      Ns2Strictness strictness) {
    Ns2File file(std::move(in), strictness);
    LinesOut lines(out);
    if (form == TraceForm::csv) lines.buffer().append(ns2_csv_head).push_back('\n');
    Converted converted;
    PlacesByMoves places;
    while (const Ns2Line* event = file.next()) {
        const std::string_view why =
            convert_event(*event, file.text(), form, places, lines.buffer());
        if (why.empty()) {
            ++converted.written;
        } else {
            ++converted.left_out[std::string(why)];
        }
    }
    file.expect_trace();
    lines.close();
    converted.counts = file.counts();
    return converted;
}

Converted cut_ns2(Ns2Source in, const std::string& out, const TraceCut& cut,
                  Ns2Strictness strictness) {
    Ns2File file(std::move(in), strictness);
    LinesOut lines(out);
    Converted converted;
    while (const Ns2Line* line = file.next()) {
        const bool is_wanted = std::visit(
            [&](const auto& event) {
                if constexpr (requires { event.time; }) {
                    return (!cut.to || event.time < *cut.to) && is_in(cut, event);
                }
                return false;
            },
            *line);
        if (!is_wanted) continue;
        lines.buffer().append(file.text()).push_back('\n');
        ++converted.written;
    }
    file.expect_trace();
    lines.close();
    converted.counts = file.counts();
    return converted;
}

}  // namespace rovernet
