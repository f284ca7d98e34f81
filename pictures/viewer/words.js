// SPDX-License-Identifier: MIT
// Numbers and times as people read them.
const words = (() => {
    "use strict";
    const thin = "\u202f", minus = "\u2212";

    /** @param {string} digits @param {boolean} from_left */
    function grouped(digits, from_left) {
        return digits.replace(from_left ? /(\d{3})(?=\d)/g : /(\d)(?=(\d{3})+$)/g, `$1${thin}`);
    }

    /** Seconds of a time [ns] with that many decimals, rounded down. @param {number} ns @param {number} decimals */
    function seconds(ns, decimals = 6) {
        const whole = Math.floor(ns / 1e9), rest = String(Math.floor(ns - whole * 1e9)).padStart(9, "0").slice(0, decimals);
        const text = grouped(String(Math.abs(whole)), false) + (decimals > 0 ? "." + grouped(rest, true) : "");
        return (ns < 0 ? minus : "") + text;
    }

    /** Seconds of a time [ns] with all nanoseconds, for programs. @param {number} ns */
    function plain(ns) { return seconds(ns, 9).replaceAll(thin, ""); }

    /** Length of time [ns] in a unit that fits. @param {number} ns */
    function span(ns) {
        const units = /** @type {[number, string][]} */ ([[1e9, "s"], [1e6, "ms"], [1e3, "\u00b5s"], [1, "ns"]]);
        const [size, unit] = units.find(([u]) => Math.abs(ns) >= u) ?? [1, "ns"];
        return `${number(ns / size, 4)}${thin}${unit}`;
    }

    /** @param {number} v @param {number} digits that count */
    function number(v, digits = 6) {
        if (!Number.isFinite(v)) return String(v);
        return String(Number.isInteger(v) ? v : Number(v.toPrecision(digits))).replace("-", minus);
    }

    /** @param {number} v @param {number} decimals */
    function fixed(v, decimals) { return v.toFixed(decimals).replace("-", minus); }

    /** @param {number} n */
    function count(n) { return grouped(String(n), false); }

    /** @param {number} n @param {string} one @param {string} [many] */
    function counted(n, one, many = one + "s") { return `${count(n)} ${n === 1 ? one : many}`; }

    /** Begin and end of a long text: names often begin alike. @param {string} text @param {number} most even */
    function shortened(text, most) {
        const points = [...text];
        return points.length <= most ? text : [...points.slice(0, most / 2), "\u2026", ...points.slice(1 - most / 2)].join("");
    }

    /** Text without characters that cannot be seen or that turn the direction around. @param {string} text */
    function visible(text) {
        return text.replace(/[\p{Cc}\p{Cf}\p{Zl}\p{Zp}]/gu, c => `\u27e8${(c.codePointAt(0) ?? 0).toString(16).toUpperCase().padStart(4, "0")}\u27e9`);
    }

    /** A foreign name, as it is shown. @param {string} name @param {number} most */
    function short(name, most) { return shortened(visible(name), most); }

    return { seconds, plain, span, number, fixed, count, counted, shortened, visible, short };
})();
