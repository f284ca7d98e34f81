// SPDX-License-Identifier: MIT
#include "pictures/map/trail.hpp"

#include <algorithm>
#include <variant>

namespace rovernet {

void Trails::on(const Record& record, const RecordContext&) {
    const auto* moved = std::get_if<Moved>(&record);
    if (!moved) return;
    if (legs_.size() <= moved->node.index()) legs_.resize(moved->node.index() + 1);
    legs_[moved->node.index()].push_back(moved->leg);
}

const std::vector<Leg>& Trails::legs(NodeId node) const {
    static const std::vector<Leg> none;
    return node.index() < legs_.size() ? legs_[node.index()] : none;
}

std::vector<std::vector<Vec3>> Trails::ways(NodeId node, Time begin, Time at) const {
    constexpr double jump = 1e-6;  // [m] more than rounding
    std::vector<std::vector<Vec3>> out;
    const auto& own = legs(node);
    const auto after = std::upper_bound(own.begin(), own.end(), begin,
                                        [](Time t, const Leg& leg) { return t < leg.start; });
    const auto first = static_cast<std::size_t>(after - own.begin());  // behind the leg at `begin`
    for (std::size_t i = first > 0 ? first - 1 : 0; i < own.size() && own[i].start <= at; ++i) {
        const Vec3 from = own[i].start < begin ? own[i].position(begin) : own[i].from;
        if (out.empty() || distance(out.back().back(), from) > jump) out.push_back({from});
        const Time next = i + 1 < own.size() ? own[i + 1].start : never;
        for (const Vec3 p : {from, own[i].position(std::min(next, at))}) {
            if (!(out.back().back() == p)) out.back().push_back(p);
        }
    }
    return out;
}

std::vector<Vec3> Trails::marks(NodeId node, Time at, Duration every) const {
    std::vector<Vec3> out;
    const auto& own = legs(node);
    if (own.empty()) return out;
    std::size_t leg = 0;
    for (Time t = own.front().start; t <= at; t += every) {
        while (leg + 1 < own.size() && own[leg + 1].start <= t) ++leg;
        out.push_back(own[leg].position(t));
        if (at - t < every) break;
    }
    return out;
}

}  // namespace rovernet
