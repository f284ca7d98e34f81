// SPDX-License-Identifier: MIT
#include "scene/occupancy.hpp"

#include "files/input_file.hpp"
#include "files/kept_inputs.hpp"
#include "scene/images/image.hpp"
#include "sim/error.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>
#include <utility>

namespace rovernet {
namespace {

enum class Mode { trinary, scale, raw };

struct RosMap {
    std::string image;  // its path
    double resolution = 1;
    std::array<double, 3> origin{};
    double occupied_thresh = 0.65;  // the defaults of nav2's map_saver
    double free_thresh = 0.25;
    bool negate = false;
    Mode mode = Mode::trinary;
};

/// Keys of one YAML file; errors report the place in the file.
class MapFile {
  public:
    MapFile(const std::string& path, std::vector<std::string>& notices)
        : path_(path), notices_(notices) {
        try {
            root_ = YAML::Load(text());
        } catch (const YAML::Exception& error) {
            fail(error.mark, fmt::format("not valid YAML ({}); expected lines of \"key: value\"; "
                                         "check brackets, quotes and indentation",
                                         error.msg));
        }
        if (!root_.IsMap())
            fail(root_.Mark(),
                 "found no \"key: value\" lines; expected a map with image, resolution and origin; "
                 "is this the map's YAML file?");
        check_keys();
    }

    RosMap read() const {
        RosMap map;
        map.image = picture();
        map.resolution = number(need_node("resolution"), "resolution", "metres per pixel");
        if (!(map.resolution > 0))
            fail_at(
                "resolution",
                fmt::format(
                    "\"resolution\" is {}; expected a number of metres per pixel > 0; such as 0.05",
                    map.resolution));
        read_origin(map.origin);
        read_thresholds(map);
        if (root_["negate"]) map.negate = read_negate();
        if (root_["mode"]) map.mode = read_mode();
        return map;
    }

  private:
    /// Path of the image. The error distinguishes a wrong folder (of another machine, or `~`) from
    /// a missing file.
    std::string picture() const {
        const auto name = need<std::string>("image", "the picture's file name");
        if (name.empty())
            fail_at("image",
                    "\"image\" is empty; expected the picture's file name; such as \"map.png\"");
        const auto folder = std::filesystem::path(path_).parent_path();
        const std::string beside = named_beside(folder.string(), name);
        if (!beside.empty())
            fail_at("image", fmt::format("\"image\" is \"{}\"; there is no such file, but there is "
                                         "\"{}\" in the same folder; write image: {}",
                                         name, beside, beside));
        return (folder / name).string();
    }

    [[noreturn]] void fail(const YAML::Mark& mark, const std::string& message) const {
        if (mark.is_null()) throw InputError(Location{path_}, message);
        throw InputError(Location{path_, mark.line + 1, mark.column + 1}, message);
    }
    [[noreturn]] void fail_at(const char* key, const std::string& message) const {
        fail(root_[key].Mark(), message);
    }

    std::string text() const {
        std::error_code ignored;
        const InputKind kind = input_kind(path_);
        if (is_no_path(kind))
            fail(YAML::Mark::null_mark(),
                 fmt::format("{}; expected a map's YAML file; check the path, which is "
                             "relative to the scenario's folder",
                             fault_of(kind)));
        if (kind != InputKind::file)
            fail(YAML::Mark::null_mark(),
                 "is not a regular file; expected a map's YAML file; name a file");
        if (std::filesystem::file_size(path_, ignored) > max_bytes)
            fail(YAML::Mark::null_mark(),
                 "found more than a megabyte; expected a map's YAML file of a few lines; is this "
                 "the map's YAML file?");
        std::ifstream file(path_, std::ios::binary);
        if (!file)
            fail(YAML::Mark::null_mark(),
                 "cannot be opened; expected a readable file; check the permissions of the file");
        note_input(path_);
        return {std::istreambuf_iterator<char>(file), {}};
    }

