// SPDX-License-Identifier: MIT
#include "live/viewer/network_answers.hpp"

#include "experiment/reports/link_pairs.hpp"
#include "sim/error.hpp"

#include <fmt/format.h>

namespace rovernet {

Table answer_links(const Network& network, std::optional<NodeId> of) {
    constexpr std::size_t most = 5000;
    const auto pairs =
        link_pairs(network, network.now(), [&](NodeId node) { return !of || node == *of; });
    if (pairs.size() > most) {
        throw RunError(
            fmt::format("{} links make no picture; choose a robot to see its links", pairs.size()));
    }
    Array from, to, two_way, level, margin, back_level, back_margin;
    const auto append = [](Array& levels, Array& margins, const std::optional<LinkStrength>& link) {
        const bool has_level = link && link->has_level;
        levels.push_back(has_level ? Value(link->level.value) : Value());
        margins.push_back(has_level ? Value(link->margin.value) : Value());
    };
    for (const LinkPair& pair : pairs) {
        from.emplace_back(std::uint64_t{pair.from.value});
        to.emplace_back(std::uint64_t{pair.to.value});
        two_way.emplace_back(pair.back.has_value());
        append(level, margin, pair.there);
        append(back_level, back_margin, pair.back);
    }
    Table answer;
    answer.set("from", std::move(from));
    answer.set("to", std::move(to));
    answer.set("two_way", std::move(two_way));
    answer.set("level_dbm", std::move(level));
    answer.set("margin_db", std::move(margin));
    answer.set("back_level_dbm", std::move(back_level));
    answer.set("back_margin_db", std::move(back_margin));
    return answer;
}

}  // namespace rovernet
