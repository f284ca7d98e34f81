// SPDX-License-Identifier: MIT
#pragma once

#include "cli/terminal/commands.hpp"

#include <optional>
#include <string>
#include <vector>

/// Commands that examine a scene: link, links, routes, scene, where, draw, move.
namespace rovernet::cli {

struct LinkArguments : FileArguments {
    std::string from, to;
    std::string at = "0 s";
    bool json = false;
};
void link(const LinkArguments& arguments);

struct LinksArguments : FileArguments {
    std::string at = "0 s";
    std::optional<std::string> robot;
    bool history = false;
    bool json = false;
};
void links(const LinksArguments& arguments);

struct RoutesArguments : FileArguments {
    std::string at;
    std::optional<std::string> robot;
    bool csv = false, json = false;
};
void routes(const RoutesArguments& arguments);

struct SceneArguments : FileArguments {
    std::string at = "0 s";
    std::optional<std::string> size;  ///< size of a picture used as a map: WIDTHxHEIGHT in metres
    bool json = false;
};
void scene(const SceneArguments& arguments);

struct WhereArguments : FileArguments {
    std::vector<std::string> at;
    bool json = false;
};
void where(const WhereArguments& arguments);

struct DrawArguments : FileArguments {
    std::string at = "0 s";
    std::optional<std::string> coverage, receiver;
    std::vector<std::string> route;  ///< source and destination of the drawn route; empty: no route
    bool search = false;
    bool links = false;
    bool trails = false;
    bool axes = false;
    int storey = 1;
    int width = 1200;
    double font_size = 12;
    std::string out;
};
void draw(const DrawArguments& arguments);

struct ConvertArguments : FileArguments {
    std::string out;
};
void convert_movements(const ConvertArguments& arguments);

}  // namespace rovernet::cli
