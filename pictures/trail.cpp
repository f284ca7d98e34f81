// SPDX-License-Identifier: MIT
#include "pictures/trail.hpp"

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

std::vector<Vec3> Trails::corners(NodeId node, Time at) const {
    std::vector<Vec3> out;
    const auto add = [&](Vec3 p) {
        if (out.empty() || !(out.back() == p)) out.push_back(p);
    };
    const auto& own = legs(node);
    for (std::size_t i = 0; i < own.size() && own[i].start <= at; ++i) {
        add(own[i].from);
        const Time next = i + 1 < own.size() ? own[i + 1].start : never;
        add(own[i].position(std::min(next, at)));
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
