// SPDX-License-Identifier: MIT
// Commands to a robot of a run that goes on, where the server lets pages give them.
const drive = (() => {
    "use strict";
    const own = { aims: -1 };

    /** @param {number} robot @param {Record<string, unknown>} what */
    function command(robot, what) { return live.ask("command", { robot, do: what }); }

    /** @param {string} label @param {string} hint */
    function field(label, hint) {
        const out = /** @type {HTMLInputElement} */ (dom.make("input", "field"));
        out.setAttribute("aria-label", label);
        out.placeholder = hint;
        return out;
    }

    /** Buttons and fields of the commands to a robot. @param {number} robot @returns {HTMLElement[]} */
    function parts(robot) {
        if (!live.state()?.controls_robots) return [];
        const goal = field("goal of the robot, x, y and z in metres", "x, y"), text = field("message to everyone", "message");
        const go = () => {
            const place = goal.value.split(/[\s,;]+/).filter(Boolean).map(Number);
            if (place.length > 1 && place.every(Number.isFinite)) command(robot, { goal: place });
            else controls.say("A goal is two or three numbers, such as 3, 4.");
        };
        goal.addEventListener("keydown", event => event.key === "Enter" && go());
        text.addEventListener("keydown", event => event.key === "Enter" && command(robot, { data: text.value }));
        return [dom.make("h3", "", "Commands"),
            dom.make("p", "actions", dom.button("drive to \u2026", "", () => aim(robot), "drive to the place of the next click on the map"), goal, dom.button("go", "", go), dom.button("stop", "", () => command(robot, { stop: true }))),
            dom.make("p", "actions", text, dom.button("send", "", () => command(robot, { data: text.value })))];
    }

    /** The next click on the map is the goal of a robot. @param {number} robot */
    function aim(robot) {
        own.aims = robot;
        controls.say("Click on the map: the robot drives there.");
        dom.by_id("map").classList.add("aims");
    }

    /** Takes a click on the map as a goal, if one is wanted. @param {number} px @param {number} py */
    function takes(px, py) {
        if (own.aims < 0) return false;
        const { floors } = sides.own.all[0].run.head.map;
        dom.by_id("map").classList.remove("aims");
        command(own.aims, { goal: [camera.from_x(px), camera.from_y(py), ...floors[1] === undefined ? [] : [floors[selection.state.storey]]] });
        own.aims = -1;
        return true;
    }

    return { parts, takes };
})();
