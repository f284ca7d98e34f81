// SPDX-License-Identifier: MIT
// Answers of the server as tables: whatever keys they have, with their units.
const tables = (() => {
    "use strict";
    /** @type {Record<string, string>} */
    const units = { s: "s", m: "m", db: "dB", dbm: "dBm", hz: "Hz", rad: "rad", bps: "bit/s" };
    const most_rows = 100;

    /** "level_dbm" as "level [dBm]". @param {string} key */
    function title(key) {
        const parts = key.split("_"), unit = units[parts[parts.length - 1]];
        return unit && parts.length > 1 ? `${parts.slice(0, -1).join(" ")} [${unit}]` : parts.join(" ");
    }

    /** @param {any} value @returns {string} */
    function text(value) {
        if (value == null) return "-";
        if (typeof value === "number") return words.number(value, 7);
        if (typeof value === "boolean") return value ? "yes" : "no";
        if (Array.isArray(value)) return value.map(text).join(", ") || "-";
        if (typeof value === "object") return Object.values(value).map(text).join(" ");
        return words.visible(String(value));
    }

    /** Table of all keys, or of some of them. @param {Record<string, any>[]} rows @param {string[]} [some] */
    function of(rows, some) {
        const all = [...new Set(rows.flatMap(row => Object.keys(row ?? {})))], keys = some ? some.filter(key => all.includes(key)) : all;
        const out = dom.make("div", "table", dom.make("table", "",
            dom.make("thead", "", dom.make("tr", "", ...keys.map(key => dom.make("th", "", title(key))))),
            dom.make("tbody", "", ...rows.slice(0, most_rows).map(row => dom.make("tr", "", ...keys.map(key => dom.make("td", typeof row[key] === "number" ? "number" : "", text(row[key]))))))));
        out.tabIndex = 0;
        out.setAttribute("role", "group");
        out.setAttribute("aria-label", keys.map(title).join(", "));
        return out;
    }

    return { of, text, title };
})();
