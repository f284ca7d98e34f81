// SPDX-License-Identifier: MIT
#include "scenario/schema.hpp"

#include "scenario/document/toml.hpp"
#include "scenario/scenario.hpp"
#include "scenario/tables/value_schema.hpp"
#include "test/scenario/json_schema.hpp"

#include <doctest/doctest.h>

#include <set>
#include <string>
#include <vector>

namespace schema_test {
using namespace rovernet;
using rovernet::test::JsonSchema;

namespace {

const std::string robot_a = "[[robot]]\nname = \"A\"\nat = [\"2 m\", \"3 m\"]\n";

bool accepts(const std::string& text) {
    static const Table schema = scenario_schema();
    return JsonSchema::accepts(schema, parse_toml(text, "s.toml"));
}

/// Error of reading a scenario; empty if there is none.
std::string error_of(const std::string& text) {
    try {
        read_scenario(parse_toml(text, "s.toml"), "s.toml");
        return "";
    } catch (const InputError& error) {
        return error.message();
    }
}

/// Keys that the reader knows where the text has the key "zzz": the error lists them.
std::set<std::string> keys_read(const std::string& text) {
    const std::string error = error_of(text);
    CAPTURE(error);
    const std::string begin = "; expected one of ";
    REQUIRE(error.starts_with("unknown key \"zzz\""));
    std::string list = error.substr(error.find(begin) + begin.size());
    list = list.substr(0, list.find(';')) + ", ";
    std::set<std::string> keys;
    for (std::size_t at = 0; at < list.size();) {
        const std::size_t end = list.find(", ", at);
        keys.insert(list.substr(at, end - at));
        at = end + 2;
    }
    return keys;
}

/// Schema at a path of keys of the schema, such as {"properties", "robot", "items"}.
const Table& part(const Table& schema, const std::vector<std::string>& path) {
    const Table* at = &schema;
    for (const std::string& key : path) {
        const Value* next = at->find(key);
        REQUIRE(next);
        at = next->array() ? next->array()->front().table() : next->table();
    }
    return *at;
}

std::set<std::string> keys_of(const Table& schema) {
    std::set<std::string> keys;
    for (const Entry& entry : schema.find("properties")->table()->entries) keys.insert(entry.key);
    return keys;
}

}  // namespace

TEST_CASE(
    "schema: the JSON schema has for each table exactly the keys that the scenario reader "
    "accepts") {
    const Table schema = scenario_schema();
    struct Case {
        std::string text;
        std::vector<std::string> path;
    };
    std::vector<Case> cases = {{"zzz = 1\n" + robot_a, {}}};
    for (const char* table :
         {"scenario", "scene", "radio", "medium", "propagation", "shadowing", "fading", "reception",
          "access", "links", "movement", "routing", "trace", "metrics", "study"}) {
        cases.push_back({robot_a + "[" + table + "]\nzzz = 1", {"properties", table}});
    }
    const std::vector<std::string> robot = {"properties", "robot", "items", "properties"};
    const auto in_robot = [&](const std::string& key, const std::string& value) {
        std::vector<std::string> path = robot;
        path.push_back(key);
        const bool several = key == "scan" || key.starts_with("on_");
        if (several || key == "move") path.push_back("anyOf");
        cases.push_back({robot_a + key + " = { " + value + "zzz = 1 }", path});
    };
    in_robot("place", "");
    in_robot("scan", "");
    in_robot("radio", "");
    in_robot("propagation", "");
    in_robot("move", "model = \"fixed\", ");
    in_robot("on_receive", "");
    in_robot("on_arrival", "");
    in_robot("on_link_lost", "");
    in_robot("on_time", "time = \"1 s\", ");
    cases.push_back({robot_a + "zzz = 1", {"properties", "robot", "items"}});
    cases.push_back({robot_a + "[[traffic]]\nfrom = \"A\"\npayload = \"x\"\nzzz = 1",
                     {"properties", "traffic", "anyOf", "items", "anyOf"}});
    cases.push_back({robot_a + "[[scene.door]]\nzzz = 1",
                     {"properties", "scene", "properties", "door", "items"}});
    cases.push_back({robot_a + "[[scene.floor]]\nzzz = 1",
                     {"properties", "scene", "properties", "floor", "items"}});
    cases.push_back(
        {robot_a + "[[scene.floor]]\nceiling = { zzz = 1 }",
         {"properties", "scene", "properties", "floor", "items", "properties", "ceiling"}});
    cases.push_back({robot_a + "[scene.materials]\nw = { zzz = 1 }",
                     {"properties", "scene", "properties", "materials", "additionalProperties"}});
    for (const Case& each : cases) {
        CAPTURE(each.text);
        CHECK(keys_of(part(schema, each.path)) == keys_read(each.text));
        CHECK_FALSE(accepts(each.text));
    }
}

TEST_CASE(
    "schema: the JSON schema has for each movement model exactly the keys that the reader "
    "accepts") {
    const Table schema = scenario_schema();
    const auto& models = *part(schema, {"properties", "robot", "items", "properties", "move"})
                              .find("anyOf")
                              ->array();
    REQUIRE(models.size() == move_names().size());
    for (std::size_t i = 0; i < models.size(); ++i) {
        const std::string name = move_names()[i];
        CAPTURE(name);
        const bool led = models[i].table()->find("properties")->table()->find("leader");
        CHECK(keys_of(*models[i].table()) ==
              keys_read(robot_a + "move = { model = \"" + name + "\"" +
                        (led ? ", leader = \"B\"" : "") + ", zzz = 1 }"));
    }
}

TEST_CASE("schema: the JSON schema accepts a value exactly if the scenario reader accepts it") {
    const auto agree = [](const std::string& text) {
        CAPTURE(text);
        const bool is_right = error_of(text).empty();
        CHECK(accepts(text) == is_right);
        return is_right;
    };
    CHECK(agree(robot_a));
    for (const char* power :
         {"\"15 dBm\"", "\" -15dBm \"", "\"+1e-1 mW\"", "\".5 W\"", "\"3. uW\""})
        CHECK(agree("[radio]\npower = " + std::string(power) + "\n" + robot_a));
    for (const char* power :
         {"15", "15.0", "\"15\"", "\"15 dBW\"", "\"dBm\"", "\"1,5 dBm\"", "true", "[\"15 dBm\"]",
          "\"15 dBm x\"", "\"nan dBm\"", "\"-5 mW\"", "\"0 W\"", "\"0.0e3 uW\"", "\"-.5 W\""})
        CHECK_FALSE(agree("[radio]\npower = " + std::string(power) + "\n" + robot_a));
    for (const char* key :
         {"count = 0", "count = 1.5", "radius = \"-1 m\"", "at = [\"1 m\"]", "heading = 3",
          "role = \"boss\"", "off = \"1 s\"", "move = { model = \"goa\" }",
          "move = { model = \"fixed\", speed = \"1 m/s\" }", "move = { model = \"follow\" }",
          "on_time = { stop = true }", "on_arrival = { hops = 1, stop = true }",
          "scan = { beams = 0 }"})
        CHECK_FALSE(agree("[[robot]]\nname = \"A\"\n" + std::string(key)));
    for (const char* key : {"count = 2", "radius = \"0 m\"", "heading = \"-90 deg\"",
                            "role = \"router\"", "off = [\"1 s\", \"2 min\"]", "scan = [{}, {}]",
                            "on_time = [{ time = \"1 s\", stop = true }]"})
        CHECK(agree(robot_a + key));
    for (const char* rest :
         {"start = \"arrival\"", "start = \"1 s\"", "every = \"1 ms\"", "hops = 1",
          "size = \"1 kB\"", "size = \"1.5 kB\"", "size = \"2.0 B\"", "size = \" +64B\""})
        CHECK(agree(robot_a + "[[traffic]]\nfrom = \"A\"\npayload = \"x\"\n" + rest));
    for (const char* rest : {"start = \"late\"", "start = 1", "start = \"-1 s\"",
                             "every = \"-1 s\"", "hops = 2", "size = 5", "size = \"1.5 B\"",
                             "size = \"-1 B\"", "size = \"B\"", "kind = \"all\"", "count = 0"})
        CHECK_FALSE(agree(robot_a + "[[traffic]]\nfrom = \"A\"\npayload = \"x\"\n" + rest));
    CHECK_FALSE(agree(robot_a + "[[traffic]]\npayload = \"x\""));
    for (const char* pattern : {"[[0, 0], [180, -20]]", "[[\"0 deg\", \"0 dB\"], [\"3 rad\", -1]]"})
        CHECK(agree("[radio]\nantenna_pattern = " + std::string(pattern) + "\n" + robot_a));
    for (const char* eifs : {"true", "\"none\""})
        CHECK(agree("[access]\nmodel = \"csma\"\neifs = " + std::string(eifs) + "\n" + robot_a));
    CHECK_FALSE(agree("[access]\nmodel = \"csma\"\neifs = 1\n" + robot_a));
    CHECK_FALSE(agree("[fading]\nm = 2\n" + robot_a));
    for (const char* vary : {"radio.power = [\"1 dBm\"]", "\"radio.power\" = [\"1 dBm\"]",
                             "robot.A.radius = { from = \"1 m\", to = \"2 m\", step = \"1 m\" }"})
        CHECK(agree(robot_a + "[study]\nvary." + vary));
    for (const char* vary :
         {"a = 1", "a = []", "a = { from = 1, to = 2, stop = 1 }", "a.b = { from = 1 }"})
        CHECK_FALSE(agree(robot_a + "[study]\nvary." + vary));
}

TEST_CASE("schema: a key of several models accepts every value that one of these models accepts") {
    Table keys;
    add_key(keys, "size", schema_of_type("integer"), "first", "a");
    add_key(keys, "size", schema_of_type("integer"), "second", "b");
    CHECK(keys.find("size")->table()->find("type"));
    CHECK(*keys.find("size")->table()->find("description")->string() == "a: first; b: second");
    add_key(keys, "size", schema_of_type("string"), "third", "c");
    add_key(keys, "size", schema_of_type("integer"), "fourth", "d");
    CHECK(keys.find("size")->table()->find("anyOf")->array()->size() == 2);
}

}  // namespace schema_test
