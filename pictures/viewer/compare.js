// SPDX-License-Identifier: MIT
// Two runs compared: deliveries that B gains and loses against A, as the view file of B tells them.
/** @typedef {{runs: string[], gained: number, lost: number, same: number, first?: {field: string, a: string|null, b: string|null}}} Comparison */
/** @typedef {{told: Comparison, time: Numbers, robot: Numbers, message: Numbers[], gained: Numbers, outcome: Numbers}} Changes */
const compare = (() => {
    "use strict";
    const most_rows = 300, no_frame = 255;
    /** @type {{changes: Changes|null, flood: Flood|null, marked: number[][], wanted: string, done: () => void}} */
    const own = { changes: null, flood: null, marked: [], wanted: "", done: () => {} };
    /** What a change is called and how it looks: lost, gained. */
    const kinds = [{ color: "#d55e00", text: "lost: in run A only" }, { color: "#0072b2", text: "gained: in run B only" }];

    /** @param {number} gained */
    function color(gained) { return theme.readable(kinds[gained].color); }

    /** Reads the comparison from the view file of B, and names the runs. @param {Side[]} all @returns {Promise<Map<number, number>[]>} messages of A by those of B, and the other way around */
    async function load(all) {
        const [a, b] = all.map(side => side.run), told = /** @type {any} */ (b.head).compare;
        if (![told?.gained, told?.lost, told?.same].every(Number.isSafeInteger) || told.runs?.length !== 2) rvw.refuse("The second view file has no comparison.");
        const columns = await Promise.all(["messages", "robot", "first", "second", "gained", "outcome", "time"].map(name => rvw.column(b.file, `compare.${name}`)));
        const [messages, robot, first, second, gained, outcome, time] = columns;
        if (messages.length !== b.messages || columns.slice(1).some(c => c.length !== time.length)) rvw.broken("compare");
        run.check_below(robot, Math.min(a.robots, b.robots), "compare.robot");
        run.check_below(gained, 2, "compare.gained");
        own.changes = { told, time, robot, message: [first, second], gained, outcome };
        all.forEach((side, i) => side.label = `${"AB"[i]}: ${words.visible(String(told.runs[i]))}`);
        const of_a = new Map(), of_b = new Map();
        messages.forEach((message, i) => {
            if (message >= a.messages) return;
            of_a.set(i, message);
            of_b.set(message, i);
        });
        return [of_a, of_b];
    }

    /** @param {Changes} all @param {number} i */
    function row(all, i) {
        const gained = all.gained[i], mark = dom.icon(16, c => sign(c, 8, 8, gained)), { run: r } = sides.own.all[gained];
        const other = all.outcome[i] === no_frame ? "no frame in range" : signs.kinds[signs.of(all.outcome[i])].text, both = gained ? [other, "delivered"] : ["delivered", other];
        const name = `${r.message_text(all.message[gained][i])} at ${r.label(all.robot[i])}`;
        return dom.make("li", "", mark, dom.make("span", "", dom.button(name, "link", () => go(all, i)), dom.make("span", "muted", ` ${words.seconds(all.time[i], 3)} s`),
            dom.make("p", "muted", `run A: ${both[0]}, run B: ${both[1]}`)));
    }

    /** Shows a change: its time, its robot and its message. @param {Changes} all @param {number} i */
    function go(all, i) {
        const lead = sides.lead(), message = all.message[lead][i], r = sides.own.all[lead].run, robot = all.robot[i];
        const { z } = r.pose(robot, all.time[i]);
        selection.set({ t: all.time[i], playing: false, robots: [robot], message: message < r.messages ? message : -1, storey: r.storey(z) });
    }

    function build() {
        const all = own.changes;
        if (!all) return;
        const { told } = all, { first } = told, rows = Array.from(all.time.subarray(0, most_rows), (_, i) => row(all, i));
        /** @param {string|null} line */
        const code = line => dom.make("code", "", line ? words.visible(line) : "the trace ends");
        dom.by_id("compare-panel").replaceChildren(dom.make("h2", "", "Deliveries in run B against run A"),
            dom.facts([["gained", `${words.count(told.gained)} in run B only`], ["lost", `${words.count(told.lost)} in run A only`], ["same", `${words.count(told.same)} in both`]]),
            ...rows.length ? [dom.make("h3", "", told.gained + told.lost > rows.length ? `The first ${rows.length} differences` : "Differences"), dom.make("ul", "plain", ...rows)] : [],
            dom.make("h3", "", "First record that differs"),
            ...(first ? [dom.make("p", "", `It differs in: ${first.field}`), dom.facts([["run A", code(first.a)], ["run B", code(first.b)]])] : [dom.make("p", "", "None: all records are equal.")]),
            dom.make("h3", "", "Runs"), dom.facts(sides.own.all.map(side => [side.label, sides.counts(side.run.head).join(", ")])));
    }

    /** Takes the message chosen: who gains or loses it, and its way in the run that the panels do not tell of. @param {State} state */
    function update(state) {
        const all = own.changes, lead = sides.lead(), wanted = `${state.runs} ${state.message}`;
        if (!all || wanted === own.wanted) return;
        Object.assign(own, { wanted, flood: null, marked: [] });
        if (state.message < 0) return;
        all.message[lead].forEach((message, i) => {
            if (message === state.message) own.marked.push([all.robot[i], all.gained[i]]);
        });
        const message = sides.in_other(state.message, lead), { run: r, blocks: frames } = sides.own.all[1 - lead];
        if (state.runs === "AB" && message >= 0) floods.of(r, frames, message).then(flood => {
            if (own.wanted !== wanted) return;
            own.flood = flood;
            own.done();
        }, frames.failed);
    }

    /** Way of the message chosen, in a run. @param {number} i */
    function flood(i) { return i === sides.lead() ? message_panel.flood() : own.flood; }

    /** @param {CanvasRenderingContext2D} c @param {number} x @param {number} y @param {number} gained */
    function sign(c, x, y, gained) {
        pen.circle(c, x, y, 6.5);
        c.fillStyle = color(gained);
        c.fill();
        c.fillStyle = theme.colors().paper;
        c.fillRect(x - 3.5, y - 1, 7, 2);
        if (gained) c.fillRect(x - 1, y - 3.5, 2, 7);
    }

    /** Signs at the robots that gain or lose the message chosen, beside their places of the last call of `robots.place`. @param {CanvasRenderingContext2D} c @param {State} state */
    function draw(c, state) {
        const { at } = robots;
        for (const [robot, gained] of own.marked) {
            if (at.storey[robot] === state.storey) sign(c, at.x[robot] - 12, at.y[robot] - 11, gained);
        }
    }

    /** Ticks of all changes: up gained, down lost. @param {CanvasRenderingContext2D} c @param {(t: number) => number} to_x @param {number} width @param {number} y middle [px] */
    function ticks(c, to_x, width, y) {
        const all = own.changes;
        if (!all) return;
        const last = [-1, -1];
        for (let i = 0; i < all.time.length; i++) {
            const x = Math.round(to_x(all.time[i])), gained = all.gained[i];
            if (x < 0 || x > width || x === last[gained]) continue;
            last[gained] = x;
            c.fillStyle = color(gained);
            c.fillRect(x - 1, gained ? y - 6 : y + 1, 2, 6);
        }
    }

    /** @param {(width: number, draw: (c: CanvasRenderingContext2D) => void, text: string) => HTMLElement} item */
    function legend(item) {
        const all = own.changes;
        return !all ? [] : [1, 0].filter(gained => all.gained.includes(gained)).map(gained => item(16, c => sign(c, 8, 8, gained), kinds[gained].text));
    }

    /** @param {() => void} done */
    function begin(done) {
        own.done = done;
        build();
    }

    return { load, begin, update, flood, draw, ticks, legend, is_there: () => own.changes !== null };
})();
