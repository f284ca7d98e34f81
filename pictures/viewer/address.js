// SPDX-License-Identifier: MIT
// What is shown, in the address of the page: a copied address shows the same.
const address = (() => {
    "use strict";
    const pause_ms = 300, ours = "rovernet";
    let timer = 0, selected = "", awaited = -1;  // what is selected now; message of the address that a run which goes on has not sent yet

    /** @returns {string} */
    function text() {
        const { t, speed, storey, view, span, robots: chosen, message, filter, panel, trails, links: lines, all, coverage: covers, runs } = selection.state, p = new URLSearchParams(), shown = Math.max(message, awaited);
        /** @param {string} key @param {unknown} wanted @param {unknown} value */
        const put = (key, wanted, value) => {
            if (wanted) p.set(key, String(value));
        };
        put("t", !live.is_live() || !live.follows(), words_of_time(t));
        put("speed", speed !== 1, Number(speed.toPrecision(4)));
        put("storey", storey, storey + 1);
        put("view", view, view && [view.x, view.y, view.scale].map(v => Number(v.toPrecision(11))));
        put("span", span, span && [span.from, span.to].map(words_of_time));
        put("robots", chosen.length, chosen);
        put("message", shown >= 0, shown);
        put("runs", sides.own.all.length > 1, runs);
        put("panel", panel !== "events", panel);
        put("trails", !trails, 0);
        put("links", lines, 1);
        put("all", all, 1);
        put("coverage", covers >= 0, covers);
        put("of", filter.robot >= 0, filter.robot);
        put("on", filter.message >= 0, filter.message);
        put("signs", filter.signs !== selection.everything, filter.signs);
        put("kinds", filter.kinds !== selection.everything, filter.kinds);
        return "#" + p.toString().replaceAll("%2C", ",");
    }

    /** @param {number} ns */
    function words_of_time(ns) { return words.plain(Math.round(ns)).replace(/\.?0+$/, ""); }

    /** @param {string} text @returns {number} [ns] */
    function time_of(text) {
        const [whole, rest = ""] = text.split(".");
        return Number(whole) * 1e9 + Number(rest.padEnd(9, "0").slice(0, 9));
    }

    /** @param {string} hash @returns {Partial<State>} */
    function parsed(hash) {
        const p = new URLSearchParams(hash.replace(/^#/, "")), runs = ["A", "B", "AB"].find(text => text === p.get("runs")) ?? selection.state.runs;
        const { all, panels } = sides.own, { run: r } = all[all.length > 1 && runs === "B" ? 1 : 0];
        /** @param {string} key @param {number} low @param {number} high @param {number} [other] */
        const whole = (key, low, high, other = -1) => {
            const v = Number(p.get(key) ?? NaN);
            return Number.isInteger(v) && v >= low && v <= high ? v : other;
        };
        /** @param {string} key @param {(text: string) => number} read @returns {number[]|null} */
        const numbers = (key, read) => {
            const out = p.get(key)?.split(",").map(read) ?? [];
            return out.length && out.every(Number.isFinite) ? out : null;
        };
        const t = time_of(p.get("t") ?? "0"), speed = Number(p.get("speed") ?? 1), view = numbers("view", Number), span = numbers("span", time_of);
        return {
            runs: all.length > 1 ? runs : "A", t: t >= 0 ? Math.min(t, r.duration) : 0, speed: speed >= 1e-6 && speed <= 1e3 ? speed : 1,
            storey: whole("storey", 1, r.head.map.floors.length, 1) - 1,
            view: view?.length === 3 && view[2] > 1e-9 && view[2] <= 5000 && Math.hypot(view[0], view[1]) < 1e9 ? { x: view[0], y: view[1], scale: view[2] } : null,
            span: span?.length === 2 && span[1] - span[0] > 998 && span[0] >= 0 && span[1] <= r.duration ? { from: span[0], to: span[1] } : null,
            robots: (numbers("robots", Number) ?? []).filter(i => r.head.robots[i]).slice(0, 2),
            message: whole("message", 0, r.messages - 1),
            panel: panels.find(text => text === p.get("panel")) ?? "events", trails: p.get("trails") !== "0", links: p.get("links") === "1", all: p.get("all") === "1", coverage: whole("coverage", 0, r.robots - 1),
            filter: {
                robot: whole("of", 0, r.robots - 1), message: whole("on", 0, r.messages - 1),
                signs: whole("signs", 0, selection.everything, selection.everything), kinds: whole("kinds", 0, selection.everything, selection.everything)
            }
        };
    }

    /** Robots and message, which have an entry in the history. @param {Partial<State>} state */
    function selected_in({ robots: chosen, message = -1 }) { return `${chosen} ${Math.max(message, awaited)}`; }

    /** @param {string} next @param {boolean} [is_new] */
    function write(next, is_new) {
        try {
            history[is_new ? "pushState" : "replaceState"](ours, "", next);
        } catch {
            // A browser may refuse more than some changes a second: the next one will do.
        }
    }

    function begin() {
        const { run: r } = sides.own.all[0], asked = Number(/[#&]message=(\d+)/.exec(location.hash)?.[1] ?? -1);
        if (r.head.live?.ended === false && asked >= r.messages) awaited = asked;
        if (location.hash.length > 1) selection.set(parsed(location.hash));
        write(location.href);
        selected = selected_in(selection.state);
        selection.listen(changed => {
            clearTimeout(timer);
            if (changed.has("message")) awaited = -1;
            const before = selected;
            selected = selected_in(selection.state);
            if (selected !== before) write(text(), true);
            else if (!selection.state.playing) timer = setTimeout(() => write(text()), pause_ms);
        });
        window.addEventListener("popstate", event => {
            const wanted = parsed(location.hash), { robots: chosen, message, panel, runs } = wanted;
            selected = selected_in(wanted);
            selection.set(event.state === ours ? { robots: chosen, message, panel, runs } : wanted);
            write(location.href);
        });
    }

    /** A run that goes on has more messages. @param {Run} r */
    function grown(r) { if (awaited >= 0 && awaited < r.messages) selection.set({ message: awaited }); }

    return { begin, grown };
})();
