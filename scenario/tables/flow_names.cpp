// SPDX-License-Identifier: MIT
#include "scenario/tables/flow_names.hpp"

#include "sim/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>

namespace rovernet {

bool is_flow_name(std::string_view name) {
    return !name.empty() && std::none_of(name.begin(), name.end(), [](char c) {
        return c == ',' || static_cast<unsigned char>(c) <= ' ' || c == 0x7f;
    });
}

void name_flows(std::vector<TrafficTable>& all) {
    std::map<std::string, int, std::less<>> named;
    for (const TrafficTable& traffic : all) {
        if (traffic.name.empty() || ++named[traffic.name] == 1) continue;
        throw InputError(
            traffic.from_where,
            fmt::format("name: two flows are named \"{}\"; give each flow a different name",
                        traffic.name));
    }
    for (TrafficTable& traffic : all) {
        if (!traffic.name.empty()) continue;
        std::string usual = fmt::format("{}->{}", traffic.from, traffic.to.value_or("all"));
        for (char& c : usual) c = is_flow_name({&c, 1}) ? c : '_';
        do {
            const int count = ++named[usual];
            traffic.name = count == 1 ? usual : fmt::format("{}#{}", usual, count);
        } while (traffic.name != usual && ++named[traffic.name] > 1);
    }
}

}  // namespace rovernet
