// SPDX-License-Identifier: MIT
// Buttons, tabs, pointers on the map, and the texts that tell the state.
const controls = (() => {
    "use strict";
    const { panels } = sides.own;
    /** @type {{run: Run, blocks: Blocks, note: string, resting: number, stale: boolean}} */
    const own = { run: /** @type {any} */ (null), blocks: /** @type {any} */ (null), note: "", resting: 0, stale: true };

    /** Makes the map larger around its middle. @param {number} factor */
    function zoom(factor) {
        selection.set({ view: camera.zoomed(factor, camera.now.width / 2, camera.now.height / 2, own.run.head) });
    }

    function buttons() {
        const { state, set } = selection, head = own.run.head;
        dom.on_click("play", live.play);
        dom.on_click("present", live.follow);
        dom.on_click("before", () => list.step(-1));
        dom.on_click("next", () => list.step(1));
        dom.on_click("trails", () => set({ trails: !state.trails }));
        dom.on_click("links", links.toggle);
        dom.on_click("picture", () => files.picture(own.run, state));
        dom.on_click("drawing", () => files.drawing(own.run, state));
        dom.by_id("drawing").hidden = !server.is_served() || live.is_live() || Boolean(document.getElementById("goes-on"));
        dom.on_click("table", () => files.table(own.run, own.blocks, state));
        dom.on_click("closer", () => zoom(1.4));
        dom.on_click("wider", () => zoom(1 / 1.4));
        dom.on_click("whole", () => set({ view: null }));
        dom.on_click("whole-time", () => set({ span: null }));
        dom.input("speed").addEventListener("input", () => clock.set_power(Number(dom.input("speed").value)));
        panels.forEach((panel, i) => {
            const tab = dom.by_id(`${panel}-tab`);
            tab.addEventListener("click", () => set({ panel }));
            tab.addEventListener("keydown", event => {
                const by = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
                if (!by) return;
                const next = panels[(i + by + panels.length) % panels.length];
                set({ panel: next });
                dom.by_id(`${next}-tab`).focus();
                event.preventDefault();
            });
        });
        if (head.map.floors.length < 2) return;
        dom.by_id("storeys").hidden = false;
        dom.by_id("storeys").append(...head.map.floors.map((floor, i) => {
            const out = dom.button(`Storey ${i + 1}`, "", () => set({ storey: i }));
            out.title = `floor at ${words.number(floor, 4)} m`;
            return out;
        }));
        const all = dom.button("All", "", () => set({ all: !state.all }));
        all.title = "Robots of all storeys";
        dom.by_id("storeys").append(all);
    }

    function pointers() {
        const area = dom.by_id("map"), { state, set } = selection;
        /** @type {Map<number, {x: number, y: number}>} */ const down = new Map();
        let moved = 0;
        area.addEventListener("wheel", event => {
            event.preventDefault();
            set({ view: camera.zoomed(0.9985 ** event.deltaY, sides.under(event.offsetX).x, event.offsetY, own.run.head) });
        }, { passive: false });
        area.addEventListener("pointerdown", event => {
            area.setPointerCapture(event.pointerId);
            down.set(event.pointerId, { x: event.offsetX, y: event.offsetY });
            moved = 0;
        });
        area.addEventListener("pointermove", event => {
            hover(event.offsetX, event.offsetY);
            const before = down.get(event.pointerId);
            if (!before) return;
            const dx = event.offsetX - before.x, dy = event.offsetY - before.y;
            moved += Math.abs(dx) + Math.abs(dy);
            if (moved < 4) return;
            const other = [...down].find(([id]) => id !== event.pointerId)?.[1];
            down.set(event.pointerId, { x: event.offsetX, y: event.offsetY });
            if (!other) return set({ view: camera.moved(dx, dy) });
            const grown = Math.hypot(event.offsetX - other.x, event.offsetY - other.y) / Math.max(1, Math.hypot(before.x - other.x, before.y - other.y));
            set({ view: camera.zoomed(grown, sides.under(other.x).x, other.y, own.run.head) });
        });
        area.addEventListener("pointerup", event => {
            down.delete(event.pointerId);
            if (moved >= 4 || drive.takes(event.offsetX, event.offsetY)) return;
            const robot = robot_at(event.offsetX, event.offsetY);
            selection.choose(robot, event.shiftKey);
            if (robot >= 0 && state.robots.length === 2) set({ panel: "pair" });
            else if (robot >= 0 && state.panel !== "events") set({ panel: "robot" });
        });
        area.addEventListener("pointercancel", event => down.delete(event.pointerId));
    }

    /** Robot under a pixel of the canvas, or -1. @param {number} px @param {number} py */
    function robot_at(px, py) {
        const { i, x } = sides.under(px), r = sides.own.all[i].run, { t, storey } = selection.state;
        robots.place(r, t);
        const robot = robots.near(r, x, py, storey);
        robots.place(own.run, t);
        return robot;
    }

    /** @param {number} px @param {number} py */
    function hover(px, py) {
        const { i, x } = sides.under(px), level = coverage.level_at(sides.own.all[i].run, x, py);
        if (level) dom.by_id("status").textContent = level;
    }

    /** @param {State} state */
    function tell(state) {
        const head = own.run.head;
        dom.by_id("time").textContent = `${words.seconds(state.t, state.speed < 1e-3 ? 9 : 6)} s`;
        // All else stays as it is while only the time passes.
        if (!own.stale && state.playing && !live.is_live() && head.map.floors.length <= 1) return;
        own.stale = false;
        dom.by_id("present").hidden = !live.is_live();
        dom.by_id("present").textContent = live.text();
        dom.by_id("present").setAttribute("aria-pressed", String(live.goes_on() && live.follows()));
        dom.by_id("of-time").textContent = `of ${words.number(own.run.duration / run.nanoseconds)} s`;
        const speed = clock.speed_text(state.speed), slider = dom.input("speed");
        dom.by_id("speed-text").textContent = speed;
        if (Math.abs(Number(slider.value) - clock.power()) > 0.05) slider.value = String(clock.power());
        slider.setAttribute("aria-valuetext", speed);
        const play = dom.by_id("play");
        dom.by_id("play-shape").setAttribute("d", state.playing ? "M3 2h4v12H3zM9 2h4v12H9z" : "M3 2v12l11-6z");
        play.setAttribute("aria-label", state.playing ? "Pause" : "Play");
        dom.by_id("trails").setAttribute("aria-pressed", String(state.trails));
        dom.by_id("links").setAttribute("aria-pressed", String(state.links));
        dom.by_id("whole-time").hidden = !state.span;
        for (const panel of panels) {
            const chosen = panel === state.panel, tab = dom.by_id(`${panel}-tab`);
            dom.by_id(`${panel}-panel`).hidden = !chosen;
            tab.setAttribute("aria-selected", String(chosen));
            tab.tabIndex = chosen ? 0 : -1;
        }
        [...dom.by_id("storeys").children].slice(0, -1).forEach((tab, i) => {
            tab.setAttribute("aria-pressed", String(i === state.storey));
            const here = robots.at.storey.reduce((n, storey) => n + (storey === i ? 1 : 0), 0);
            tab.textContent = `Storey ${i + 1} \u00b7 ${words.counted(here, "robot")}`;
        });
        dom.by_id("storeys").lastElementChild?.setAttribute("aria-pressed", String(state.all));
        const chosen = state.robots.map(i => words.visible(own.run.name(i)));
        const label = `${words.seconds(state.t, 3)} s, ${words.counted(head.robots.length, "robot")}${chosen.length ? `, ${chosen.join(" and ")} selected` : ""}`;
        if (!state.playing) {
            dom.by_id("map").setAttribute("aria-label", `Map: ${sides.own.all[1] ? `${sides.title()}: ` : ""}${label}`);
            dom.by_id("timeline").setAttribute("aria-label", `Time line: ${words.seconds(state.t, 3)} of ${words.number(own.run.duration / run.nanoseconds)} s`);
            clearTimeout(own.resting);
            own.resting = setTimeout(() => {
                const seen = list.seen();
                dom.by_id("live").textContent = seen ? `${words.seconds(seen.time)} s: ${seen.text}` : "";
            }, 300);
        }
    }

    /** @param {boolean} whole whether all blocks were there */
    function status(whole) {
        const { shown } = flights, parts = [];
        if (!whole) parts.push("reading \u2026");
        if (own.note) parts.push(own.note);
        if (shown.frames) parts.push(words.counted(shown.frames, "frame"));
        if (shown.left_out) parts.push(`${words.counted(shown.left_out, "line")} not drawn`);
        dom.by_id("status").textContent = parts.join(" \u00b7 ");
    }

    /** @param {string} note */
    function say(note) {
        own.note = note;
        status(true);
    }

    /** @param {Run} r @param {Blocks} all */
    function show(r, all) { Object.assign(own, { run: r, blocks: all, stale: true }); }

    function begin() {
        selection.listen(changed => { if (changed.size > 1 || !changed.has("t")) own.stale = true; });
        buttons();
        pointers();
    }

    return { begin, show, tell, zoom, status, say };
})();
