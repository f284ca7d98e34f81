// SPDX-License-Identifier: MIT
#include "scenario/tables/model_choice.hpp"

#include "scenario/document/toml.hpp"
#include "scenario/scenario.hpp"
#include "scenario/tables/access_table.hpp"
#include "scenario/tables/read_model.hpp"
#include "sim/error.hpp"

#include <doctest/doctest.h>

#include <string>
#include <tuple>
#include <variant>

namespace model_choice_test {
using namespace rovernet;

namespace {

/// Two models with a key in common, whose ranges differ.
struct Near {
    static constexpr std::string_view name = "near";
    int hops = 2;
    static constexpr auto fields() {
        return describe(field("hops", &Near::hops, Range{.low = 1, .high = 7, .text = "to 7"}, ""));
    }
};
struct Far {
    static constexpr std::string_view name = "far";
    int hops = 30;
    double share = 0.5;
    static constexpr auto fields() {
        return describe(
            field("hops", &Far::hops, Range{.low = 1, .high = 99, .text = "to 99"}, ""),
            field("share", &Far::share, Range{.low = 0, .high = 1, .text = "to 1"}, ""));
    }
};
/// A model without keys.
struct Bare {
    static constexpr std::string_view name = "bare";
    static constexpr auto fields() { return describe(); }
};
using Choice = ModelChoice<std::tuple<Near, Far, Bare>, std::variant<Near, Far, Bare>>;

Choice read(const std::string& toml) {
    Choice out;
    read_model(parse_toml(toml, "m.toml"), "[m]", "model", "model", out);
    return out;
}

std::string error_of(const std::string& toml) {
    try {
        read(toml);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

Scenario scenario_of(const std::string& keys) {
    return read_scenario(
        parse_toml("robot = [{ name = \"A\", at = [\"0 m\", \"0 m\"] }]\n" + keys, "s.toml"),
        "s.toml");
}

}  // namespace

TEST_CASE(
    "models: if several models share a key, its value must be in the range of the selected model") {
    const Choice far = read("model = \"far\"\nhops = 30");
    CHECK(std::get<Far>(far.make()).hops == 30);
    CHECK(std::get<Near>(far.parameters).hops == 2);  // 30 is out of its range
    const Choice both = read("model = \"far\"\nhops = 5");
    CHECK(std::get<Near>(both.parameters).hops == 5);
    CHECK(error_of("model = \"near\"\nhops = 30").find("m.toml:2:8: hops") == 0);
}

TEST_CASE("models: a key of a model that is not chosen is checked and kept") {
    const Choice near = read("share = 0.25");
    CHECK(near.name() == "near");
    CHECK(std::get<Far>(near.parameters).share == 0.25);
    CHECK(near.as<Far>() == nullptr);
    CHECK(error_of("share = 2.0").find("expected a value to 1") != std::string::npos);
    CHECK(error_of("shar = 0.2").find("did you mean \"share\"?") != std::string::npos);
}

TEST_CASE("models: a key that the chosen model lacks must have a value that another model allows") {
    const Choice bare = read("model = \"bare\"\nhops = 30");
    CHECK(std::get<Far>(bare.parameters).hops == 30);
    CHECK(std::get<Near>(bare.parameters).hops == 2);
    CHECK(error_of("model = \"bare\"\nhops = 100").find("m.toml:2:8: hops") == 0);
}

TEST_CASE("models: a printed table is read back with the same model and parameters") {
    const Choice far = read("model = \"far\"\nhops = 30\nshare = 0.25");
    for (const Table& printed : {chosen_document(far), whole_document(far)}) {
        Choice again;
        read_model(Value(printed), "[m]", "model", "model", again);
        CHECK(again.as<Far>()->hops == 30);
        CHECK(again.as<Far>()->share == 0.25);
        CHECK(std::get<Near>(again.parameters).hops == 2);
    }
    const Table near = chosen_document(read("model = \"near\""));
    CHECK(near.entries.size() == 2);
    CHECK(whole_document(read("model = \"near\"")).entries.size() == 3);
}

TEST_CASE(
    "access: the chosen 802.11 standard sets the defaults of the radio, and [radio] overrides "
    "them") {
    const std::string ofdm = "[access]\nmodel = \"csma\"\nstandard = \"802.11a\"\n";
    CHECK(scenario_of("").radio.rate == BitRate{11e6});
    const Scenario given = scenario_of(ofdm + "[radio]\npreamble = \"24 us\"\n");
    CHECK(given.radio.rate == BitRate{54e6});
    CHECK(given.radio.preamble == std::chrono::microseconds{24});
    CHECK(scenario_of("[access]\nstandard = \"802.11a\"\n").radio == Radio{});  // not chosen
    const Table printed = to_document(given);
    CHECK(*printed.find("radio")->table()->find("rate")->string() == "54 Mb/s");
}

}  // namespace model_choice_test