    void check_keys() {
        std::set<std::string> seen;
        for (const auto& entry : root_) {
            const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "(not a word)";
            if (!seen.insert(key).second)
                fail(entry.first.Mark(), fmt::format("key \"{}\" is given twice; expected the key "
                                                     "once; remove one of the two lines",
                                                     key));
            if (std::find(keys().begin(), keys().end(), key) == keys().end())
                strangers_.emplace_back(key, entry.first.Mark());
        }
        for (const auto& [key, mark] : strangers_) {
            const std::string missing = meant(key);
            if (missing.empty())
                note(mark, fmt::format("key \"{}\" is not a key of a map and is ignored", key));
            else
                fail(mark, fmt::format("unknown key \"{}\"; expected a key of a map; did you mean "
                                       "\"{}\"?",
                                       key, missing));
        }
    }
    static const std::vector<std::string>& keys() {
        static const std::vector<std::string> all{
            "image", "resolution", "origin", "negate", "free_thresh", "occupied_thresh", "mode"};
        return all;
    }
    /// Correct key for a misspelt one, "" if there is none: a key missing in the file that differs
    /// from `stranger` at one place, by at most two letters.
    std::string meant(const std::string& stranger) const {
        constexpr std::size_t short_word = 5;  // letters: another word is as near as a slip
        constexpr std::ptrdiff_t slip = 2;     // letters
        for (const std::string& key : keys()) {
            if (root_[key] || stranger.size() <= short_word) continue;
            const auto [a, b] =
                std::mismatch(stranger.begin(), stranger.end(), key.begin(), key.end());
            const auto [c, d] = std::mismatch(stranger.rbegin(), std::make_reverse_iterator(a),
                                              key.rbegin(), std::make_reverse_iterator(b));
            if (c.base() - a <= slip && d.base() - b <= slip) return key;
        }
        return "";
    }

    void note(const YAML::Mark& mark, const std::string& text) const {
        std::string notice = Location{path_, mark.line + 1, mark.column + 1}.text() + ": " + text;
        if (std::find(notices_.begin(), notices_.end(), notice) == notices_.end())
            notices_.push_back(std::move(notice));
    }

    YAML::Node need_node(const std::string& key) const {
        const YAML::Node node = root_[key];
        if (node) return node;
        fail(YAML::Mark::null_mark(),
             fmt::format("the key \"{0}\" is missing; expected the keys image, resolution and "
                         "origin; add a line \"{0}: ...\"",
                         key));
    }

    template <class T>
    T need(const char* key, const char* what) const {
        const YAML::Node node = need_node(key);
        T value{};
        if (!node.IsScalar() || !YAML::convert<T>::decode(node, value))
            fail(node.Mark(), fmt::format("\"{}\" is {}; expected {}; check the value", key,
                                          described(node), what));
        return value;
    }

    static std::string described(const YAML::Node& node) {
        if (node.IsScalar()) return fmt::format("\"{}\"", node.Scalar());
        return node.IsSequence() ? "a list" : node.IsMap() ? "a map" : "empty";
    }

    double number(const YAML::Node& node, const char* key, const char* what) const {
        double value = 0;
        if (!node.IsScalar() || !YAML::convert<double>::decode(node, value) ||
            !std::isfinite(value))
            fail(node.Mark(),
                 fmt::format("\"{}\" is {}; expected a number, {}; write a number such as 0.05",
                             key, described(node), what));
        return value;
    }

    void read_origin(std::array<double, 3>& origin) const {
        const YAML::Node node = need_node("origin");
        if (!node.IsSequence() || node.size() != origin.size())
            fail(node.Mark(),
                 fmt::format("\"origin\" is {}; expected exactly three numbers [x, y, yaw] in "
                             "metres and radians; such as [0, 0, 0]",
                             node.IsSequence() ? fmt::format("a list of {}", node.size())
                                               : described(node)));
        for (std::size_t i = 0; i < origin.size(); ++i)
            origin[i] = number(node[i], "origin", "of [x, y, yaw] in metres and radians");
    }

    void read_thresholds(RosMap& map) const {
        for (const auto& [key, value] : {std::pair{"occupied_thresh", &map.occupied_thresh},
                                         std::pair{"free_thresh", &map.free_thresh}}) {
            if (!root_[key]) continue;
            *value = number(root_[key], key, "from 0 to 1");
            if (*value < 0 || *value > 1)
                fail_at(key,
                        fmt::format("\"{}\" is {}; expected a number from 0 to 1; such as 0.65",
                                    key, *value));
        }
        const YAML::Node occupied = root_["occupied_thresh"], free = root_["free_thresh"];
        if (map.occupied_thresh > map.free_thresh || !(occupied || free)) return;
        if (occupied && free)
            fail(occupied.Mark(),
                 fmt::format("\"occupied_thresh\" is {} and \"free_thresh\" is {}; expected "
                             "occupied_thresh > free_thresh; did you swap the two values?",
                             map.occupied_thresh, map.free_thresh));
        if (occupied)
            give_way("free_thresh", map.free_thresh, "occupied_thresh", map.occupied_thresh);
        else
            give_way("occupied_thresh", map.occupied_thresh, "free_thresh", map.free_thresh);
    }

