// SPDX-License-Identifier: MIT
// Links between robots: by margin, as the server tells, or those that the trace has seen come up.
/** @typedef {{from: number, to: number, margin: number|null, two_way: boolean}} LinkLine */
/** @typedef {{run: Run, i: number, timer: number, busy: boolean, lines: LinkLine[], key: string, failed: string, t: number, at: number, up: Set<number>}} Lines */
const links = (() => {
    "use strict";
    const rest_ms = 200, head = 7, gap = 2, scale = 26;  // [px]
    /** @type {{changed: () => void, say: (text: string) => void, of: Lines[], version: number, away: number}} */
    const own = { changed: () => {}, say: () => {}, of: [], version: 0, away: 0 };

    /** Lines of a run. @param {number} i its number @returns {Lines} */
    function lines_on(i) {
        return own.of[i] ??= { run: sides.own.all[i].run, i, timer: 0, busy: false, lines: [], key: "", failed: "", t: -1, at: 0, up: new Set() };
    }

    /** Robot whose links are shown, or -1: all. @param {State} state */
    function chosen(state) { return state.robots.at(-1) ?? -1; }
    /** @param {State} state */
    function key_of(state) { return `${chosen(state)} ${state.t}`; }

    /** @param {any} a answer @returns {LinkLine[]} */
    function lines_of(a) {
        const { from, to, two_way, margin_db: there, back_margin_db: back } = a;
        return from.map((/** @type {number} */ _, /** @type {number} */ i) => ({
            from: from[i], to: to[i], two_way: two_way[i] === true,
            margin: there[i] === null || two_way[i] && back[i] === null ? null : Math.min(there[i], back[i] ?? Infinity)
        }));
    }

    /** @param {Lines} of */
    async function ask(of) {
        const { state } = selection, key = key_of(state), robot = chosen(state), { t } = state;
        of.timer = 0;
        if (of.busy || !state.links) return;
        of.busy = true;
        try {
            const t_ns = Math.floor(t);
            const answer = await sides.ask("links", robot < 0 ? { t_ns } : { t_ns, robot }, of.i);
            of.lines = lines_of(answer);
            if (of.failed) own.say("");
            [of.key, of.t, of.failed] = [key, answer.t_ns ?? t, ""];
        } catch (error) {
            of.lines = [];
            [of.key, of.failed] = ["", key];
            own.say(/** @type {Error} */ (error).message);
        }
        of.busy = false;
        own.version++;
        own.changed();
    }

    /** Asks when the time rests; while it passes, when the last answer is there. @param {State} state */
    function update(state) {
        const key = key_of(state);
        if (!state.links || !server.is_served()) return;
        for (const of of sides.shown().map(lines_on)) {
            if (of.busy || key === of.key || key === of.failed || state.playing && of.timer) continue;
            clearTimeout(of.timer);
            of.timer = setTimeout(() => ask(of), rest_ms);
        }
    }

    /** Links that are up at a time by the changes that the trace has. @param {Lines} of @param {number} t */
    function follow(of, t) {
        const r = of.run, time = r.col("links.time"), until = run.count_until(time, t);
        if (until === of.at) return;
        if (until < of.at) {
            of.at = 0;
            of.up.clear();
        }
        const from = r.col("links.from"), to = r.col("links.to"), up = r.col("links.up");
        for (; of.at < until; of.at++) {
            const link = from[of.at] * r.robots + to[of.at];
            if (up[of.at]) of.up.add(link); else of.up.delete(link);
        }
        of.lines = [];
        for (const link of of.up) {
            const [a, b] = [Math.floor(link / r.robots), link % r.robots], two_way = of.up.has(b * r.robots + a);
            if (!two_way || a < b) of.lines.push({ from: a, to: b, margin: null, two_way });
        }
        own.version++;
    }

    /** Whether the trace tells links, and no server. @param {Lines} of */
    function by_trace(of) { return !server.is_served() && Boolean(of.run.columns["links.time"]?.length); }

    /** Lines to be drawn on the map of a run. @param {State} state @param {number} [i] its number @returns {LinkLine[]} */
    function shown(state, i = sides.lead()) {
        const one = chosen(state), { storey } = robots.at;
        const seen = lines_on(i).lines.filter(l => one < 0 || l.from === one || l.to === one);
        const here = seen.filter(l => storey[l.from] === state.storey && storey[l.to] === state.storey);
        own.away = seen.filter(l => storey[l.from] === state.storey || storey[l.to] === state.storey).length - here.length;
        return here;
    }

    /** Width and colour of a line. @param {number|null} margin */
    function look(margin) {
        const grades = signs.look.colors.links;
        if (margin === null) return { width: 2, color: theme.readable(signs.look.colors.ember[8]) };
        const grade = [...grades].reverse().find(g => margin >= g.from_db) ?? grades[0];
        return { width: grade.width, color: theme.readable(grade.color) };
    }

    /** @param {CanvasRenderingContext2D} c @param {number} x0 @param {number} y0 @param {number} x1 @param {number} y1 @param {number} room [px] before the end @param {LinkLine} l */
    function line(c, x0, y0, x1, y1, room, l) {
        const { width, color } = look(l.margin), length = Math.hypot(x1 - x0, y1 - y0) || 1, ux = (x1 - x0) / length, uy = (y1 - y0) / length;
        pen.take(c, c.fillStyle = color, width, l.two_way ? [] : [7, 4]);
        pen.line(c, x0, y0, x1, y1);
        if (l.two_way) return;
        const x = x1 - ux * (room + gap), y = y1 - uy * (room + gap), half = width + 2;
        c.beginPath();
        c.moveTo(x, y);
        c.lineTo(x - head * ux - half * uy, y - head * uy + half * ux);
        c.lineTo(x - head * ux + half * uy, y - head * uy - half * ux);
        c.fill();
    }

    /** @param {CanvasRenderingContext2D} c @param {State} state @param {number} i number of the run */
    function draw(c, state, i) {
        if (!state.links) return;
        const of = lines_on(i), { x, y } = robots.at, traced = by_trace(of);
        if (traced) follow(of, state.t);
        c.globalAlpha = traced || of.t === state.t || live.follows() ? 0.9 : 0.35;
        const all = shown(state, i);
        for (const l of all.sort((a, b) => (a.margin ?? 0) - (b.margin ?? 0))) line(c, x[l.from], y[l.from], x[l.to], y[l.to], robots.radius(of.run, l.to), l);
        c.globalAlpha = 1;
    }

    /** Lines of all margins, with their limits below. @param {CanvasRenderingContext2D} c */
    function scale_of(c) {
        c.font = pen.font(9);
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
        const maps = sides.shown(), { t } = lines_on(maps[0]), traced = maps.some(i => by_trace(lines_on(i)));
        if (!server.is_served() && !traced) return [];
        const all = maps.flatMap(i => shown(state, i)), out = [], some = all.find(l => l.margin === null), single = all.find(l => !l.two_way);
        const when = traced ? "up in the trace" : t < 0 ? "asked \u2026" : `at ${words.seconds(t, 3)} s`;
        if (!traced && (!some || all.some(l => l.margin !== null))) out.push(item(scale * 5 + 16, scale_of, `link margin [dB] ${when}`));
        if (some) out.push(item(24, c => line(c, 0, 8, 24, 8, 0, { from: 0, to: 0, margin: null, two_way: true }), `link ${when}`));
        if (single) out.push(item(30, c => line(c, 0, 8, 30, 8, 0, single), "one way only"));
        if (own.away) out.push(item(1, () => {}, words.counted(own.away, "link") + " to other storeys"));
        return out;
    }

    /** @param {() => void} changed @param {(text: string) => void} say */
    function begin(changed, say) { Object.assign(own, { changed, say }); }

    /** The runs that are shown have changed: what was asked stays. */
    function show() {}

    /** Shows links, or takes them away. */
    function toggle() {
        const on = !selection.state.links;
        if (on && !server.is_served() && !sides.shown().some(i => by_trace(lines_on(i)))) own.say(`The trace has no links: record it with \u201c--set trace.links=true\u201d, or open the run by \u201crovernet view RUN\u201d.`);
        else own.say("");
        for (const of of own.of) if (of) of.failed = "";
        selection.set({ links: on });
    }

    return { begin, show, update, draw, legend, toggle, shown, look, version: () => own.version };
})();
