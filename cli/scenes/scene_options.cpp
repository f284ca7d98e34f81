// SPDX-License-Identifier: MIT
#include "cli/scenes/scene_commands.hpp"
#include "cli/terminal/options.hpp"

namespace rovernet::cli {
namespace {

void add_link(Command app) {
    const auto [link, a] = add_command(
        app, "link", "Print or draw the budget of the link from robot A to robot B", cli::link);
    link.add_examples({"rovernet link examples/rescue/rescue.toml A B --at 10s",
                       "rovernet link examples/rescue/rescue.toml A B -o budget.svg"});
    add_file(link, a, any_file);
    link.add_option("A", a.from, "transmitting robot").required();
    link.add_option("B", a.to, "receiving robot").required();
    link.add_option("--at", a.at, "simulated time, such as 12.5s").shows_default();
    const Option out = link.add_option("-o,--output", a.out,
                                       "draw the link budget with one step for each gain and loss: "
                                       "NAME.svg, NAME.png or NAME.pdf");
    add_json(link, a.json);
    link.option("--json").excludes(out);
}

void add_links(Command app) {
    const auto [links, a] = add_command(
        app, "links", "List the robots that each robot's radio hears, with signal levels",
        cli::links);
    links.add_examples({"rovernet links examples/rescue/rescue.toml --robot A",
                        "rovernet links examples/rescue/rescue.toml --history --places"});
    add_file(links, a, any_file);
    links.add_option("--at", a.at, "simulated time, such as 12.5s").shows_default();
    links.add_option("--robot", a.robot, "list only the robots that this robot hears");
    Option history =
        links.add_flag("--history", a.history, "print all link changes of the run, as CSV");
    history.excludes(links.option("--at"));
    links
        .add_flag("--places", a.places,
                  "with --history: print the positions of the two robots at each link change")
        .needs(history);
    links.add_flag("--json", a.json, "print the result as one JSON document");
}

void add_routes(Command app) {
    const auto [routes, a] =
        add_command(app, "routes", "Print the routing table of every robot", cli::routes);
    routes.add_examples({"rovernet routes examples/detour/detour.toml --at 20s --robot west",
                         "rovernet routes examples/detour/detour.toml --at 20s --csv"});
    add_file(routes, a, any_file);
    routes.add_option("--at", a.at, "simulated time, such as 12.5s").required();
    routes.add_option("--robot,--node", a.robot, "print only the table of this robot");
    Option csv = routes.add_flag("--csv", a.csv, "print CSV, with a line for each route");
    routes.add_flag("--json", a.json, "print the result as one JSON document").excludes(csv);
}

void add_scene(Command app) {
    const auto [scene, a] = add_command(
        app, "scene", "Describe the map, the robots and the links between them", cli::scene);
    scene.add_examples({"rovernet scene examples/rescue/rescue.toml",
                        "rovernet scene examples/rescue/office.png --size 48x24"});
    add_file(scene, a,
             "file as for rovernet run; or only a map: map.yaml, or an image with --size");
    scene.add_option("--size", a.size, "size of an image map in metres, such as 16x16");
    scene.add_option("--at", a.at, "simulated time, such as 12.5s").shows_default();
    scene.add_flag("--json", a.json, "print the result as one JSON document, including all walls");
}

void add_where(Command app) {
    const auto [where, a] = add_command(
        app, "where",
        "Print the position of every robot, or the places at which one robot has no link",
        cli::where);
    where.add_examples({"rovernet where examples/rescue/rescue.toml --at 10s,31.25s",
                        "rovernet where examples/patrol/patrol.toml --robot guard --to desk"});
    add_file(where, a, any_file);
    Option at = where.add_option("--at", a.at, "simulated times, such as 10s,31.25s");
    at.delimiter(',');
    Option robot = where.add_option("--robot", a.robot,
                                    "print only this robot; without --at: its position at the "
                                    "beginning of each leg of its path");
    Option to = where.add_option("--to", a.to,
                                 "print where the robot of --robot has no link to any of these "
                                 "robots, such as ap1,ap2: times, places, and the share of the "
                                 "run without a link");
    to.delimiter(',').needs(robot).excludes(at);
    where
        .add_option(
            "--over", a.over,
            "count connections over these robots (such as the relays of a mesh) as links, too")
        .delimiter(',')
        .needs(to);
    Option csv =
        where
            .add_flag("--csv", a.csv,
                      "print CSV, with a line for each period in which the robot has no link")
            .needs(to);
    add_json(where, a.json);
    where.option("--json").excludes(csv);
}

void add_draw(Command app) {
    const auto [draw, a] = add_command(
        app, "draw", "Draw the map with robots, links, routes or radio coverage", cli::draw);
    draw.add_examples({"rovernet draw examples/rescue/rescue.toml --links --at 10s -o rescue.svg",
                       "rovernet draw examples/rescue/rescue.toml --coverage A -o coverage.svg",
                       "rovernet draw examples/rescue/rescue.toml --coverage A --for B -o b.svg",
                       "rovernet draw examples/patrol/patrol.toml --trails --margin-to desk --at "
                       "40s -o gaps.svg",
                       "rovernet draw examples/detour/detour.toml --routes west,east --search --at "
                       "20s -o route.svg"});
    add_file(draw, a, any_file);
    draw.add_option("--at", a.at, "simulated time, such as 12.5s").shows_default();
    Option coverage = draw.add_option(
        "--coverage", a.coverage,
        "transmitting robot; draw over the map the power that is received from this robot. "
        "With several robots A,B: the power from the strongest one");
    coverage.delimiter(',');
    draw.add_option("--for", a.receiver,
                    "robot whose radio and antenna height are used for reception (default: the "
                    "radio and height of the first robot of --coverage)")
        .needs(coverage);
    draw.add_flag("--links", a.links, "draw the links between the robots");
    draw.add_option("--routes", a.route,
                    "draw the route in use from robot A to robot B, given as A,B")
        .delimiter(',');
    draw.add_flag("--search", a.search,
                  "draw the robots that sent or forwarded the last route request: with --routes "
                  "A,B the last request of robot A, otherwise the last request of any robot");
    Option trails = draw.add_flag("--trails", a.trails, "draw the paths of the robots so far");
    Option margin_to = draw.add_option(
        "--margin-to", a.margin_to,
        "colour the trails by the margin (level minus sensitivity) of the link to this "
        "robot, and mark where there is no link; with A,B: by the larger of the "
        "two margins");
    margin_to.delimiter(',').needs(trails);
    draw.add_option(
            "--over", a.over,
            "count connections over these robots (such as the relays of a mesh) as links, too")
        .delimiter(',')
        .needs(margin_to);
    draw.add_option("--storey", a.storey, "storey to draw; the lowest is 1").shows_default();
    draw.add_flag("--axes", a.axes, "draw axes in metres");
    draw.add_option("--width", a.width,
                    "width of the picture in pixels (for a PDF: in points); the text is scaled "
                    "with the width")
        .range(100, 10000)
        .shows_default();
    draw.add_option("--font-size", a.font_size,
                    "font size in points; without --width, the picture is 1200 points wide")
        .range(4, 36)
        .shows_default();
    draw.add_option("-o,--output", a.out, "picture to write: NAME.svg, NAME.png or NAME.pdf")
        .required();
}

void add_move(Command app) {
    Command move = app.add_command("move", "Work with movement files");
    move.needs_command();
    const auto [convert, a] = add_command(
        move, "convert", "Convert the motion of a scenario or movement file to another format",
        cli::convert_movements);
    convert.add_examples({"rovernet move convert examples/patrol/patrol.toml patrol.tcl"});
    add_file(convert, a, any_file);
    convert
        .add_option("OUT", a.out, "file to write: NAME.tcl (ns-2) or NAME.movements (BonnMotion)")
        .required();
}

}  // namespace

void add_scene_commands(Command app) {
    add_link(app);
    add_links(app);
    add_routes(app);
    add_scene(app);
    add_where(app);
    add_draw(app);
    add_move(app);
}

}  // namespace rovernet::cli