    /// Adapts the default of a missing threshold to the one in the file.
    void give_way(const char* missing, double& usual, const char* key, double given) const {
        note(root_[key].Mark(), fmt::format("the key \"{}\" is missing, and its default value {} "
                                            "contradicts {} = {}, so both keys get the value {}",
                                            missing, usual, key, given, given));
        usual = given;
    }

    bool read_negate() const {
        const YAML::Node node = root_["negate"];
        int number = 0;
        if (YAML::convert<int>::decode(node, number)) return number != 0;
        return need<bool>("negate", "0, 1, true or false");
    }

    Mode read_mode() const {
        static const std::vector<std::string> names{"trinary", "scale", "raw"};
        const auto name = need<std::string>("mode", "trinary, scale or raw");
        for (std::size_t i = 0; i < names.size(); ++i)
            if (name == names[i]) return static_cast<Mode>(i);
        const std::string near = did_you_mean(name, names);
        fail_at("mode", fmt::format("\"mode\" is \"{}\"; expected trinary, scale or raw; {}", name,
                                    near.empty() ? "leave the key out for trinary" : near));
    }

    static constexpr std::uintmax_t max_bytes = 1 << 20;
    const std::string& path_;
    std::vector<std::string>& notices_;
    YAML::Node root_;
    std::vector<std::pair<std::string, YAML::Mark>> strangers_;  // keys that a map does not have
};

Cell by_thresholds(double occupancy, double free_thresh, double occupied_thresh) {
    if (occupancy > occupied_thresh) return Cell::occupied;
    return occupancy < free_thresh ? Cell::free : Cell::unknown;
}

Cell cell_of(const Image& image, int column, int row, const RosMap& map) {
    int sum = image.rgb_sum(column, row);
    int samples = 3;
    if (map.mode == Mode::trinary && image.has_alpha()) {
        sum += image.alpha(column, row);
        ++samples;
    }
    const double shade = sum / (255.0 * samples);
    if (map.mode == Mode::raw) {
        const double percent = std::floor(shade * 255 + 0.5);
        if (percent > 100) return Cell::unknown;
        return by_thresholds(percent, 100 * map.free_thresh, 100 * map.occupied_thresh);
    }
    if (map.mode == Mode::scale && image.alpha(column, row) < 255) return Cell::unknown;
    return by_thresholds(map.negate ? shade : 1 - shade, map.free_thresh, map.occupied_thresh);
}

/// Fills the cells from the image, bottom row first.
template <class CellOf>
void fill(OccupancyGrid& grid, const Image& image, CellOf cell_of_pixel) {
    grid.columns = image.width;
    grid.rows = image.height;
    const auto pixels =
        static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    grid.cells.reserve(pixels);
    grid.greys.reserve(pixels);
    for (int row = image.height - 1; row >= 0; --row)
        for (int column = 0; column < image.width; ++column) {
            grid.cells.push_back(cell_of_pixel(column, row));
            grid.greys.push_back(static_cast<std::uint8_t>((image.rgb_sum(column, row) + 1) / 3));
        }
}

}  // namespace

OccupancyGrid read_ros_map(const std::string& yaml_path) {
    std::vector<std::string> ignored;
    return read_ros_map(yaml_path, ignored);
}

OccupancyGrid read_ros_map(const std::string& yaml_path, std::vector<std::string>& notices) {
    const RosMap map = MapFile(yaml_path, notices).read();
    const Image image = read_image(map.image);
    OccupancyGrid grid;
    grid.cell_width = grid.cell_height = map.resolution;
    grid.origin = {map.origin[0], map.origin[1], 0};
    grid.yaw = map.origin[2];
    fill(grid, image, [&](int column, int row) { return cell_of(image, column, row, map); });
    return grid;
}

OccupancyGrid image_map(const std::string& path, Meters width, Meters height) {
    for (const auto& [name, size] : {std::pair{"width", width}, std::pair{"height", height}})
        if (!(size.value > 0 && std::isfinite(size.value)))
            throw std::invalid_argument(
                fmt::format("image_map: {} must be > 0 m, got {} m", name, size.value));
    const Image image = read_image(path);
    OccupancyGrid grid;
    grid.cell_width = width.value / image.width;
    grid.cell_height = height.value / image.height;
    fill(grid, image, [&](int column, int row) {
        const bool wall = 2 * image.rgb_sum(column, row) < 3 * 255;
        return wall && image.alpha(column, row) > 0 ? Cell::occupied : Cell::free;
    });
    return grid;
}

}  // namespace rovernet
