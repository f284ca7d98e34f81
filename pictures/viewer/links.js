// SPDX-License-Identifier: MIT
// Links between robots: by margin, as the server tells, or those that the trace has seen come up.
/** @typedef {{from: number, to: number, margin: number|null, two_way: boolean}} LinkLine */
const links = (() => {
    "use strict";
    const rest_ms = 200, head = 7, gap = 2, scale = 26;  // [px]
    /** @type {{run: Run, changed: () => void, say: (text: string) => void, timer: number, busy: boolean, lines: LinkLine[], key: string, failed: string, t: number, version: number, at: number, up: Set<number>, away: number}} */
    const own = { run: /** @type {any} */ (null), changed: () => {}, say: () => {}, timer: 0, busy: false, lines: [], key: "", failed: "", t: -1, version: 0, at: 0, up: new Set(), away: 0 };

    /** Robot whose links are shown, or -1: all. @param {State} state */
    function chosen(state) { return state.robots.at(-1) ?? -1; }
    /** @param {State} state */
    function key_of(state) { return `${sides.lead()} ${chosen(state)} ${state.t}`; }

    /** @param {any} a answer @returns {LinkLine[]} */
    function lines_of(a) {
        const { from, to, two_way, margin_db: there, back_margin_db: back } = a;
        return from.map((/** @type {number} */ _, /** @type {number} */ i) => ({
            from: from[i], to: to[i], two_way: two_way[i] === true,
            margin: there[i] === null || two_way[i] && back[i] === null ? null : Math.min(there[i], back[i] ?? Infinity)
        }));
    }

    async function ask() {
        const { state } = selection, key = key_of(state), robot = chosen(state), { t } = state;
        own.timer = 0;
        if (own.busy || !state.links) return;
        own.busy = true;
        try {
            const t_ns = Math.floor(t);
            const answer = await sides.ask("links", robot < 0 ? { t_ns } : { t_ns, robot });
            own.lines = lines_of(answer);
            if (own.failed) own.say("");
            [own.key, own.t, own.failed] = [key, answer.t_ns ?? t, ""];
        } catch (error) {
            own.lines = [];
            [own.key, own.failed] = ["", key];
            own.say(error instanceof Error ? error.message : String(error));
        }
        own.busy = false;
        own.version++;
        own.changed();
    }

    /** Asks when the time rests; while it passes, when the last answer is there. @param {State} state */
    function update(state) {
        const key = key_of(state);
        if (!state.links || !server.is_served() || own.busy || key === own.key || key === own.failed) return;
        if (state.playing && own.timer) return;
        clearTimeout(own.timer);
        own.timer = setTimeout(ask, rest_ms);
    }

    /** Links that are up at a time by the changes that the trace has. @param {number} t */
    function follow(t) {
        const r = own.run, time = r.col("links.time"), until = run.count_until(time, t);
        if (until === own.at) return;
        if (until < own.at) {
            own.at = 0;
            own.up.clear();
        }
        const from = r.col("links.from"), to = r.col("links.to"), up = r.col("links.up");
        for (; own.at < until; own.at++) {
            const link = from[own.at] * r.robots + to[own.at];
            if (up[own.at]) own.up.add(link); else own.up.delete(link);
        }
        own.lines = [];
        for (const link of own.up) {
            const [a, b] = [Math.floor(link / r.robots), link % r.robots], two_way = own.up.has(b * r.robots + a);
            if (!two_way || a < b) own.lines.push({ from: a, to: b, margin: null, two_way });
        }
        own.version++;
    }

    /** Whether the trace tells links, and no server. */
    function by_trace() { return !server.is_served() && Boolean(own.run.columns["links.time"]?.length); }

    /** Lines to be drawn. @param {State} state @returns {LinkLine[]} */
    function shown(state) {
        const one = chosen(state), { storey } = robots.at;
        const seen = own.lines.filter(l => one < 0 || l.from === one || l.to === one);
        const here = seen.filter(l => storey[l.from] === state.storey && storey[l.to] === state.storey);
        own.away = seen.filter(l => storey[l.from] === state.storey || storey[l.to] === state.storey).length - here.length;
        return here;
    }

    /** Width and colour of a line. @param {number|null} margin */
    function look(margin) {
        const grades = signs.look.colors.links;
        if (margin === null) return { width: 2, color: theme.readable(signs.look.colors.ember[8] ?? "#cc0000") };
        const grade = [...grades].reverse().find(g => margin >= g.from_db) ?? grades[0];
        return { width: grade.width, color: theme.readable(grade.color) };
    }

    /** @param {CanvasRenderingContext2D} c @param {number} x0 @param {number} y0 @param {number} x1 @param {number} y1 @param {number} room [px] before the end @param {LinkLine} l */
    function line(c, x0, y0, x1, y1, room, l) {
        const { width, color } = look(l.margin), length = Math.hypot(x1 - x0, y1 - y0) || 1, ux = (x1 - x0) / length, uy = (y1 - y0) / length;
        c.strokeStyle = c.fillStyle = color;
        c.lineWidth = width;
        c.setLineDash(l.two_way ? [] : [7, 4]);
        c.beginPath();
        c.moveTo(x0, y0);
        c.lineTo(x1, y1);
        c.stroke();
        if (l.two_way) return;
        const x = x1 - ux * (room + gap), y = y1 - uy * (room + gap), half = width + 2;
        c.beginPath();
        c.moveTo(x, y);
        c.lineTo(x - head * ux - half * uy, y - head * uy + half * ux);
        c.lineTo(x - head * ux + half * uy, y - head * uy - half * ux);
        c.fill();
    }

    /** @param {CanvasRenderingContext2D} c @param {State} state */
    function draw(c, state) {
        if (!state.links) return;
        if (by_trace()) follow(state.t);
        const { x, y } = robots.at;
        c.globalAlpha = by_trace() || own.t === state.t || live.follows() ? 0.9 : 0.35;
        const all = shown(state);
        for (const l of all.sort((a, b) => (a.margin ?? 0) - (b.margin ?? 0))) line(c, x[l.from], y[l.from], x[l.to], y[l.to], robots.radius(own.run, l.to), l);
        c.setLineDash([]);
        c.globalAlpha = 1;
    }

    /** Lines of all margins, with their limits below. @param {CanvasRenderingContext2D} c */
    function scale_of(c) {
        c.font = `8px ${robots.font}`;
        c.textAlign = "center";
        signs.look.colors.links.forEach((grade, i) => {
            c.fillStyle = theme.readable(grade.color);
            c.fillRect(8 + i * scale, 4 - grade.width / 2, scale, grade.width);
            c.fillStyle = theme.colors().ink;
            c.fillText(String(grade.from_db), 8 + i * scale, 15);
        });
    }

    /** @param {Item} item @param {State} state */
    function legend(item, state) {
        if (!state.links) return [];
        if (!server.is_served() && !by_trace()) return [];
        const all = shown(state), out = [], some = all.find(l => l.margin === null), single = all.find(l => !l.two_way);
        const when = by_trace() ? "up by the trace" : own.t < 0 ? "asked \u2026" : `at ${words.seconds(own.t, 3)} s`;
        if (!by_trace() && (!some || all.some(l => l.margin !== null))) out.push(item(scale * 5 + 16, scale_of, `link margin [dB] ${when}`, "Level above the receiver's sensitivity, of the weaker direction"));
        if (some) out.push(item(24, c => line(c, 0, 8, 24, 8, 0, { from: 0, to: 0, margin: null, two_way: true }), `link ${when}`));
        if (single) out.push(item(30, c => line(c, 0, 8, 30, 8, 0, single), "one way only"));
        if (own.away) out.push(item(1, () => {}, words.counted(own.away, "link") + " to other storeys"));
        return out;
    }

    /** @param {() => void} changed @param {(text: string) => void} say */
    function begin(changed, say) { Object.assign(own, { changed, say }); }

    /** @param {Run} r */
    function show(r) { Object.assign(own, { run: r, lines: [], key: "", failed: "", t: -1, at: 0, up: new Set() }); }

    /** Shows links, or takes them away. */
    function toggle() {
        const on = !selection.state.links;
        if (on && !server.is_served() && !by_trace()) own.say(`The trace tells no links: record it with \u201c--set trace.links=true\u201d, or open it by \u201crovernet view\u201d.`);
        else own.say("");
        own.failed = "";
        selection.set({ links: on });
    }

    return { begin, show, update, draw, legend, toggle, shown, look, version: () => own.version };
})();
