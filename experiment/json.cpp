// SPDX-License-Identifier: MIT
#include "experiment/json.hpp"

#include <nlohmann/json.hpp>

#include <cmath>

namespace rovernet {
namespace {

using Json = nlohmann::ordered_json;

Json convert(const Value& value);

struct Convert {
    Json operator()(std::monostate) const { return nullptr; }
    Json operator()(bool v) const { return v; }
    Json operator()(std::int64_t v) const { return v; }
    Json operator()(double v) const { return std::isfinite(v) ? Json(v) : Json(nullptr); }
    Json operator()(const std::string& v) const { return v; }
    Json operator()(const Array& v) const {
        Json list = Json::array();
        for (const auto& item : v) list.push_back(convert(item));
        return list;
    }
    Json operator()(const Table& v) const {
        Json object = Json::object();
        for (const auto& entry : v.entries) object[entry.key] = convert(entry.value);
        return object;
    }
};

Json convert(const Value& value) { return std::visit(Convert{}, value.data); }

}  // namespace

std::string to_json(const Value& value) {
    return convert(value).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace rovernet
