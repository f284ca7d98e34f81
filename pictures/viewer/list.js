// SPDX-License-Identifier: MIT
// List of events: only the rows that are in sight are elements. Its first row is the last event until now.
const list = (() => {
    "use strict";
    const row_height = 22, spare = 3, most_kept = 3, moment_ms = 120;
    const pause_ms = 100, long_pause_ms = 250;  // between two pictures of a run that plays; the long one if nobody can follow its rows
    const highest = 8e6;  // [px] that browsers lay out exactly
    /** @type {{run: Run, blocks: Blocks, window: EventList|null, rows: Uint32Array, filter: Filter|null, kept: Map<number, EventList>, filtered: WeakMap<EventList, {filter: Filter, rows: Uint32Array}>, timer: number, awaited: number, height: number, top: number, drawn: number, chosen: number}} */
    const own = { run: /** @type {any} */ (null), blocks: /** @type {any} */ (null), window: null, rows: new Uint32Array(0), filter: null, kept: new Map(), filtered: new WeakMap(), timer: 0, awaited: -1, height: 0, top: 0, drawn: 0, chosen: -1 };

    /** @param {EventList} window */
    function keep(window) {
        own.kept.set(window.number, window);
        const oldest = own.kept.keys().next().value;
        if (own.kept.size > most_kept && oldest !== undefined) own.kept.delete(oldest);
        return window;
    }

    /** Puts the events of another block in order when the time has stayed there a moment. @param {Run} r @param {number} number @param {Block|null} block @param {Block|null} before */
    function settle(r, number, block, before) {
        if (own.awaited === number) return;
        clearTimeout(own.timer);
        own.awaited = number;
        own.timer = setTimeout(() => {
            own.awaited = -1;
            keep(events.window_of(r, number, block, before));
            own.blocks.arrived();
        }, moment_ms);
    }

    /** Takes the events around a time; false if they are still on their way. @param {number} t */
    function update(t) {
        const { run: r, blocks: all } = own, number = all.at(t), some = all.info.length > 0 && all.info[number].flights > 0;
        const block = some ? all.get(number) : null, before = number > 0 ? all.get(number - 1) : null;
        if (block === undefined || before === undefined) return false;
        if (own.window?.number !== number) {
            const there = own.kept.get(number);
            if (!there && own.window) {
                settle(r, number, block, before);
                return false;
            }
            own.window = there ?? keep(events.window_of(r, number, block, before));
            own.filter = null;
        }
        if (own.filter !== selection.state.filter) {
            own.filter = selection.state.filter;
            const before_this = own.filtered.get(own.window);
            own.rows = before_this?.filter === own.filter ? before_this.rows : events.filtered(r, own.window, own.filter);
            own.filtered.set(own.window, { filter: own.filter, rows: own.rows });
            rendered.first = -1;
            rendered.followed = -2;
        }
        return true;
    }

    /** Events of the block before, if its data are there. @param {EventList} w */
    function before({ number }) {
        const n = number - 1, block = n >= 0 && own.blocks.get(n), earlier = n > 0 ? own.blocks.get(n - 1) : null;
        return own.kept.get(n) ?? (block && earlier !== undefined ? keep(events.window_of(own.run, n, block, earlier)) : null);
    }

    /** Index of the last row until a time, -1 if there is none. @param {number} t */
    function row_at(t) {
        const { rows, window: w } = own;
        return w ? run.count_until(rows, run.count_until(w.time, t) - 1) - 1 : -1;
    }

    const rendered = { first: -1, current: -2, followed: -2, shift: 0, leaps: false };

    /** A row without an event. */
    function row() {
        const out = dom.make("div", "row", ...["when", "mark", "what"].map(kind => dom.make("span", kind, " ")));
        out.setAttribute("role", "option");
        return out;
    }

    /** Rows are made once and filled again and again. @param {HTMLElement} out @param {number} i row @param {number} current @param {number} shift [px] */
    function fill(out, i, current, shift) {
        const { run: r, rows } = own, w = /** @type {EventList} */ (own.window), event = rows[i], { sign } = events.about(r, w, event);
        const [when, mark, what] = /** @type {any} */ (out.children), text = events.text(r, w, event);
        when.firstChild.data = words.seconds(w.time[event]);
        mark.firstChild.data = sign >= 0 ? signs.kinds[sign].mark : w.kind[event] === events.frame ? "\u2197" : "";
        mark.style.color = sign >= 0 ? signs.color(sign) : "";
        what.firstChild.data = text;
        out.id = `event${i}`;
        out.ariaSelected = String(i === current);
        out.style.transform = `translateY(${i * row_height - shift}px)`;
    }

    /** @param {HTMLElement} space @param {number} first @param {number} count @param {number} current @param {number} shift [px] */
    function fill_all(space, first, count, current, shift) {
        while (space.childElementCount > count) space.lastChild?.remove();
        while (space.childElementCount < count) space.append(row());
        let i = first;
        for (const each of space.children) fill(/** @type {HTMLElement} */ (each), i++, current, shift);
    }

    /** Rows follow a run that plays. */
    function play() {
        if (!selection.state.playing || performance.now() - own.drawn >= (rendered.leaps ? long_pause_ms : pause_ms)) draw(true);
    }

    /** @param {boolean} follow whether the current event comes to the top */
    function draw(follow) {
        own.drawn = performance.now();
        const box = dom.by_id("events"), space = dom.by_id("events-space"), { t } = selection.state;
        if (!update(t)) {
            dom.by_id("events-count").textContent = "reading \u2026";
            return;
        }
        if (own.height === 0) {
            rendered.followed = -2;  // a hidden list forgets where it was
            return;
        }
        const current = row_at(t), { height } = own, total = own.rows.length * row_height + Math.max(0, height - row_height);
        const room = Math.min(highest, total), ratio = Math.max(1, total - height) / Math.max(1, room - height);
        space.style.height = `${room}px`;
        if (follow && current !== rendered.followed) {
            rendered.followed = current;
            box.scrollTop = Math.max(0, current) * row_height / ratio;
        }
        own.top = box.scrollTop;
        const offset = own.top * ratio, shift = offset - own.top;
        const first = Math.max(0, Math.floor(offset / row_height) - spare);
        const last = Math.min(own.rows.length, first + Math.ceil(height / row_height) + 2 * spare);
        if (first !== rendered.first || current !== rendered.current || shift !== rendered.shift) {
            fill_all(space, first, Math.max(0, last - first), current, shift);
            Object.assign(rendered, { leaps: Math.abs(first - rendered.first) > last - first, first, current, shift });
        }
        if (current >= first && current < last) box.setAttribute("aria-activedescendant", `event${current}`);
        else box.removeAttribute("aria-activedescendant");
        const part = own.blocks.info.length > 1 ? `, part ${own.blocks.at(t) + 1} of ${own.blocks.info.length} of the run` : "";
        dom.by_id("events-count").textContent = own.rows.length === 0
            ? (own.window?.time.length ? "no event passes the filter" : "no events") + part
            : `${words.counted(own.rows.length, "event")}${part}`;
    }

    /** Goes to the next event that passes, or to the one before. @param {1|-1} direction @param {(event: number, w: EventList) => boolean} [passes] */
    async function step(direction, passes = () => true) {
        const { run: r, blocks: all } = own, t = selection.state.t;
        for (let n = all.at(t); n >= 0 && n < Math.max(1, all.info.length); n += direction) {
            const block = all.info[n]?.flights ? await all.load(n) : null, before = n > 0 ? await all.load(n - 1) : null;
            const w = own.window?.number === n ? own.window : events.window_of(r, n, block, before);
            const rows = own.window === w ? own.rows : events.filtered(r, w, selection.state.filter);
            for (let i = direction > 0 ? 0 : rows.length - 1; i >= 0 && i < rows.length; i += direction) {
                const away = (w.time[rows[i]] - t) * direction;
                if (away > 0 && passes(rows[i], w)) return clock.seek(w.time[rows[i]]);
            }
        }
        if (direction > 0) live.step();
    }

    /** Event of the row that the pointer is on, or -1. @param {MouseEvent} event */
    function event_at({ target }) {
        const row = target instanceof Element ? target.closest(".row") : null;
        return row && own.window ? own.rows[Number(row.id.slice(5))] : -1;
    }

    /** The exact time of a row, and its text, of which the end may be cut off. @param {MouseEvent} event */
    function pointed(event) {
        const at = event_at(event), w = own.window;
        dom.by_id("events-space").title = at >= 0 && w ? `${words.seconds(w.time[at], 9)} s: ${events.text(own.run, w, at)}` : "";
    }

    /** @param {MouseEvent} event */
    function clicked(event) {
        if (event.detail !== 2) own.chosen = event_at(event);  // the first click has moved the rows
        const at = own.chosen;
        if (at < 0 || !own.window) return;
        const { message, who } = events.about(own.run, own.window, at);
        clock.seek(own.window.time[at]);
        if (event.detail === 2 && message >= 0 && message < own.run.messages) selection.set({ message, panel: "message" });
        else if (who >= 0) selection.choose(who);
    }

    /** Tells of another run. @param {Run} r @param {Blocks} all */
    function show(r, all) {
        clearTimeout(own.timer);
        own.kept.clear();
        Object.assign(own, { run: r, blocks: all, window: null, rows: new Uint32Array(0) });
    }

    function begin() {
        dom.by_id("events").addEventListener("scroll", () => {
            if (dom.by_id("events").scrollTop !== own.top) draw(false);
        });
        new ResizeObserver(() => {
            own.height = dom.by_id("events").clientHeight;
            draw(true);
        }).observe(dom.by_id("events"));
        dom.on_click("events", clicked);
        dom.by_id("events").addEventListener("mouseover", pointed);
    }

    /** The events of the last block are more than before. */
    function renew() {
        const last = own.blocks.info.length - 1;
        for (const number of own.kept.keys()) if (number >= last - 1) own.kept.delete(number);
        if (own.window && own.window.number >= last - 1) own.window = null;
    }

    /** First row in sight and the one of the time, for tests. */
    function seen() {
        const current = row_at(selection.state.t), w = own.window;
        return current < 0 || !w || w.number !== own.blocks.at(selection.state.t) ? null : { time: w.time[own.rows[current]], text: events.text(own.run, w, own.rows[current]), rows: own.rows.length };
    }

    return { begin, show, play, step, before, renew, seen, own };
})();
