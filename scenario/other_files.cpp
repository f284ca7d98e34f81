// SPDX-License-Identifier: MIT
#include "scenario/other_files.hpp"

#include "files/input_file.hpp"
#include "scene/images/image.hpp"
#include "sim/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <vector>

namespace rovernet {
namespace {

namespace fs = std::filesystem;

/// Kind of files that are no scenarios: endings of their names, first bytes, and the error.
struct Kind {
    std::vector<std::string_view> endings, beginnings;
    std::string_view what;
};

const Kind a_map = {
    {".yaml", ".yml"},
    {"\x89PNG\r\n"},
    "this is a map, not a scenario; expected a scenario (.toml) that names this map: [scene] map = "
    "\"...\"; the command \"rovernet scene\" shows a map without a scenario"};
const Kind kinds[] = {
    a_map,
    {{".inc"},
     {},
     "this is a part of a Stage world; expected the world (.world) that includes this part"},
    {{".db"},
     {"SQLite format 3"},
     "this file is the store with the results of a study, not a scenario; the command \"rovernet "
     "results\" shows these results"},
    {{".tr"},
     {},
     "this is a trace, not a scenario; the command \"rovernet trace stats\" shows the metrics of a "
     "trace"},
    {{".mcap"},
     {"\x89MCAP0\r\n"},
     "this is a recorded trace, not a scenario; the command \"rovernet replay\" plays a trace "
     "again, and \"rovernet trace stats\" shows its metrics"},
    {{".pcap", ".pcapng"},
     {"\n\r\r\n", "\xd4\xc3\xb2\xa1", "\xa1\xb2\xc3\xd4", "\x4d\x3c\xb2\xa1", "\xa1\xb2\x3c\x4d"},
     "this is a capture of packets, not a scenario; Wireshark shows the packets of a capture"},
    {{".json"},
     {},
     "this is a JSON file, not a scenario; if a run wrote this file, the scenario of the run is "
     "the file scenario.toml in the same folder"}};

/// World named in a Player configuration; "NAME.world" if it names none.
std::string world_of(const std::string& player_file) {
    std::ifstream file(player_file);
    for (std::string line; std::getline(file, line);) {
        const auto key = line.find("worldfile");
        const auto begin = line.find('"', key);
        if (key == line.npos || begin == line.npos || line.find('#') < key) continue;
        const std::string name = line.substr(begin + 1, line.find('"', begin + 1) - begin - 1);
        return (fs::path(player_file).parent_path() / name).string();
    }
    return "NAME.world";
}

/// First bytes of a file, at most 16.
std::string beginning_of(const std::string& path) {
    std::string bytes(16, '\0');
    std::ifstream file(path, std::ios::binary);
    file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(file.gcount()));
    return bytes;
}

}  // namespace

void refuse_other_files(const std::string& path) {
    if (input_kind(path) != InputKind::file) return;
    const std::string ending = fs::path(path).extension().string(), begin = beginning_of(path);
    if (ending == ".cfg") {
        throw InputError(Location{path},
                         fmt::format("this is a configuration of Player, not a scenario; expected "
                                     "the Stage world that this file names: {}",
                                     world_of(path)));
    }
    if (is_image_name(path)) throw InputError(Location{path}, std::string(a_map.what));
    for (const Kind& kind : kinds) {
        const auto has_beginning = [&](std::string_view known) { return begin.starts_with(known); };
        const bool is_named = std::count(kind.endings.begin(), kind.endings.end(), ending) > 0;
        if (is_named ||
            std::any_of(kind.beginnings.begin(), kind.beginnings.end(), has_beginning)) {
            throw InputError(Location{path}, std::string(kind.what));
        }
    }
}

}  // namespace rovernet
