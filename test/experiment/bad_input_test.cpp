// SPDX-License-Identifier: MIT
#include "experiment/build.hpp"
#include "scenario/document/toml.hpp"
#include "scenario/scenario.hpp"
#include "scenario/scenario_file.hpp"
#include "scenario/schema.hpp"
#include "test/scenario/json_schema.hpp"
#include "test/scene/png_writer.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <random>
#include <string>
#include <sys/wait.h>
#include <vector>

namespace bad_input_test {
using namespace rovernet;
using rovernet::test::TemporaryFolder;

namespace {

const std::string robot_a = "[[robot]]\nname = \"A\"\nat = [\"2 m\", \"2 m\"]\n";  // 3 lines
const std::string on_map = "[scene]\nmap = \"walls.png\"\nsize = [\"8 m\", \"8 m\"]\n" + robot_a;
const std::string in_file = "[movement]\nfile = \"two.tcl\"\n[[robot]]\n";  // it moves n0 and n1
const std::string yaml = "[scene]\nmap = \"m.yaml\"\n" + robot_a;

struct Mistake {
    std::string text;
    std::string place;               // "line:column", or nothing: the file alone
    std::vector<std::string> words;  // of the message
};

/// 8 x 8 pixels: one wall across, at 4 m <= x < 5 m.
std::string walls_png() {
    const png_byte w = 255;
    return test::png_bytes(
        {.width = 8, .height = 8, .rows = {8, std::vector<png_byte>{w, w, w, w, 0, w, w, w}}});
}

/// A PNG that says it is huge; only its header is looked at.
std::string huge_png() {
    std::string png = test::png_bytes({.rows = {{0}}});
    constexpr std::size_t type = 12, width = 16, checksum = 29;
    png.replace(width, 8, std::string("\0\0\x75\x30\0\0\x75\x30", 8));  // 30,000 x 30,000
    std::uint32_t crc = 0xffffffff;                                     // PNG, annex D
    for (std::size_t i = type; i < checksum; ++i) {
        crc ^= static_cast<unsigned char>(png[i]);
        for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0xedb88320U : 0U);
    }
    crc ^= 0xffffffff;
    for (std::size_t i = 0; i < 4; ++i) png[checksum + i] = static_cast<char>(crc >> (24 - 8 * i));
    return png;
}

void write_maps(const TemporaryFolder& folder) {
    folder.write("walls.png", walls_png());
    folder.write("cut.png", walls_png().substr(0, 60));
    folder.write("huge.png", huge_png());
    folder.write("text.png", "this is no picture");
    folder.write("empty.xml", "<fcd-export></fcd-export>\n");
    folder.write("two.tcl", "$node_(0) set X_ 1\n$node_(1) set X_ 2\n");
    std::filesystem::create_directory(folder.path("folder.png"));
    const std::string rest = "resolution: 1\norigin: [0, 0, 0]\n";
    const std::string thresholds = "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.2\n";
    folder.write("no_image.yaml", rest + thresholds);
    folder.write("no_file.yaml", "image: none.png\n" + rest + thresholds);
    folder.write("zero.yaml", "image: walls.png\nresolution: 0\norigin: [0, 0, 0]\n" + thresholds);
    folder.write("syntax.yaml", "image: [walls.png\n");
    folder.write("list.yaml", "- 1\n- 2\n");
    folder.write("empty.yaml", "");
}

std::string with_map(const std::string& name) {
    std::string text = yaml;
    return text.replace(text.find("m.yaml"), 6, name);
}

std::string study(const std::string& keys) { return robot_a + "[study]\n" + keys; }

std::string traffic(const std::string& rest) {
    return robot_a + "[[traffic]]\nfrom = \"A\"\n" + rest;
}

const std::vector<Mistake> mistakes = {
    // Not TOML.
    {"x", "1:2", {"not TOML"}},
    {"[radio]\npower = \"5 dBm", "2:15", {"not TOML"}},
    {"[radio]\n[radio]\n" + robot_a,
     "2:1",
     {"[radio] occurs a second time", "all keys of this table"}},
    {"[robot]\nname = \"A\"\n[robot]\nname = \"B\"\n", "3:1", {"write [[robot]]"}},
    {robot_a + "radius = \"\xff\"", "4:10", {"utf-8"}},
    {robot_a + "[scenario]\nseed = 99999999999999999999", "5:28", {"64 bits"}},
    {"", "", {"robot", "missing"}},
    // Motion, reactions, materials, files of others.
    {robot_a + "move = { model = \"patrl\", path = [] }", "4:18", {"did you mean \"patrol\"?"}},
    {robot_a + "move = { model = \"patrol\" }", "4:8", {"path", "missing"}},
    {robot_a + "move = { model = \"follow\" }", "4:8", {"leader", "missing"}},
    {robot_a + "move = { model = \"follow\", leader = \"B\" }", "4:37", {"no robot \"B\""}},
    {robot_a + "move = { model = \"group\", leader = \"A\" }", "4:36", {"cannot follow itself"}},
    {robot_a + "move = { model = \"random_walk\" }", "4:8", {"area"}},
    {robot_a + "move = { model = \"random_walk\", start = \"uniform\" }",
     "4:41",
     {"with a given place", "\"here\""}},
    {"[[robot]]\nname = \"A\"\nmove = { model = \"random_walk\", start = \"here\" }",
     "3:41",
     {"without a place"}},
    {"[[robot]]\nname = \"A\"\nmove = { model = \"random_waypoint\", min_speed = \"0 m/s\", area "
     "= [[\"0 m\", \"0 m\"], [\"9 m\", \"9 m\"]] }",
     "3:8",
     {"min_speed"}},
    {robot_a + "heading = \"90\"", "4:11", {"an angle", "deg"}},
    {robot_a + "scan = { beams = 0 }", "4:18", {"beams", "from 1 to 10,000"}},
    {robot_a + "scan = { kind = \"lidar\" }", "4:17", {"lidar", "ranger"}},
    {robot_a + "scan = { every = \"1 us\" }", "4:18", {"every", ">= 1 ms"}},
    {robot_a + "scan = { from = \"9 deg\", to = \"1 deg\" }", "4:31", {"0 to 360 degrees"}},
    {robot_a + "scan = { from = \"-300 deg\" }", "4:8", {"360 degrees"}},
    {robot_a + "scan = \"laser\"", "4:8", {"table"}},
    {robot_a + "turn_rate = \"0 deg/s\"", "4:13", {">= 1e-8 rad/s"}},
    {robot_a + "top_speed = \"-1 m/s\"", "4:13", {"> 0"}},
    {robot_a + "on_time = { send = \"x\" }", "4:11", {"time", "missing"}},
    {robot_a + "on_arrival = {}", "4:14", {"move", "missing"}},
    {robot_a + "on_arrival = { stop = true, move = { model = \"fixed\" } }", "4:23", {"only one"}},
    {robot_a + "on_link_lost = { from = \"Z\", stop = true }", "4:25", {"no robot \"Z\""}},
    {robot_a + "on_receive = { hops = 0, stop = true }", "4:23", {"from 1 to 65535"}},
    {robot_a + "[[robot]]\nname = \"B\"\nat = [\"1 m\", \"1 m\"]\nradio = { ip = \"1.2.3.4\" }\n"
               "[[robot]]\nname = \"C\"\nat = [\"2 m\", \"1 m\"]\nradio = { ip = \"1.2.3.4\" }",
     "11:9",
     {"\"B\"", "\"C\"", "the same ip, 1.2.3.4"}},
    {"[radio]\nmac = \"02:00:00:00:00:07\"\n[[robot]]\nname = \"r\"\ncount = 2\nat = [\"0 m\", \"0 "
     "m\"]",
     "3:1",
     {"all robots \"r\"", "mac"}},
    {"[radio]\ngate = \"open\"\n" + robot_a, "2:8", {"\"network\", \"none\""}},
    {"[radio]\nsuccess_rate = 1.5\n" + robot_a, "2:16", {"from 0 to 1"}},
    {"[radio]\nantenna = \"cosin\"\n" + robot_a, "2:11", {"did you mean \"cosine\"?"}},
    {"[radio]\nantenna = \"table\"\n" + robot_a,
     "2:11",
     {"antenna_pattern", "[[0, 0], [180, -20]]"}},
    {"[radio]\nantenna_pattern = [[0, 1]]\n" + robot_a, "2:19", {"found 1 dB", "at most 0 dB"}},
    {"[radio]\nantenna_pattern = [[0, 0], [0, -1]]\n" + robot_a, "2:19", {"ascend"}},
    {"[radio]\nantenna_pattern = [[0, 0], [360, -1]]\n" + robot_a, "2:19", {"within one turn"}},
    {"[radio]\nantenna_pattern = [0, 1]\n" + robot_a, "2:20", {"[degrees, dB]"}},
    {"[radio]\nantenna_beamwidth = \"360 deg\"\n" + robot_a, "2:21", {"< 360 deg"}},
    {robot_a + "[shadowing]\nsigma = \"6 dB\"", "4:1", {"\"model\" is missing", "\"field\""}},
    {robot_a + "[shadowing]\nmodel = \"feild\"", "5:9", {"did you mean \"field\"?"}},
    {robot_a + "[shadowing]\nmodel = \"link\"\n[propagation]\nmodel = \"log_distance\"",
     "4:1",
     {"log_distance", "sigma = \"0 dB\""}},
    {robot_a + "[fading]\nm = 2", "4:1", {"\"model\" is missing", "\"rayleigh\""}},
    {robot_a + "[fading]\nmodel = \"nakagami\"\nm = 0.4", "6:5", {"from 0.5 to 100"}},
    {robot_a + "[fading]\nmodel = \"rician\"\nk_factor = \"40 dB\"", "6:12", {"30 dB"}},
    {"[links]\ntolerance = \"0 s\"\n" + robot_a, "2:13", {"1 ns"}},
    {"[movement]\nfile = \"empty.xml\"\n", "2:8", {"found no robot in this movement file"}},
    {"[movement]\nfile = \"none.tcl\"\n" + robot_a, "2:8", {"none.tcl"}},
    {"[scene]\nworld = \"none.world\"\n" + robot_a, "2:9", {"none.world"}},
    {"[scene]\nworld_path = [\".\"]\n" + robot_a, "1:1", {"world", "key \"world_path\" needs"}},
    {"[scene]\nmap = \"walls.png\"\nworld = \"w.world\"\n" + robot_a, "3:9", {"only one"}},
    {"[scene.materials]\nx = { grey = 3, itu = \"brik\", thickness = \"1 cm\" }\n" + robot_a,
     "2:23",
     {"did you mean \"brick\"?"}},
    {"[scene.materials]\nx = { grey = 3, itu = \"brick\" }\n" + robot_a, "2:5", {"thickness"}},
    {"[scene.materials]\nx = { greys = [9, 3] }\n" + robot_a, "2:15", {"the lower level first"}},
    {"[scene.materials]\nx = { per_crossing = \"3 dB\" }\n" + robot_a, "2:5", {"grey"}},
    {robot_a + "name = \"B\"", "4:1", {"the key \"name\" occurs a second time"}},
    {"scenario:\n  duration: 5\n", "1:9", {"KEY = VALUE"}},
    {robot_a + "[medium]\npropagation_delay = True", "5:21", {"small letters"}},
    {robot_a + "radio = {\n power = \"5 dBm\"\n}",
     "4:10",
     {"must end on the line on which it "
      "begins"}},
    {std::string("\xff\xfe[\0", 4), "1:1", {"save the file as UTF-8"}},
    {robot_a + "[routing]\nttl = 3.0", "5:7", {"found the number 3.0", "a whole number"}},
    {robot_a + "[scenario]\nduration = \"5 minutes\"", "5:12", {"did you mean \"min\"?"}},
    {robot_a + "[radio]\nfrequency = \"2.4\"", "5:13", {"did you mean \"2.4 GHz\"?"}},
    // Keys and tables nobody knows.
    {robot_a + "radus = \"1 m\"", "4:1", {"unknown key \"radus\"", "did you mean \"radius\"?"}},
    {robot_a + "[radio]\nmodel = \"disc\"", "5:1", {"\"model\" is a key of [propagation]"}},
    {robot_a + "[scenario]\nmap = \"m.png\"", "5:1", {"\"map\" is a key of [scene]"}},
    {robot_a + "every = \"1 s\"", "4:1", {"\"every\" is a key of [[traffic]]"}},
    {traffic("payload = \"F\"\nevery = \"0.4 ns\""), "7:9", {"\"0.4 ns\"", "at least 1 ns"}},
    {robot_a + "colour = \"red\"", "4:1", {"unknown key \"colour\"", "expected one of name"}},
    {"[raido]\n" + robot_a, "1:2", {"did you mean \"radio\"?"}},
    {robot_a + "radio = { powr = \"5 dBm\" }", "4:11", {"did you mean \"power\"?"}},
    {robot_a + "[propagation]\nwall_facto = 3", "5:1", {"did you mean \"wall_factor\"?"}},
    {robot_a + "move = { model = \"fixed\", speed = \"1 m/s\" }", "4:27", {"unknown key"}},
    // Wrong types.
    {"radio = 5\n" + robot_a, "1:9", {"[radio]", "the number 5", "a table"}},
    {"[radio]\npower = 30 mW", "2:12", {"not TOML", "quotes"}},
    {"[[radio]]\n" + robot_a, "1:1", {"[radio]", "a list", "a table"}},
    {"[robot]\nname = \"A\"\n", "1:1", {"[[robot]]"}},
    {"robot = [1]\n", "1:10", {"[[robot]]", "the number 1"}},
    {robot_a + "[traffic]\nfrom = \"A\"", "4:1", {"[[traffic]]"}},
    {robot_a + "[scenario]\nname = 5", "5:8", {"text in quotes"}},
    {robot_a + "[scenario]\nseed = 1.5", "5:8", {"whole number"}},
    {robot_a + "[scenario]\nseed = -1", "5:8", {">= 0"}},
    {robot_a + "[propagation]\nexponent = \"2.5\"", "5:12", {"number without a unit"}},
    {robot_a + "[medium]\npropagation_delay = \"no\"", "5:21", {"true or false"}},
    {robot_a + "off = \"5 s\"", "4:7", {"list"}},
    {robot_a + "move = \"goal\"", "4:8", {"a table"}},
    {robot_a + "[trace]\nns2 = true", "5:7", {"\"none\", \"old\", \"new\""}},
    // Quantities.
    {robot_a + "[radio]\npower = 5", "5:9", {"without a unit", "did you mean \"5 dBm\"?"}},
    {robot_a + "[radio]\npower = \"5\"", "5:9", {"without a unit"}},
    {robot_a + "[radio]\npower = \"5 m\"", "5:9", {"the unit \"m\"", "a power"}},
    {robot_a + "[radio]\npower = \"5 dbm\"", "5:9", {"did you mean \"dBm\"?"}},
    {robot_a + "[radio]\npower = \"-5 mW\"", "5:9", {"did you mean \"-5 dBm\"?"}},
    {robot_a + "[radio]\npower = \"nan dBm\"", "5:9", {"found \"nan dBm\""}},
    {robot_a + "[radio]\npower = inf", "5:9", {"at most"}},
    {robot_a + "[radio]\nfrequency = \"2.45 ghz\"", "5:13", {"did you mean \"GHz\"?"}},
    {robot_a + "[radio]\nfrequency = \"0 Hz\"", "5:13", {"> 0"}},
    {robot_a + "[radio]\nrate = \"11 Mbps\"", "5:8", {"did you mean \"Mb/s\"?"}},
    {robot_a + "[radio]\ncable_loss = \"-1 dB\"", "5:14", {">= 0"}},
    {robot_a + "[scenario]\nduration = \"-5 s\"", "5:12", {"> 0"}},
    {robot_a + "[scenario]\nduration = \"1e10 s\"", "5:12", {"31 years"}},
    {robot_a + "[scenario]\nduration = 12:00:00", "5:12", {"\"10 s\""}},
    {robot_a + "[scenario]\nreplication = 4294967296", "5:15", {"4294967295"}},
    {robot_a + "[scenario]\nevent_limit = 0", "5:15", {"> 0"}},
    {robot_a + "radius = \"-1 m\"", "4:10", {">= 0"}},
    {"[[robot]]\nname = \"A\"\nat = [2, 3]", "3:7", {"did you mean \"2 m\"?"}},
    {"[[robot]]\nname = \"A\"\nat = [\"2 m\"]", "3:6", {"position"}},
    {"[[robot]]\nname = \"A\"\nat = [\"1e308 km\", \"0 m\"]", "3:7", {"at most 1e6 km"}},
    // Models and protocols.
    {robot_a + "[propagation]\nmodel = \"log_distnace\"",
     "5:9",
     {"unknown propagation model \"log_distnace\"", "did you mean \"log_distance\"?"}},
    {robot_a + "[propagation]\nmodel = \"disc\"", "4:1", {"\"disc\"", "\"range\"", "50 m"}},
    {robot_a + "[propagation]\nmodel = \"disc\"\nrnage = \"9 m\"",
     "6:1",
     {"unknown key \"rnage\"", "did you mean \"range\"?"}},
    {robot_a + "[propagation]\nrange = \"-3 m\"", "5:9", {">= 0"}},
    {robot_a + "[propagation]\nmodel = \"itu_indoor\"\nenvironment = \"offce\"",
     "6:15",
     {"did you mean \"office\"?"}},
    {robot_a + "[propagation]\nmodel = \"itu_indoor\"\nfloors = 1", "4:1", {"environment"}},
    {robot_a + "[radio]\nfrequency = \"60 MHz\"\n[propagation]\nmodel = \"itu_indoor\"\n"
               "environment = \"office\"",
     "6:1",
     {"60 MHz", "coefficient"}},
    {robot_a + "[reception]\nmodel = \"colision\"", "5:9", {"did you mean \"collision\"?"}},
    {robot_a + "[reception]\nmodel = \"sinr\"\n[propagation]\nmodel = \"disc\"\nrange = \"9 m\"",
     "6:1",
     {"disc", "no received levels"}},
    {robot_a + "radio = { rate = \"3 Mbit/s\" }\n[reception]\nmodel = \"sinr\"",
     "4:18",
     {"3 Mbit/s", "5.5"}},
    {robot_a + "[reception]\nmodel = \"sinr\"\n[access]\nmodel = \"csma\"\nbasic_rates = "
               "[\"1 Mbit/s\", \"7 Mbit/s\"]",
     "8:15",
     {"basic_rates", "7 Mbit/s", "5.5"}},
    {robot_a + "[access]\nmodel = \"csma\"\nbasic_rates = []", "6:15", {"at least one", "> 0"}},
    {robot_a + "[access]\nmodel = \"csma\"\nbasic_rates = [\"0 Mbit/s\"]",
     "6:15",
     {"at least one", "> 0"}},
    {robot_a + "[access]\nmodel = \"csma\"\nbasic_rate = \"1 Mbit/s\"",
     "6:1",
     {"did you mean \"basic_rates\"?"}},
    // Sums of times stay within the clock.
    {robot_a + "[routing]\njitter = \"9e9 s\"", "5:10", {"jitter", "at most 1e9 s"}},
    {robot_a + "[radio]\npreamble = \"2e9 s\"", "5:12", {"preamble", "at most 1e9 s"}},
    {robot_a + "[radio]\nrate = \"1e-9 b/s\"", "5:8", {"rate", ">= 1 bit/s"}},
    {robot_a + "[scenario]\nduration = \"9e9 s\"", "5:12", {"duration", "at most 1e9 s"}},
    {robot_a + "[[traffic]]\nfrom = \"A\"\npayload = \"x\"\nevery = \"9e9 s\"",
     "7:9",
     {"every", "at most 1e9 s"}},
    {robot_a + "turn_rate = \"1e-9 rad/s\"", "4:13", {"turn_rate", ">= 1e-8 rad/s"}},
    {robot_a + "[access]\nmodel = \"csma\"\nslot = \"0 s\"", "6:8", {"slot", "csma", "> 0"}},
    {robot_a + "[access]\nmodel = \"csma\"\nslot = \"1e8 s\"", "6:8", {"slot", "1023", "1e9 s"}},
    {robot_a + "[access]\nslot = \"0 s\"\nmodel = \"csma\"", "5:8", {"slot", "csma", "> 0"}},
    {robot_a + "[reception]\nmodel = \"sinr\"\n[radio]\nrate = \"7 Mb/s\"",
     "7:8",
     {"7 Mbit/s", "5.5"}},
    {robot_a + "[access]\nmodel = \"cmsa\"", "5:9", {"did you mean \"csma\"?"}},
    {robot_a + "[access]\ncw_min = -1", "5:10", {"from 0 to 65535"}},
    {robot_a + "[access]\nmodel = \"csma\"\ncw_min = 31\ncw_max = 7",
     "7:10",
     {"cw_max: found the number 7", "at least cw_min = 31"}},
    {robot_a + "[access]\nmodel = \"csma\"\ncw_max = 30", "6:10", {"at least cw_min = 31"}},
    {robot_a + "[[traffic]]\nkind = \"unicast\"\nfrom = \"A\"\npayload = \"x\"",
     "4:1",
     {"\"to\" is missing"}},
    {robot_a + "[[traffic]]\nfrom = \"A\"\nto = \"A\"\npayload = \"x\"", "6:6", {"broadcast"}},
    {robot_a + "[[traffic]]\nkind = \"unicast\"\nfrom = \"A\"\nto = \"B\"\npayload = \"x\"",
     "7:6",
     {"\"B\""}},
    {robot_a + "[[traffic]]\nfrom = \"A\"\nsaturate = true\npayload = \"x\"", "5:8", {"[access]"}},
    {robot_a + "[[traffic]]\nkind = \"unicast\"\nfrom = \"A\"\nto = \"A\"\npayload = \"x\"",
     "7:6",
     {"\"A\", which is the sender", "another robot"}},
    {robot_a + "on_receive = { send = \"x\", to = \"A\" }", "4:33", {"cannot send to itself"}},
    {robot_a + "on_receive = { send = \"x\", to = \"Q\" }", "4:33", {"no robot \"Q\""}},
    {robot_a + "on_arrival = { send = \"x\", to = \"sender\" }",
     "4:33",
     {"only the table on_receive"}},
    {robot_a + "on_receive = { stop = true, to = \"sender\" }",
     "4:14",
     {"send", "key \"to\" needs"}},
    // Values so large or so small that sums of them overflow.
    {robot_a + "[access]\nmodel = \"csma\"\nbasic_rates = [\"1e-9 b/s\"]", "6:16", {">= 1 bit/s"}},
    {robot_a + "[propagation]\nsigma = \"1e308 dB\"", "5:9", {"at most 10000 dB"}},
    {robot_a + "[propagation]\nwall_factor = 1e308", "5:15", {"from -1e9 to 1e9"}},
    {robot_a + "[propagation]\nexponent = 1e308", "5:12", {"from -1e9 to 1e9"}},
    {robot_a +
         "[[robot]]\nname = \"B\"\nat = [\"1 m\", \"1 m\"]\nmove = { model = \"group\", leader "
         "= \"A\", radius = \"1e308 m\" }",
     "7:50",
     {"at most 1e6 km"}},
    // What cannot be meant.
    {robot_a + "[radio]\nsensitivity = \"80 dBm\"", "5:15", {"receives nothing", "\"-80 dBm\"?"}},
    {traffic("payload = \"F\"\nevery = \"1 s\"\nstart = \"5 s\"\nstop = \"5 s\""),
     "9:8",
     {"start is 5 s", "later"}},
    // Names that cannot be printed.
    {"[[robot]]\nname = \"a\\u0000b\"\nat = [\"1 m\", \"1 m\"]", "2:8", {"control character 0x00"}},
    {robot_a + "[scenario]\nname = \"a\\u001b[2J\"", "5:8", {"control character 0x1b"}},
    {robot_a + "radio = { essid = \"\\u0007\" }", "4:19", {"essid", "control character 0x07"}},
    {"[scene.materials]\n\"a\\u0000\" = { grey = 3, per_crossing = \"3 dB\" }\n" + robot_a,
     "2:1",
     {"control character 0x00"}},
    {robot_a + "[routing]\nttl = 0", "5:7", {"from 1 to 65535"}},
    {robot_a + "[routing]\nttl = 65536", "5:7", {"from 1 to 65535"}},
    {robot_a + "[routing]\nprotocol = \"fload\"", "5:12", {"did you mean \"flood\"?"}},
    {robot_a + "[routing]\nprotocol = \"adov\"", "5:12", {"did you mean \"aodv\"?"}},
    {robot_a + "[routing]\nprotocol = \"flood\"\nhelo = \"1 s\"",
     "6:1",
     {"unknown key \"helo\"", "did you mean \"hello\"?"}},
    {robot_a + "[routing]\nprotocol = \"flood\"\nhello = \"-1 s\"", "6:9", {"from 0 to 10000 s"}},
    {robot_a + "[routing]\nprotocol = \"aodv\"\nduplicates = \"foward\"",
     "6:14",
     {"did you mean \"forward\"?"}},
    // Robots.
    {"[[robot]]\nat = [\"2 m\", \"3 m\"]", "1:1", {"\"name\" is missing"}},
    {"[[robot]]\nnmae = \"A\"", "2:1", {"unknown key \"nmae\"", "did you mean \"name\"?"}},
    {"[[robot]]\nname = \"A\"", "1:1", {"\"at\" is missing"}},
    {robot_a + "place = { area = [[\"0 m\", \"0 m\"], [\"1 m\", \"1 m\"]] }",
     "4:9",
     {"both \"at\" and \"place\""}},
    {robot_a + robot_a, "4:1", {"two robots are named \"A\"", ":1:1"}},
    {"[[robot]]\nname = \"A.1\"\nat = [\"2 m\", \"3 m\"]", "2:8", {"without dots"}},
    {robot_a + "count = 0", "4:9", {"from 1 to"}},
    {"[[robot]]\nname = \"A\"\nplace = {}", "3:9", {"\"area\" is missing"}},
    {"[[robot]]\nname = \"A\"\nplace = { model = \"choice\" }", "3:9", {"\"points\""}},
    {"[[robot]]\nname = \"A\"\nplace = { model = \"choice\", points = [] }",
     "3:38",
     {"points: found an empty list", "points = [["}},
    {"[[robot]]\nname = \"A\"\nplace = { area = [[\"0 m\", \"0 m\"]] }",
     "3:18",
     {"area: found a list", "area = [["}},
    {robot_a + "move = { model = \"patrol\", path = [] }", "4:35", {"path: found an empty list"}},
    {robot_a + "move = { model = \"goal\", among = [] }", "4:34", {"among: found an empty list"}},
    {robot_a + "off = [\"-5 s\"]", "4:7", {"off: ", "before 0 s"}},
    {robot_a + "on_receive = { payload = \"F\" }", "4:14", {"\"move\" is missing"}},
    // Movement.
    {robot_a + "move = {}", "4:8", {"\"model\" is missing"}},
    {robot_a + "move = { model = \"gaol\" }", "4:18", {"did you mean \"goal\"?"}},
    {robot_a + "move = { model = \"goal\" }", "4:8", {"\"to\" is missing"}},
    {robot_a + "move = { model = \"goal\", to = [\"5 m\", \"5 m\"], among = [[\"1 m\", \"1 m\"]] }",
     "4:55",
     {"both \"to\" and \"among\""}},
    {robot_a + "move = { model = \"goal\", to = [\"5 m\", \"5 m\"], speed = \"0 m/s\" }",
     "4:55",
     {"> 0"}},
    {robot_a + "move = { model = \"waypoints\" }", "4:8", {"\"path\" is missing"}},
    {robot_a + "move = { model = \"waypoints\", path = [\"5 m\", \"5 m\"] }", "4:39", {"position"}},
    {robot_a + "move = { model = \"waypoints\", path = [[\"5 m\", \"5 m\"]], times = [] }",
     "4:64",
     {"found 0 times for a path of 1 places"}},
    {robot_a + "move = { model = \"waypoints\", path = [[\"5 m\", \"5 m\"], [\"1 m\", \"1 m\"]], "
               "times = [\"2 s\", \"1 s\"] }",
     "4:80",
     {"later than the time before"}},
    // Traffic and studies.
    {robot_a + "[[traffic]]\nfrom = \"a\"\npayload = \"F\"", "5:8", {"no robot", "\"A\"?"}},
    {"[[robot]]\nname = \"r\"\ncount = 3\nat = [\"0 m\", \"0 m\"]\n[[traffic]]\nfrom = \"r\"\n"
     "payload = \"F\"",
     "6:8",
     {"r0 to r2"}},
    {robot_a + "[[traffic]]\npayload = \"F\"", "4:1", {"\"from\" is missing"}},
    {robot_a + "[[traffic]]\nform = \"A\"\npayload = \"F\"", "5:1", {"did you mean \"from\"?"}},
    {traffic(""), "4:1", {"\"payload\" is missing"}},
    {traffic("palyoad = \"F\""), "6:1", {"did you mean \"payload\"?"}},
    {traffic("kind = \"unicast\"\npayload = \"F\"\nstop = \"3 s\""), "4:1", {"\"to\" is missing"}},
    {traffic("size = 64"), "6:8", {"did you mean \"64 B\"?"}},
    {traffic("size = \"1.5 B\""), "6:8", {"whole number of bytes"}},
    {traffic("payload = \"F\"\nstart = \"arival\""), "7:9", {"a time"}},
    {traffic("payload = \"F\"\nstart = \"-5 s\""), "7:9", {">= 0"}},
    {traffic("payload = \"F\"\nevery = \"0 s\""), "7:9", {"> 0"}},
    {traffic("payload = \"F\"\ncount = 3"), "4:1", {"\"every\" is missing"}},
    {traffic("payload = \"F\"\nevery = \"1 s\"\ncount = 0"), "8:9", {">= 1"}},
    {study("replications = 0"), "5:16", {"from 1 to 1000000"}},
    {study("vary.propagation.model = \"friis\""), "5:26", {"vary.\"propagation.model\"", "a list"}},
    {study("vary.\"propagation.model\" = []"), "5:28", {"an empty list"}},
    {study("vary.a.b = [1]\nvary.\"a.b\" = [2]"), "6:6", {"given twice"}},
    {study("vary.a = { from = 1, to = 2 }"), "5:10", {"\"step\" is missing"}},
    {study("vary.a = { from = 1, to = 2, step = 0 }"),
     "5:10",
     {"the step never leads", "step > 0"}},
    {study("vary.a = { from = 3, to = 2, step = 1 }"), "5:10", {"from 3 to 2", "step < 0"}},
    {study("vary.a = { from = 1, to = 9e9, step = 1 }"), "5:10", {"more than 100000 values"}},
    {study("vary.a = { from = \"1 m\", to = \"9 km\", step = \"1 m\" }"), "5:10", {"units"}},
    {study("vary.a = { from = \"x\", to = 2, step = 1 }"), "5:19", {"a quantity"}},
    {study("vary.a = { from = 1, to = 2, stop = 1 }"), "5:30", {"did you mean \"step\"?"}},
    {study("vary.a = [1]\nzip = [[\"a\", \"b\"]]"), "6:8", {"\"b\" is not a key of \"vary\""}},
    {study("vary.a = [1]\nvary.b = [1, 2]\nzip = [[\"a\", \"b\"]]"), "7:8", {"1 values", "2"}},
    {study("vary.a = [1]\nzip = [[\"a\"], [\"a\"]]"), "6:15", {"listed twice"}},
    {study("vary.abc = [1]\nexclude = [{ abd = 1 }]"), "6:14", {"did you mean \"abc\"?"}},
    {study("vary.a = [1]\nexclude = { a = 1 }"), "6:11", {"a list of tables"}},
    {study("warmup = \"mser\""), "5:10", {"mser5"}},
    {study("warmup = \"-1 s\""), "5:10", {">= 0"}},
    {study("warmup = \"1 h\""),
     "5:10",
     {"found \"1 h\"", "less than [scenario] duration", "duration"}},
    {study("interval = \"wald\""), "5:12", {"one of \"t\", \"betting\", \"star\""}},
    {study("interval = \"star\"\nprecision = 0.1"), "5:12", {"fixed beforehand", "\"betting\""}},
    {study("confidence = 95"), "5:14", {"from 0.5 to 0.9999"}},
    {study("precision = 0"), "5:13", {"> 0"}},
    // Maps, and what only shows on them.
    {with_map("none.yaml"), "2:7", {"none.yaml", "no such file"}},
    {on_map + "[scene.x]", "7:8", {"unknown key \"x\" in [scene]"}},
    {with_map("folder.png"), "2:7", {"folder.png", "directory"}},
    {with_map("walls.png"), "2:7", {"size = "}},
    {"[scene]\nmap = \"cut.png\"\nsize = [\"8 m\", \"8 m\"]\n" + robot_a, "2:7", {"cut.png"}},
    {"[scene]\nmap = \"text.png\"\nsize = [\"8 m\", \"8 m\"]\n" + robot_a, "2:7", {"text.png"}},
    {"[scene]\nmap = \"huge.png\"\nsize = [\"8 m\", \"8 m\"]\n" + robot_a, "2:7", {"huge.png"}},
    {"[scene]\nmap = \"walls.png\"\nsize = [\"8 m\"]\n" + robot_a, "3:8", {"width and a height"}},
    {"[scene]\nmap = \"walls.png\"\nsize = [\"0 m\", \"8 m\"]\n" + robot_a, "3:8", {"> 0"}},
    {with_map("no_image.yaml"), "2:7", {"no_image.yaml", "image"}},
    {with_map("no_file.yaml"), "2:7", {"none.png", "no such file"}},
    {with_map("zero.yaml"), "2:7", {"zero.yaml:2:", "resolution"}},
    {with_map("syntax.yaml"), "2:7", {"syntax.yaml:"}},
    {with_map("list.yaml"), "2:7", {"list.yaml"}},
    {with_map("empty.yaml"), "2:7", {"empty.yaml"}},
    {"[scene]\nmap = \"walls.png\"\nsize = [\"8 m\", \"8 m\"]\n[[robot]]\nname = \"A\"\n"
     "at = [\"4.5 m\", \"2 m\"]",
     "6:6",
     {"\"A\"", "inside a wall"}},
    {on_map + "move = { model = \"goal\", to = [\"6 m\", \"2 m\"] }", "7:8", {"no path from"}},
    {in_file + "name = \"N1\"\n", "4:8", {"robot \"N1\"", "\"at\"", "did you mean \"n1\"?"}},
    {in_file + "name = \"zebra\"\n", "4:8", {"robot \"zebra\"", "such as \"n0\""}},
    {in_file + "name = \"n1\"\ncount = 2\n", "3:1", {"\"at\" is missing"}},
    {in_file + "name = \"n\"\ncount = 3\n", "3:1", {"\"at\" is missing"}},
    {on_map + "move = { model = \"goal\", to = [\"50 m\", \"2 m\"] }", "7:8", {"off the map"}},
    {on_map + "move = { model = \"goal\", to = [\"4.5 m\", \"2 m\"] }", "7:8", {"in a wall"}},
};

void build(const Scenario& scenario) {
    Network network(network_settings(scenario));
    populate(network, scenario);
}

struct Ended {
    int exit;
    std::string out, err;
};

std::string content(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// Runs the command in `folder`.
Ended command(const TemporaryFolder& folder, const std::string& arguments) {
    const std::string line = "cd '" + folder.path("") + "' && '" + ROVERNET_COMMAND + "' " +
                             arguments + " >out.txt 2>err.txt </dev/null";
    const int status = std::system(line.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(folder.path("out.txt")),
            content(folder.path("err.txt"))};
}

}  // namespace

TEST_CASE("bad input: every mistake is reported with line, column and a helpful message") {
    const TemporaryFolder folder;
    write_maps(folder);
    for (const auto& mistake : mistakes) {
        CAPTURE(mistake.text);
        const std::string file = folder.write("s.toml", mistake.text);
        const std::string place = mistake.place.empty() ? file : file + ":" + mistake.place;
        std::string message = "no error";
        try {
            build(load_scenario(file, {}));
        } catch (const InputError& error) {
            message = error.what();
            CHECK(error.where().text() == place);
        }
        CAPTURE(message);
        CHECK(message.starts_with(place + ": "));
        for (const auto& word : mistake.words) {
            CAPTURE(word);
            CHECK(message.find(word) != std::string::npos);
        }
    }
}

TEST_CASE(
    "bad input: the JSON schema finds every mistake that can be seen in one key and its value") {
    const Table schema = scenario_schema();
    const TemporaryFolder folder;
    write_maps(folder);
    std::size_t seen = 0, unseen = 0;
    for (const auto& mistake : mistakes) {
        CAPTURE(mistake.text);
        try {
            const Value document = parse_toml(mistake.text, "s.toml");
            const bool accepted = test::JsonSchema::accepts(schema, document);
            ++(accepted ? unseen : seen);
            std::string message;
            try {
                build(load_scenario(folder.write("s.toml", mistake.text), {}));
            } catch (const InputError& error) {
                message = error.message();
            }
            CAPTURE(message);
            for (const char* words :
                 {"unknown ", "without a unit", "with a unit", "a text in quotes", "a whole number",
                  "true or false", "expected a table"}) {
                if (message.find(words) != message.npos) CHECK_FALSE(accepted);
            }
        } catch (const InputError&) {
            // Not TOML: nothing for a schema.
        }
    }
    CHECK(seen > 0);
    MESSAGE(seen, " mistakes seen by the schema, ", unseen, " not");
}

TEST_CASE(
    "bad input: an error is printed on stderr only, with exit code 3, and no folder is created") {
    const TemporaryFolder folder;
    write_maps(folder);
    for (const auto& mistake : mistakes) {
        CAPTURE(mistake.text);
        folder.write("s.toml", mistake.text);
        const Ended ended = command(folder, "run s.toml --json --out results");
        CHECK(ended.exit == 3);
        CHECK(ended.out.empty());
        const std::string place = mistake.place.empty() ? "" : ":" + mistake.place;
        CHECK(ended.err.starts_with("s.toml" + place + ": "));
        CHECK(std::count(ended.err.begin(), ended.err.end(), '\n') == 1);
        CHECK_FALSE(std::filesystem::exists(folder.path("results")));
    }
}

TEST_CASE("bad input: if the scenario file is missing, a directory or empty, the exit code is 3") {
    const TemporaryFolder folder;
    folder.write("empty.toml", "");
    for (const char* file : {"none.toml", ".", "empty.toml"}) {
        const Ended ended = command(folder, std::string("run ") + file);
        CAPTURE(ended.err);
        CHECK(ended.exit == 3);
        CHECK(ended.out.empty());
        CHECK(ended.err.starts_with(std::string(file) + ": "));
    }
}

TEST_CASE("bad input: a mistake in an option gives exit code 2, and the error quotes the option") {
    const TemporaryFolder folder;
    folder.write("s.toml", robot_a);
    for (const char* option :
         {"radio.powr=5", "radio.power='5 m'", "radio.power=0", "radio.power=nan", "radio",
          "propagation.model=frii", "routing.ttl=0", "robot.B.radius=1", "traffic.0.start=1",
          "scenario.duration=-1", "radio.=1", "robot.A.at=[nan,0]", "scene.map=none.yaml"}) {
        const Ended ended = command(folder, std::string("run s.toml --set ") + option);
        CAPTURE(ended.err);
        CHECK(ended.exit == 2);
        CHECK(ended.out.empty());
        std::string unquoted = option;
        std::erase(unquoted, '\'');
        CHECK(ended.err.starts_with("rovernet: --set " + unquoted + ": "));
    }
}

TEST_CASE("bad input: unknown commands and options end with exit code 2") {
    const TemporaryFolder folder;
    folder.write("s.toml", robot_a);
    for (const char* arguments :
         {"", "\"\"", "=x", "walk", "run", "run s.toml --sped 2", "run s.toml --speed 0",
          "run s.toml --seed -1", "run s.toml --seed x", "loss frii --distance 1", "loss friis",
          "loss friis --distance x", "loss friis --distance -1", "loss friis a=1 --distance 1",
          "link s.toml A", "link s.toml A Z", "link s.toml A A", "trace", "version x"}) {
        const Ended ended = command(folder, arguments);
        CAPTURE(arguments);
        CAPTURE(ended.err);
        CHECK(ended.exit == 2);
        CHECK(ended.out.empty());
        CHECK_FALSE(ended.err.empty());
    }
}

TEST_CASE("bad input: a typing error on the command line gets a suggestion") {
    const TemporaryFolder folder;
    folder.write("s.toml", robot_a);
    for (const auto& [arguments, expected] :
         {std::pair{
              "rnu s.toml",
              "rovernet: unknown command \"rnu\"; expected one of run, live, emulate, in, sweep, "},
          std::pair{"rnu --seed 3", "; did you mean \"run\"?; run with --help for more\n"},
          std::pair{"bench flod", "expected one of flood; did you mean \"flood\"?"},
          std::pair{"bench flood --recordde=1 x",
                    "option \"--recordde\"; did you mean \"--recorded\"?"},
          std::pair{"run s.toml --sede 3", "option \"--sede\"; did you mean \"--seed\"?"},
          std::pair{"trace follow t.tr --message abc",
                    "--message: found \"abc\"; expected a whole number >= 0"},
          std::pair{"run s.toml --speed fast", "--speed: found \"fast\"; expected "},
          std::pair{"trace cut t.tr p.tr --from 50s --to 10s",
                    "the piece ends before it begins; expected --from before --to"},
          std::pair{"run s.toml --set radio.antenna_beamwidth=10",
                    "write the unit, such as antenna_beamwidth=\"10 deg\""},
          std::pair{"--verison", "option \"--verison\"; did you mean \"--version\"?"},
          std::pair{"run s.toml --xyz", "unknown option \"--xyz\"; run with --help for more"},
          std::pair{"version extra", "rovernet: unexpected argument \"extra\"; run with"}}) {
        const Ended ended = command(folder, arguments);
        CAPTURE(ended.err);
        CHECK(ended.exit == 2);
        CHECK(ended.out.empty());
        CHECK(ended.err.find(expected) != std::string::npos);
    }
}

TEST_CASE(
    "bad input: a scenario with random typing errors is either read, or refused with a message") {
    const std::string valid =
        "[scenario]\nname = \"all\"\nduration = \"12 s\"\n[radio]\npower = \"21 dBm\"\n"
        "[propagation]\nmodel = \"itu_indoor\"\ncoefficient = 28.0\nsigma = \"6 dB\"\n" +
        robot_a +
        "move = { model = \"waypoints\", path = [[\"5 m\", \"3 m\"]], times = [\"1 s\"] }\n"
        "off = [\"1 s\"]\n[[traffic]]\nfrom = \"A\"\nsize = \"9 B\"\nevery = \"3 s\"\n"
        "[study]\nvary.\"propagation.model\" = [\"disc\"]\n";
    const std::string pieces[] = {"\"",  "[", "]", "{",  "}", "=",    "\n",  ".", "-", "1e999",
                                  "nan", "0", "#", "\\", ",", "\xff", "[[a", " ", "m", "true"};
    std::mt19937 random(1);  // the engine's numbers are the standard's, the same everywhere
    const Table schema = scenario_schema();
    int failed = 0;
    for (int i = 0; i < 2000; ++i) {
        std::string text = valid;
        for (std::uint32_t edit = 0; edit <= random() % 3; ++edit) {
            const std::size_t at = random() % text.size(), length = random() % 12;
            switch (random() % 3) {
                case 0: text.erase(at, length); break;
                case 1: text.insert(at, pieces[random() % std::size(pieces)]); break;
                default: text.insert(at, text.substr(random() % text.size(), length)); break;
            }
        }
        CAPTURE(text);
        try {
            const Value document = parse_toml(text, "s.toml");
            to_toml(to_document(read_scenario(document, "s.toml")));
            CHECK(test::JsonSchema::accepts(schema, document));
        } catch (const InputError& error) {
            ++failed;
            CHECK_FALSE(error.message().empty());
        }
    }
    CHECK(failed > 1000);
    CHECK(failed < 2000);
}

}  // namespace bad_input_test
