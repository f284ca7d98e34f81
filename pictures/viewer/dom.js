// SPDX-License-Identifier: MIT
// Elements of the page. Texts are set as text only: names and payloads are foreign.
const dom = (() => {
    "use strict";

    /** Element that the page has. @param {string} id @returns {HTMLElement} */
    function by_id(id) { return /** @type {HTMLElement} */ (document.getElementById(id)); }

    /** @param {string} id @returns {HTMLCanvasElement} */
    function canvas(id) { return /** @type {HTMLCanvasElement} */ (by_id(id)); }

    /** @param {string} id @returns {HTMLInputElement} */
    function input(id) { return /** @type {HTMLInputElement} */ (by_id(id)); }

    /** @param {string} tag @param {string} kind class @param {(Node|string)[]} parts @returns {HTMLElement} */
    function make(tag, kind, ...parts) {
        const out = document.createElement(tag);
        if (kind) out.className = kind;
        out.append(...parts);
        return out;
    }

    /** @param {string} text @param {string} kind @param {() => void} act @param {string} [label] */
    function button(text, kind, act, label) {
        const out = make("button", kind, text);
        if (label) out.setAttribute("aria-label", label);
        out.addEventListener("click", act);
        return out;
    }

    /** @param {string} id @param {(event: MouseEvent) => void} act */
    function on_click(id, act) { by_id(id).addEventListener("click", act); }

    /** Table of names and values. @param {[string, Node|string][]} rows */
    function facts(rows) {
        return make("dl", "facts", ...rows.flatMap(([name, value]) => [make("dt", "", name), make("dd", "", value)]));
    }

    /** Picture of a sign beside a text. @param {number} width @param {(c: CanvasRenderingContext2D) => void} draw */
    function icon(width, draw) {
        const out = /** @type {HTMLCanvasElement} */ (make("canvas", "icon"));
        out.setAttribute("aria-hidden", "true");
        const c = sized(out, width, 16);
        draw(c);
        return out;
    }

    /** @param {number} sign */
    function sign(sign) { return icon(16, c => signs.draw(c, sign, 8, 8, 4)); }

    /** Style of each canvas: asking it for its own takes long. @type {WeakMap<HTMLCanvasElement, string>} */ const styles = new WeakMap();

    /** Context of a canvas of that size in CSS pixels, cleared. @param {HTMLCanvasElement} of @param {number} width @param {number} height */
    function sized(of, width, height) {
        const ratio = devicePixelRatio;
        const w = Math.max(1, Math.round(width * ratio)), h = Math.max(1, Math.round(height * ratio));
        if (of.width !== w || of.height !== h) {
            of.width = w;
            of.height = h;
        }
        const shown = `width: ${width}px; height: ${height}px;`;
        if (styles.get(of) !== shown) styles.set(of, of.style.cssText = shown);
        const c = /** @type {CanvasRenderingContext2D} */ (of.getContext("2d"));
        c.setTransform(ratio, 0, 0, ratio, 0, 0);
        c.globalAlpha = 1;
        c.setLineDash([]);
        c.clearRect(0, 0, width, height);
        return c;
    }

    /** @param {string} name @param {Blob} content */
    function save(name, content) {
        const link = document.createElement("a");
        link.href = URL.createObjectURL(content);
        link.download = name;
        link.click();
        setTimeout(() => URL.revokeObjectURL(link.href), 10000);
    }

    return { by_id, canvas, input, make, button, on_click, facts, icon, sign, sized, save };
})();
