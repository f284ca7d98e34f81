// SPDX-License-Identifier: MIT
// Filter of the list of events: kinds, outcomes, one robot, one message.
const filters = (() => {
    "use strict";
    /** @type {{run: Run, filter: Filter|null, there: string}} */ const own = { run: /** @type {any} */ (null), filter: null, there: "" };

    /** @param {Partial<Filter>} patch */
    function change(patch) { selection.set({ filter: { ...selection.state.filter, ...patch } }); }

    /** @param {Node|string} content @param {boolean} on @param {string} label @param {() => void} act */
    function toggle(content, on, label, act) {
        const out = dom.button("", "", act, label);
        out.replaceChildren(content);
        out.setAttribute("aria-pressed", String(on));
        out.title = label;
        return out;
    }

    /** @param {State} state */
    function update(state) {
        const { filter } = state, r = own.run, counts = signs.counts(r), parts = [];
        const there = [r.messages > 0, r.col("doors.time").length > 0, r.col("states.time").length > 0, r.head.counts.flights > 0, r.head.counts.receptions > 0, r.col("drops.time").length > 0];
        const what = [...there, ...counts.map(n => n > 0)].join();
        if (filter === own.filter && what === own.there) return;
        Object.assign(own, { filter, there: what });
        events.kind_names.forEach((name, kind) => {
            const on = Boolean(filter.kinds >> kind & 1);
            if (there[kind]) parts.push(toggle(`${name}s`.replace("message sents", "sent").replace("losss", "losses"), on, `${name}: shown or not`, () => change({ kinds: filter.kinds ^ 1 << kind })));
        });
        counts.forEach((n, sign) => {
            const on = Boolean(filter.signs >> sign & 1);
            if (n > 0) parts.push(toggle(dom.sign(sign), on, `${signs.kinds[sign].text}: shown or not`, () => change({ signs: filter.signs ^ 1 << sign })));
        });
        if (filter.robot >= 0) parts.push(dom.button(`${r.label(filter.robot, 20)} \u00d7`, "chip", () => change({ robot: -1 }), "events of all robots"));
        if (filter.message >= 0) parts.push(dom.button(`${r.message_text(filter.message)} \u00d7`, "chip", () => change({ message: -1 }), "events of all messages"));
        dom.by_id("filters").replaceChildren(...parts);
    }

    /** @param {Run} r */
    function show(r) { Object.assign(own, { run: r, filter: null }); }

    return { show, update };
})();
