// SPDX-License-Identifier: MIT
#include "scenario/tables/own_keys.hpp"

#include "models/propagation/list.hpp"
#include "scenario/tables/reader.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {
namespace {

std::string model_in(const Table& table) {
    const Value* model = table.find("model");
    return model && model->string() ? *model->string() : "";
}

Table with_keys(const Table& table, const std::vector<std::string_view>& keys) {
    Table out;
    for (const Entry& entry : table.entries) {
        const bool own = std::find(keys.begin(), keys.end(), entry.key) != keys.end();
        if (own || entry.key == "model") out.set(entry.key, entry.value);
    }
    return out;
}

}  // namespace

Table own_keys_of_propagation(const Table& propagation) {
    const std::string model = model_in(propagation);
    std::vector<std::string_view> keys;
    for_each_model([&]<class M>() {
        if (model == M::name) for_each_field<M>([&](const auto& f) { keys.push_back(f.name); });
    });
    return with_keys(propagation, keys);
}

Table own_keys_of_reception(const Table& reception) {
    const std::string model = model_in(reception);
    if (model == "collision") return with_keys(reception, {"capture_ratio", "capture"});
    if (model == "sinr") return with_keys(reception, {"interference_cut", "preamble_threshold"});
    return with_keys(reception, {});
}

}  // namespace rovernet
