// SPDX-License-Identifier: MIT
// The run that is shown, or two: A and B side by side, or one of them over the whole place.
/** @typedef {{run: Run, blocks: Blocks, label: string}} Side */
const sides = (() => {
    "use strict";
    const gap = 1;  // [px] between two maps
    /** Runs, the names of the panels, and for each run: its messages by those of the other one. @type {{all: Side[], panels: string[], same: Map<number, number>[]}} */
    const own = { all: [], panels: ["events", "message", "robot", "pair", "charts"], same: [new Map(), new Map()] };

    /** Number of the run that the panels tell of: 0 A, 1 B. @returns {0|1} */
    function lead() { return selection.state.runs === "B" ? 1 : 0; }

    /** Numbers of the runs on the map, from the left. */
    function shown() { return selection.state.runs === "AB" ? [0, 1] : [lead()]; }

    /** The same message in the other run than this one, else -1. @param {number} message @param {number} from */
    function in_other(message, from) { return message < 0 ? -1 : own.same[1 - from].get(message) ?? -1; }

    /** State as a run has it, in whose numbers messages are; Infinity: a message that it has not. @param {number} i @returns {State} */
    function state_of(i) {
        const { state } = selection;
        if (i === lead() || state.message < 0) return state;
        const message = in_other(state.message, lead());
        return { ...state, message: message < 0 ? Infinity : message };
    }

    /** Shows A, B, or AB. @param {string} runs */
    function show(runs) {
        const { state } = selection, from = lead(), to = runs === "B" ? 1 : 0;
        if (own.all.length < 2) return;
        selection.set(from === to ? { runs } : {
            runs, message: in_other(state.message, from), filter: { ...state.filter, message: in_other(state.filter.message, from) }
        });
    }

    /** Place [px] of a map in the canvas. @param {number} nth from the left */
    function left(nth) { return nth * (camera.now.width + gap); }

    /** The run under a pixel of the canvas, and the pixel in its map. @param {number} px */
    function under(px) {
        const nth = Math.min(shown().length - 1, Math.floor(Math.max(0, px) / left(1)));
        return { i: shown()[nth] ?? 0, x: px - left(nth) };
    }

    /** Asks the server about a run: the one of the panels, or that number. @param {string} op @param {Record<string, any>} fields @param {number} [i] */
    function ask(op, fields, i = lead()) {
        const { t_ns } = fields, end = own.all[i].run.head.duration_ns;
        return server.ask(op, { ...fields, ...(t_ns > end ? { t_ns: end } : {}), ...(i ? { run: i } : {}) });
    }

    /** How much a run has. @param {Head} head */
    function counts({ seed, replication, counts: { messages, flights, receptions } }) {
        return [`seed ${seed}`, ...(replication ? [`replication ${replication}`] : []), words.counted(messages, "message"), words.counted(flights, "frame"), words.counted(receptions, "copy", "copies")];
    }

    /** What the map shows, in words. */
    function title() { return shown().map(i => own.all[i].label).join(" | "); }

    /** Two runs get one time and one map's size. @param {Side[]} all @param {Map<number, number>[]} same */
    function begin(all, same) {
        Object.assign(own, { all, same });
        if (all.length < 2) return;
        own.panels.push("compare");
        const runs = all.map(side => side.run), bounds = runs.map(r => r.head.map.bounds);
        const longest = Math.max(...runs.map(r => r.duration));
        for (const r of runs) {
            r.duration = longest;
            r.head.map.bounds = [0, 1, 2, 3].map(k => (k < 2 ? Math.min : Math.max)(...bounds.map(b => b[k])));
        }
        for (const id of ["runs", "compare-tab", "labels"]) dom.by_id(id).hidden = false;
        for (const button of dom.by_id("runs").children) button.addEventListener("click", () => show(/** @type {HTMLButtonElement} */ (button).value));
        selection.set({ runs: "AB", panel: "compare" });
    }

    function tell() {
        if (own.all.length < 2) return;
        for (const button of dom.by_id("runs").children) button.setAttribute("aria-pressed", String(/** @type {HTMLButtonElement} */ (button).value === selection.state.runs));
        dom.by_id("of-run").textContent = ["pair", "compare"].includes(selection.state.panel) ? "" : `of run ${"AB"[lead()]}`;
        [...dom.by_id("labels").children].forEach((label, nth) => label.textContent = own.all[shown()[nth]]?.label ?? "");
    }

    return { own, lead, shown, in_other, state_of, show, left, under, ask, counts, title, begin, tell };
})();
