// SPDX-License-Identifier: MIT
// The page: gets the run, draws when something has changed, answers tests.
const main = (() => {
    "use strict";
    const timeline_height = 86;
    /** @type {{run: Run|null, blocks: Blocks|null, waiting: boolean, frames: number, whole: boolean}} */
    const own = { run: null, blocks: null, waiting: false, frames: 0, whole: true };
    const parts = [list, timeline, message_panel, robot_panel, pair_panel, charts, links, coverage, controls, search, keys, filters];

    /** @param {string} text @returns {Uint8Array} */
    function from_base64(text) {
        const native = /** @type {any} */ (Uint8Array).fromBase64;
        return native ? native(text) : Uint8Array.from(atob(text), c => c.charCodeAt(0));
    }

    /** View file inside the page, or of the server. @param {string} name @returns {Promise<Uint8Array>} */
    async function bytes_of(name) {
        const embedded = document.getElementById(name), text = embedded?.textContent ?? "";
        embedded?.remove();
        if (text) {
            try {
                return from_base64(text);
            } catch {
                return rvw.refuse("The run in this page is damaged: it is no base64.");
            }
        }
        if (!location.protocol.startsWith("http")) return rvw.refuse("There is no run in this page.");
        return server.run_bytes(name);
    }

    /** @param {unknown} error */
    function show_error(error) {
        const notice = dom.by_id("notice");
        notice.hidden = false;
        notice.textContent = error instanceof rvw.ViewError ? error.message : `The run cannot be shown: ${error}`;
        hooks.error = notice.textContent;
        if (!own.run) dom.by_id("caption").textContent = "";
    }

    function resize() {
        const place = dom.by_id("place"), footer = /** @type {HTMLElement} */ (dom.by_id("timeline").parentElement);
        camera.now.width = Math.max(50, (place.clientWidth + 1) / sides.shown().length - 1);
        camera.now.height = Math.max(50, place.clientHeight);
        timeline.resize(footer.clientWidth - 32, timeline_height);
        redraw();
    }

    /** Draws the map of a run; true if all of its frames were there. @param {CanvasRenderingContext2D} c @param {number} i number of the run @param {number} nth from the left */
    function draw_map(c, i, nth) {
        const { run: r, blocks: all } = sides.own.all[i], state = sides.state_of(i), { width, height } = camera.now;
        c.save();
        c.translate(sides.left(nth), 0);
        c.beginPath();
        c.rect(0, 0, width, height);
        c.clip();
        robots.place(r, state.t);
        map.draw(c, r, state);
        antennas.draw(c, r, state);
        robots.begin(r, state);
        robots.trails(c, r, state);
        links.draw(c, state, i);
        const whole = flights.draw(c, all, state);
        message_panel.draw(c, compare.flood(i), state);
        pair_panel.draw(c, i, state);
        robots.draw(c, r, state);
        pair_panel.tell(c);
        compare.draw(c, selection.state);
        c.restore();
        return whole;
    }

    function draw() {
        own.waiting = false;
        const { run: r, blocks: all } = own, { state } = selection;
        if (!r || !all) return;
        camera.aim(state, r.head);
        flights.begin();
        compare.update(state);
        list.play();  // first of all panels: it asks where it is scrolled to, which is costly once others have changed the page
        const maps = sides.shown(), c = dom.sized(dom.canvas("map"), sides.left(maps.length) - sides.left(1) + camera.now.width, camera.now.height);
        const whole = maps.map((i, nth) => draw_map(c, i, nth)).every(Boolean);
        if (maps.length > 1) {
            c.fillStyle = theme.colors().line;
            c.fillRect(sides.left(1) - 1, 0, 1, camera.now.height);
            robots.place(r, state.t);
        }
        timeline.draw();
        controls.tell(state);
        sides.tell();
        controls.status(whole);
        if (live.is_live()) introduce();
        filters.update(state);
        message_panel.update(state);
        robot_panel.update(state);
        links.update(state);
        charts.update(state);
        pair_panel.update(state);
        legend.draw(r, all, state);
        own.frames++;
        own.whole = whole;
    }

    /** Draws once, with the next frame of the screen. */
    function redraw() {
        if (own.waiting) return;
        own.waiting = true;
        requestAnimationFrame(draw);
    }

    /** Heading, and sentences about what is missing. */
    function introduce() {
        const { all } = sides.own, [{ run: { head, duration } }] = all, is_one = all.length === 1;
        const title = all.map(side => side.label).join(" | ");
        document.title = `${title} \u00b7 rovernet`;
        dom.by_id("name").textContent = dom.by_id("name").title = title;
        /** @param {Side} side @param {string} text */
        const of_run = (side, text) => is_one ? text : `${side.label[0]}: ${text}`;
        dom.by_id("caption").textContent = [words.counted(head.robots.length, "robot"), `${words.number(duration / run.nanoseconds)} s`,
            ...(is_one ? sides.counts(head) : []), `rovernet ${head.version.split(" ")[0]}`].join(" \u00b7 ");
        const told = all.flatMap(side => [...side.run.head.thinned, ...side.run.head.damage].map(text => of_run(side, text))), state = live.state();
        if (state?.left_out) told.push(`Left out: ${words.counted(state.left_out, "frame")} of the begin of the run.`);
        dom.by_id("notice").hidden = told.length === 0;
        dom.by_id("notice").textContent = told.join(" ");
    }

    /** @param {Uint8Array} bytes @returns {Promise<Side>} */
    async function side_of(bytes) {
        const r = await run.load(rvw.open(bytes)), all = new blocks.Blocks(r);
        all.arrived = redraw;
        all.failed = show_error;
        return { run: r, blocks: all, label: words.visible(r.head.name) };
    }

    /** Lets the panels tell of the run that leads. */
    function show_lead() {
        const { run: r, blocks: all } = sides.own.all[sides.lead()];
        if (own.run === r) return;
        Object.assign(own, { run: r, blocks: all });
        for (const part of parts) part.show(r, all);
    }

    /** @param {Uint8Array} bytes @param {Uint8Array} [other] second run */
    async function open(bytes, other) {
        const all = [await side_of(bytes)];
        if (other) all.push(await side_of(other));
        const r = all[0].run, same = other ? await compare.load(all) : [];
        signs.look.colors = r.head.colors;
        sides.begin(all, same);
        clock.begin(r.duration);
        introduce();
        address.begin();
        show_lead();
        for (const part of [list, timeline, controls, search, keys]) part.begin();
        for (const part of [message_panel, pair_panel, compare]) part.begin(redraw);
        coverage.begin(redraw, controls.say);
        links.begin(redraw, controls.say);
        live.begin(r, all[0].blocks);
        selection.listen(changed => {
            if (changed.has("t")) timeline.keep();
            if (changed.has("runs")) {
                show_lead();
                resize();
            }
            redraw();
        });
        theme.on_change(redraw);
        new ResizeObserver(resize).observe(dom.by_id("place"));
        resize();
        hooks.ready = true;
    }

    /** Opens what is in the page, or what its server has. */
    async function open_recorded() {
        const has_other = document.getElementById("other");
        await open(await bytes_of("run"), has_other ? await bytes_of("other") : undefined);
    }

    /** What tests see and do. */
    const hooks = {
        parts: { antennas, camera, clock, coverage, files, floods, links, live, robots, server, sides, signs, theme },
        ready: false, error: "",
        get t() { return selection.state.t; },
        get state() { return selection.state; },
        get frames() { return own.frames; },
        get whole() { return own.whole; },
        seek: clock.seek,
        select: selection.set,
        /** @param {number} robot */
        position(robot) { return own.run?.pose(robot, selection.state.t); },
        list: list.seen,
        density: timeline.columns,
        charts: charts.values
    };
    Object.defineProperty(window, "rovernet", { value: hooks });

    if (document.getElementById("goes-on")) live.watch(open, redraw, show_error);
    else open_recorded().catch(show_error);
    return { redraw };
})();
