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
    std::string out;  ///< picture to write; empty: none
    bool json = false;
};
void link(const LinkArguments& arguments);

struct LinksArguments : FileArguments {
    std::string at = "0 s";
    std::optional<std::string> robot;
    bool history = false, places = false;
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
    std::optional<std::string> robot;
    std::vector<std::string> to;    ///< partners: a link to any one of them is enough; empty:
                                    ///< option not given
    std::vector<std::string> over;  ///< robots over which the link may go, too
    bool csv = false, json = false;
};
void where(const WhereArguments& arguments);

struct DrawArguments : FileArguments {
    std::string at = "0 s";
    std::vector<std::string> coverage;   ///< robots whose coverage is drawn; empty: no coverage
    std::vector<std::string> margin_to;  ///< robots to which trails show the link margin
    std::vector<std::string> over;       ///< robots over which these links may go
    std::optional<std::string> receiver;
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
