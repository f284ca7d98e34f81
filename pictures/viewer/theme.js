// SPDX-License-Identifier: MIT
// Colours on light and on dark paper.
/** @typedef {{paper: string, ink: string, muted: string, line: string, faint: string, chosen: string, off: string, accent: string}} Palette */
const theme = (() => {
    "use strict";
    /** @type {Palette} */
    const light = { paper: "#ffffff", ink: "#111111", muted: "#555555", line: "#555555", faint: "#e4e7eb", chosen: "#ffa94d", off: "#949494", accent: "#0072b2" };
    /** @type {Palette} */
    const dark = { paper: "#16181c", ink: "#f0f0f0", muted: "#a9afb8", line: "#7a818c", faint: "#2a2e35", chosen: "#c46a10", off: "#6e747e", accent: "#56b4e9" };
    const least_contrast = { light: 3, dark: 4.5 };  // thin lines need more on dark paper

    const [dark_wanted, still_wanted] = ["color-scheme: dark", "reduced-motion: reduce"].map(wish => globalThis.matchMedia?.(`(prefers-${wish})`));

    /** The wishes, kept: asking the browser for each frame on air takes a millisecond. */
    const now = { dark: false, still: false };
    function look() { Object.assign(now, { dark: Boolean(dark_wanted?.matches), still: Boolean(still_wanted?.matches) }); }
    for (const wish of [dark_wanted, still_wanted]) wish?.addEventListener("change", look);
    look();

    function is_dark() { return now.dark; }
    function is_still() { return now.still; }
    function colors() { return is_dark() ? dark : light; }

    /** @param {string} hex @returns {number[]} */
    function channels(hex) { return [1, 3, 5].map(i => parseInt(hex.slice(i, i + 2), 16)); }

    /** @param {number[]} c */
    function hex(c) { return "#" + c.map(v => Math.round(v).toString(16).padStart(2, "0")).join(""); }

    /** Relative luminance of WCAG 2.1. @param {string} color */
    function luminance(color) {
        const [r, g, b] = channels(color).map(v => v <= 10.3 ? v / 255 / 12.92 : ((v / 255 + 0.055) / 1.055) ** 2.4);
        return 0.2126 * r + 0.7152 * g + 0.0722 * b;
    }

    /** @param {string} a @param {string} b */
    function contrast(a, b) {
        const [low, high] = [luminance(a), luminance(b)].sort((x, y) => x - y);
        return (high + 0.05) / (low + 0.05);
    }

    /** @param {string} a @param {string} b @param {number} share of a */
    function blend(a, b, share) {
        const of_b = channels(b);
        return hex(channels(a).map((v, i) => share * v + (1 - share) * of_b[i]));
    }

    /** @type {Map<string, string>} */ const known = new Map();

    /** A colour near this one that stands out from the paper. @param {string} color */
    function readable(color) {
        const key = color + is_dark();
        let out = known.get(key);
        if (out) return out;
        out = color;
        const least = least_contrast[is_dark() ? "dark" : "light"];
        for (let share = 0.9; contrast(out, colors().paper) < least && share > 0; share -= 0.1) out = blend(color, colors().ink, share);
        known.set(key, out);
        return out;
    }

    /** Colour of a wall: greys of dark paper are those of white paper, turned around. @param {string} color */
    function wall(color) {
        return is_dark() ? hex(channels(color).map(v => 232 - 0.8 * v)) : color;
    }

    /** Colour of a robot or flow. @param {number} i */
    function category(i) {
        const all = signs.look.colors.category;
        return readable(all[i % all.length]);
    }

    /** Colour on a scale, x from 0 to 1. @param {string[]} scale @param {number} x */
    function on_scale(scale, x) {
        const place = Math.min(1, Math.max(0, x)) * (scale.length - 1), i = Math.min(scale.length - 2, Math.floor(place));
        return blend(scale[i + 1], scale[i], place - i);
    }

    /** @param {() => void} then */
    function on_change(then) {
        for (const wish of [dark_wanted, still_wanted]) wish?.addEventListener("change", then);
    }

    return { is_dark, is_still, colors, readable, wall, category, on_scale, channels, on_change };
})();
