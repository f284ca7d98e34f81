// SPDX-License-Identifier: MIT
#include "live/player/config.hpp"

#include "live/player/config_drivers.hpp"
#include "scene/stage/worldfile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string_view>
#include <utility>

namespace rovernet {
namespace {

/// A robot, and all the addresses at which Stage provides it.
struct ProvidedRobot {
    PlayerConfig::Robot robot;
    std::vector<ConfiguredDevice> devices;
};

/// Reads the drivers of a file.
class DriversReader {
  public:
    explicit DriversReader(std::string path) : path_(std::move(path)) {}

    PlayerConfig read(const WorldFile& file);

  private:
    void read_stage(const WorldEntity& driver);
    void join(const WorldEntity& driver, std::string_view name);
    ProvidedRobot* robot_of(const std::vector<ConfiguredDevice>& devices, std::uint32_t port);
    void pass_over(const WorldEntity& driver, const std::string& text);

    std::string path_;
    PlayerConfig config_;
    std::vector<ProvidedRobot> robots_;
    std::vector<std::string> others_;  // names of drivers that do not run here
    Location first_other_;
};

PlayerConfig DriversReader::read(const WorldFile& file) {
    std::vector<std::pair<const WorldEntity*, std::string>> beside;
    for (const WorldEntity& driver : file.root.children) {
        const WorldProperty* name = driver.find("name");
        if (driver.type != "driver" || !name) continue;
        if (name->text() == "stage") {
            read_stage(driver);
        } else {
            beside.emplace_back(&driver, name->text());
        }
    }
    for (const auto& [driver, name] : beside) {
        if (name == "comdriver" || name == "relay") {
            join(*driver, name);
        } else {
            pass_over(*driver, name);
        }
    }
    if (!others_.empty()) {
        config_.notices.push_back(
            world_notice(first_other_, fmt::format("these drivers of the Player server are not "
                                                   "supported, and their devices are missing: {}",
                                                   fmt::join(others_, ", "))));
    }
    for (ProvidedRobot& each : robots_) config_.robots.push_back(std::move(each.robot));
    return std::move(config_);
}

void DriversReader::read_stage(const WorldEntity& driver) {
    if (const WorldProperty* world = driver.find("worldfile")) {
        const auto folder = std::filesystem::path(path_).parent_path();
        config_.world = (folder / world->text()).string();
    }
    const WorldProperty* model = driver.find("model");
    if (!model) return;
    auto devices = configured_devices(driver, "provides");
    const auto position = std::find_if(devices.begin(), devices.end(), [](const auto& each) {
        return each.interface == "position2d" || each.interface == "position";
    });
    if (position == devices.end()) return;
    const auto port = static_cast<std::uint16_t>(position->port);
    const std::uint32_t index = position->index;
    robots_.push_back({{model->text(), port, index, model->where}, std::move(devices)});
}

/// The robot that provides one of these devices, or else the first one at that port.
ProvidedRobot* DriversReader::robot_of(const std::vector<ConfiguredDevice>& devices,
                                       std::uint32_t port) {
    for (ProvidedRobot& each : robots_) {
        const bool has = std::any_of(devices.begin(), devices.end(), [&](const auto& wanted) {
            return std::find(each.devices.begin(), each.devices.end(), wanted) !=
                   each.devices.end();
        });
        if (has && each.robot.port == port) return &each;
    }
    const auto found = std::find_if(robots_.begin(), robots_.end(),
                                    [&](const auto& each) { return each.robot.port == port; });
    return found == robots_.end() ? nullptr : &*found;
}

/// Gives a comdriver or a relay to its robot.
void DriversReader::join(const WorldEntity& driver, std::string_view name) {
    const auto provides = configured_devices(driver, "provides");
    const auto opaque = std::find_if(provides.begin(), provides.end(),
                                     [](const auto& each) { return each.interface == "opaque"; });
    if (opaque == provides.end()) {
        throw InputError(driver.where,
                         fmt::format("{}: found no opaque device in \"provides\"; expected "
                                     "provides [ \"6665:opaque:1\" ]",
                                     name));
    }
    ProvidedRobot* robot = robot_of(configured_devices(driver, "requires"), opaque->port);
    if (!robot) {
        return pass_over(driver,
                         fmt::format("{} at port {}, which has no robot", name, opaque->port));
    }
    if (name == "relay") {
        robot->robot.relay = opaque->index;
    } else {
        robot->robot.comdriver = {opaque->index, read_mapping(driver), driver.where};
    }
}

void DriversReader::pass_over(const WorldEntity& driver, const std::string& text) {
    if (others_.empty()) first_other_ = driver.where;
    if (std::find(others_.begin(), others_.end(), text) == others_.end()) others_.push_back(text);
}

/// A mapping against the robots of its file: pairs that are no robot, and robots that it leaves
/// out.
struct Compared {
    std::vector<std::string> strangers, missing;
};

Compared compared(const PlayerConfig::Robot& robot, const PlayerConfig& config,
                  const std::vector<std::string>& ips) {
    Compared out;
    std::set<std::size_t> mapped;
    for (const auto& [ip, port] : robot.comdriver->mapping) {
        std::size_t i = 0;
        while (i < ips.size() && (ips[i] != ip || config.robots[i].port != port)) ++i;
        if (i == ips.size()) out.strangers.push_back(fmt::format("{} {}", ip, port));
        mapped.insert(i);
    }
    for (std::size_t i = 0; i < ips.size(); ++i) {
        const std::string& other = config.robots[i].model;
        if (other != robot.model && !mapped.contains(i)) out.missing.push_back(other);
    }
    return out;
}

}  // namespace

bool PlayerConfig::has_comdriver() const {
    return std::any_of(robots.begin(), robots.end(),
                       [](const Robot& each) { return each.comdriver.has_value(); });
}

PlayerConfig read_player_config(const std::string& path) {
    PlayerConfig config = DriversReader(path).read(read_worldfile(path, {}));
    const Location file{.source = path};
    if (config.world.empty()) {
        throw InputError(file,
                         "found no world; expected driver ( name \"stage\" ... worldfile "
                         "\"NAME.world\" )");
    }
    if (config.robots.empty()) {
        throw InputError(file,
                         "found no robot; expected driver ( name \"stage\" provides [ "
                         "\"6665:position2d:0\" ] model \"robot1\" )");
    }
    return config;
}

std::vector<std::string> mapping_notices(const PlayerConfig& config,
                                         const std::vector<std::string>& ips) {
    std::vector<std::string> notices;
    for (const PlayerConfig::Robot& robot : config.robots) {
        if (!robot.comdriver || robot.comdriver->mapping.empty()) continue;
        const auto [strangers, missing] = compared(robot, config, ips);
        if (!strangers.empty()) {
            notices.push_back(world_notice(
                robot.comdriver->where,
                fmt::format("mapping: no robot of this file has this IP address at this port: {}",
                            fmt::join(strangers, ", "))));
        }
        if (!missing.empty()) {
            notices.push_back(world_notice(
                robot.comdriver->where,
                fmt::format("mapping leaves out {}; these robots nevertheless receive the radio "
                            "messages of {}, because every robot in range receives a message",
                            fmt::join(missing, ", "), robot.model)));
        }
    }
    return notices;
}

}  // namespace rovernet
