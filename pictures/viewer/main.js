// SPDX-License-Identifier: MIT
// The page: gets the run, draws when something has changed, answers tests.
const main = (() => {
    "use strict";
    const kept_times = 300, timeline_height = 86;
    /** @type {{run: Run|null, blocks: Blocks|null, waiting: boolean, frames: number, script: number[], whole: boolean}} */
    const own = { run: null, blocks: null, waiting: false, frames: 0, script: [], whole: true };

    /** @param {string} text @returns {Uint8Array} */
    function from_base64(text) {
        const plain = text.trim(), native = /** @type {any} */ (Uint8Array).fromBase64;
        if (native) return native(plain);
        const characters = atob(plain), out = new Uint8Array(characters.length);
        for (let i = 0; i < out.length; i++) out[i] = characters.charCodeAt(i);
        return out;
    }

    /** @returns {Promise<Uint8Array>} */
    async function bytes_of_run() {
        const embedded = document.getElementById("run");
        if (embedded) {
            const text = embedded.textContent ?? "";
            embedded.remove();
            try {
                return from_base64(text);
            } catch {
                return rvw.refuse("The run in this page is damaged: it is no base64.");
            }
        }
        if (!location.protocol.startsWith("http")) return rvw.refuse("There is no run in this page.");
        return server.run_bytes();
    }

    /** @param {unknown} error */
    function show_error(error) {
        const notice = dom.by_id("notice");
        notice.hidden = false;
        notice.textContent = error instanceof rvw.ViewError ? error.message : `The run cannot be shown: ${error instanceof Error ? error.message : error}`;
        hooks.error = notice.textContent;
    }

    function resize() {
        const place = dom.by_id("place"), footer = dom.by_id("timeline").parentElement;
        camera.now.width = Math.max(50, place.clientWidth);
        camera.now.height = Math.max(50, place.clientHeight);
        timeline.resize((footer?.clientWidth ?? 300) - 32, timeline_height);
        redraw();
    }

    function draw() {
        own.waiting = false;
        const { run: r, blocks: all } = own, { state } = selection;
        if (!r || !all) return;
        const begin = performance.now();
        camera.aim(state, r.head);
        robots.place(r, state.t);
        const c = dom.sized(dom.canvas("map"), camera.now.width, camera.now.height);
        map.draw(c, r, state);
        robots.trails(c, r, state);
        links.draw(c, state);
        const whole = flights.draw(c, all, state);
        message_panel.draw(c, state);
        pair_panel.draw(c, state);
        robots.draw(c, r, state);
        timeline.draw();
        controls.tell(state);
        controls.status(whole);
        filters.update(state);
        list.draw(true);
        message_panel.update(state);
        robot_panel.update(state);
        links.update(state);
        charts.update(state);
        pair_panel.update(state);
        legend.draw(r, all, state);
        own.frames++;
        own.whole = whole;
        own.script.push(performance.now() - begin);
        if (own.script.length > kept_times) own.script.shift();
    }

    /** Draws once, with the next frame of the screen. */
    function redraw() {
        if (own.waiting) return;
        own.waiting = true;
        requestAnimationFrame(draw);
    }

    /** @param {Head} head */
    function introduce(head) {
        document.title = `${words.visible(head.name)} \u00b7 rovernet`;
        dom.by_id("name").textContent = words.visible(head.name);
        const parts = [words.counted(head.robots.length, "robot"), `${words.number(head.duration_ns / run.nanoseconds)} s`, `seed ${head.seed}`];
        if (head.replication) parts.push(`replication ${head.replication}`);
        parts.push(words.counted(head.counts.messages, "message"), words.counted(head.counts.flights, "frame"), words.counted(head.counts.receptions, "reception"), `rovernet ${head.version.split(" ")[0]}`);
        dom.by_id("caption").textContent = parts.join(" \u00b7 ");
        const told = [...head.thinned, ...head.damage];
        dom.by_id("notice").hidden = told.length === 0;
        dom.by_id("notice").textContent = told.join(" ");
    }

    /** @param {Uint8Array} bytes */
    async function open(bytes) {
        const file = rvw.open(bytes), r = own.run = await run.load(file), all = own.blocks = new blocks.Blocks(r);
        signs.look.colors = r.head.colors;
        all.arrived = redraw;
        all.failed = show_error;
        clock.begin(r.duration);
        introduce(r.head);
        for (const part of [list, timeline, robot_panel, controls]) part.begin(r, all);
        for (const part of [search, keys, filters, charts]) part.begin(r);
        message_panel.begin(r, all, redraw);
        pair_panel.begin(r, redraw);
        coverage.begin(r, redraw, controls.say);
        links.begin(r, redraw, controls.say);
        address.begin(r);
        selection.listen(changed => {
            if (changed.has("t")) timeline.keep();
            redraw();
        });
        theme.on_change(redraw);
        new ResizeObserver(resize).observe(dom.by_id("place"));
        resize();
        hooks.ready = true;
    }

    /** What tests see and do. */
    const hooks = {
        ready: false, error: "",
        get version() { return own.run?.head.version ?? ""; },
        get t() { return selection.state.t; },
        get state() { return selection.state; },
        get frames() { return own.frames; },
        get scriptMs() { return own.script; },
        get thinned() { return flights.shown.left_out; },
        get whole() { return own.whole; },
        seek: clock.seek,
        select: selection.set,
        /** @param {number} robot */
        position(robot) { return own.run?.pose(robot, selection.state.t, { x: 0, y: 0, z: 0, vx: 0, vy: 0, heading: 0 }); },
        list: list.seen,
        density: timeline.columns,
        charts: charts.values, levels: coverage.levels,
        /** @param {number} robot */
        pixel: robot => [robots.at.x[robot], robots.at.y[robot]],
        links: () => selection.state.links ? links.shown(selection.state).map(l => ({ ...l, ...links.look(l.margin) })) : [],
        /** @param {number} uid @param {number} robot */
        async outcome(uid, robot) {
            const { run: r, blocks: all } = own, message = r?.by_uid.get(uid);
            return r && all && message !== undefined ? floods.outcome(r, await floods.of(r, all, message), robot) : "unknown";
        }
    };
    Object.defineProperty(window, "rovernet", { value: hooks });

    bytes_of_run().then(open).catch(show_error);
    return { redraw };
})();
