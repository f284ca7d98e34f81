// SPDX-License-Identifier: MIT
// Search of a robot by its name or of a message by its number, kind or payload.
const search = (() => {
    "use strict";
    const most = 12, most_looked = 200000;
    /** @type {{run: Run}} */ const own = { run: /** @type {any} */ (null) };

    /** @param {string} text @returns {{text: string, act: () => void}[]} */
    function found(text) {
        const r = own.run, wanted = text.toLowerCase(), out = [];
        if (!wanted) return [];
        const names = r.head.robots.map((robot, i) => ({ i, name: robot.name.toLowerCase() })).filter(({ name }) => name.includes(wanted));
        names.sort((a, b) => a.name.indexOf(wanted) - b.name.indexOf(wanted) || a.name.length - b.name.length);
        for (const { i } of names.slice(0, most)) out.push({ text: `robot ${r.label(i, 40)}`, act: () => selection.state.panel === "pair" ? selection.choose(i, true) : selection.set({ robots: [i], panel: "robot", storey: r.storey(r.pose(i, selection.state.t).z) }) });
        const uid = r.by_uid.get(Number(wanted.replace(/^message\s+/, "")));
        /** @param {number} i */
        const add = i => {
            const payload = words.short(r.payload(i), 24);
            out.push({ text: `${r.message_text(i)} of ${r.label(r.col("messages.origin")[i])}${payload ? `: ${payload}` : ""}`, act: () => selection.set({ message: i, panel: "message" }) });
        };
        if (uid !== undefined) add(uid);
        for (let i = 0; i < Math.min(r.messages, most_looked) && out.length < most; i++) {
            if (i !== uid && r.payload(i).toLowerCase().includes(wanted)) add(i);
        }
        return out.slice(0, most);
    }

    function show() {
        const results = dom.by_id("results"), text = dom.input("search").value.trim(), rows = found(text);
        results.replaceChildren(...rows.map(({ text, act }) => dom.button(text, "", () => {
            act();
            close();
        })));
        if (text && rows.length === 0) results.append(dom.make("p", "muted", "nothing found"));
        results.hidden = !text;
    }

    function close() {
        dom.by_id("results").hidden = true;
        dom.input("search").value = "";
        dom.input("search").blur();  // keys act on the page again
    }

    /** @param {KeyboardEvent} event */
    function key(event) {
        const buttons = [...dom.by_id("results").querySelectorAll("button")], at = buttons.indexOf(/** @type {any} */ (document.activeElement));
        if (event.key === "Enter" && at < 0) buttons[0]?.click();
        else if (event.key === "ArrowDown") buttons[Math.min(buttons.length - 1, at + 1)]?.focus();
        else if (event.key === "ArrowUp") (at > 0 ? buttons[at - 1] : dom.input("search")).focus();
        else if (event.key === "Escape") close();
        else return;
        event.preventDefault();
        event.stopPropagation();
    }

    /** @param {Run} r */
    function show_run(r) { own.run = r; }

    function begin() {
        dom.input("search").addEventListener("input", show);
        dom.by_id("finder").addEventListener("keydown", key);
        document.addEventListener("pointerdown", event => {
            if (event.target instanceof Node && !dom.by_id("finder").contains(event.target)) dom.by_id("results").hidden = true;
        });
    }

    return { begin, show: show_run };
})();
