// SPDX-License-Identifier: MIT
// Keys, and the page that tells them.
const keys = (() => {
    "use strict";
    const second = 1e9;
    /** @type {{run: Run}} */ const own = { run: /** @type {any} */ (null) };

    /** Keys and what they do. @type {[string, string][]} */
    const told = [
        ["Space, K", "play, pause"], ["\u2190 \u2192", "event before, next event (of the filter)"],
        ["Shift \u2190 \u2192", "one second"], ["Alt \u2190 \u2192", "frame before, next frame"],
        ["Home, End", "begin, end of the run"], ["[ ]", "slower, faster"],
        ["+ \u2212 0", "map closer, wider, whole"], ["arrows in the map", "move the map"],
        ["< >", "time line closer, wider"], ["/", "search"],
        ["F", "follow the message of the current event"], ["C", "coverage of the robot chosen"], ["L", "links"],
        ["1 2 3 4 5 6", "events, message, robot, pair, charts, compare"], ["A B S", "run A, run B (again: the other), side by side"], ["Page up, down", "storey"], ["Escape", "choose nothing"], ["?", "this help"]
    ];

    /** @param {KeyboardEvent} event @param {1|-1} direction */
    function step(event, direction) {
        if (event.shiftKey) clock.seek(selection.state.t + direction * second);
        else if (event.altKey) list.step(direction, (i, w) => w.kind[i] === events.frame);
        else list.step(direction);
    }

    function follow() {
        const w = list.own.window, at = w ? run.count_until(w.time, selection.state.t) : 0;
        for (let i = at - 1; w && i >= 0; i--) {
            const { message } = events.about(own.run, w, i);
            if (message >= 0 && message < own.run.messages) return selection.set({ message: selection.state.message === message ? -1 : message, panel: "message" });
        }
    }

    /** @param {number} by */
    function storey(by) {
        selection.set({ storey: Math.min(own.run.head.map.floors.length - 1, Math.max(0, selection.state.storey + by)) });
    }

    function help() { /** @type {HTMLDialogElement} */ (dom.by_id("help")).showModal(); }

    const far = 60;  // [px]

    /** @type {Record<string, (event: KeyboardEvent) => void>} */
    const actions = {
        " ": live.play, k: live.play,
        ArrowLeft: e => step(e, -1), ArrowRight: e => step(e, 1), j: e => step(e, -1),
        Home: () => clock.seek(0), End: () => live.is_live() ? live.follow() : clock.seek(own.run.duration),
        "[": () => clock.set_power(clock.power() - 0.5), "]": () => clock.set_power(clock.power() + 0.5),
        "+": () => controls.zoom(1.4), "=": () => controls.zoom(1.4), "-": () => controls.zoom(1 / 1.4), 0: () => selection.set({ view: null }),
        "<": () => timeline.zoom(0.5, timeline.middle()), ">": () => timeline.zoom(2, timeline.middle()),
        "/": () => dom.input("search").focus(), f: follow,
        c: () => coverage.toggle(selection.state.robots.at(-1) ?? -1),
        l: links.toggle,
        a: () => sides.show(selection.state.runs === "A" ? "B" : "A"), b: () => sides.show(selection.state.runs === "B" ? "A" : "B"), s: () => sides.show("AB"),
        PageUp: () => storey(1), PageDown: () => storey(-1),
        Escape: () => selection.set({ robots: [], message: -1 }),
        "?": help
    };

    /** @type {Record<string, [number, number]>} */
    const arrows = { ArrowLeft: [far, 0], ArrowRight: [-far, 0], ArrowUp: [0, far], ArrowDown: [0, -far] };

    /** @param {KeyboardEvent} event */
    function pressed(event) {
        const target = event.target instanceof HTMLElement ? event.target : document.body;
        if (event.ctrlKey || event.metaKey || target.closest("dialog[open]") || target.matches("input:not([type=range]), select")) return;
        if (target.id === "map" && arrows[event.key] && !event.shiftKey && !event.altKey) {
            selection.set({ view: camera.moved(...arrows[event.key]) });
            return event.preventDefault();
        }
        const own_keys = target.matches("button, summary, [type=range]") && [" ", "Enter"].includes(event.key) ||
            target.matches("[type=range]") && event.key.startsWith("Arrow") ||
            target.matches("[role=tab]") && event.key.startsWith("Arrow") ||
            target.id === "events" && ["ArrowUp", "ArrowDown", "PageUp", "PageDown"].includes(event.key);
        const action = actions[event.key] ?? actions[event.key.toLowerCase()];
        if (own_keys || !action) return;
        event.preventDefault();
        action(event);
    }

    /** @param {Run} r */
    function show(r) { own.run = r; }

    function begin() {
        sides.own.panels.forEach((panel, i) => actions[String(i + 1)] = () => selection.set({ panel }));
        document.addEventListener("keydown", pressed);
        dom.by_id("help-keys").replaceChildren(dom.facts(told));
        dom.on_click("help-open", help);
        dom.on_click("help-close", () => /** @type {HTMLDialogElement} */ (dom.by_id("help")).close());
    }

    return { begin, show };
})();
