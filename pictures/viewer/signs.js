// SPDX-License-Identifier: MIT
// Signs of what became of a frame at a receiver: a shape and a colour each.
const signs = (() => {
    "use strict";
    const delivered = 0, received = 1, duplicate = 2, collided = 3, busy = 4, off = 5, garbled = 6, count = 7;
    /** @type {{key: string, mark: string, text: string, outcome: number}[]} */
    const kinds = [
        { key: "delivered", mark: "o", text: "delivered", outcome: 1 },
        { key: "received", mark: "\u00b7", text: "received", outcome: 0 },
        { key: "duplicate", mark: "=", text: "duplicate", outcome: 4 },
        { key: "collided", mark: "\u00d7", text: "collided", outcome: 10 },
        { key: "busy", mark: "v", text: "receiver was sending", outcome: 12 },
        { key: "off", mark: "#", text: "receiver was off", outcome: 6 },
        { key: "garbled", mark: "!", text: "garbled", outcome: 8 }
    ];
    const of_fate = [received, received, duplicate, off, garbled, collided, busy, received];

    /** Sign of an outcome, which is 2 x fate + delivered. @param {number} outcome */
    function of(outcome) { return outcome & 1 ? delivered : of_fate[outcome >> 1] ?? received; }

    /** @param {number} sign @returns {string} */
    function color(sign) { return theme.readable(look.colors.outcomes[kinds[sign].outcome]); }

    /** Colours of this run, set when it is there. @type {{colors: Colors}} */
    const look = { colors: { category: [], lagoon: [], ember: [], balance: [], links: [], walls: [], door: "#d55e00", stairs: "#0072b2", robot: "#111111", outcomes: [] } };

    /** @param {CanvasPath} c @param {number} sign @param {number} x @param {number} y @param {number} r half its size [px] */
    function outline(c, sign, x, y, r) {
        switch (sign) {
            case delivered: c.moveTo(x + r, y); c.arc(x, y, r, 0, 2 * Math.PI); break;
            case received: c.moveTo(x + r / 2, y); c.arc(x, y, r / 2, 0, 2 * Math.PI); break;
            case duplicate: c.moveTo(x - r, y - r / 2); c.lineTo(x + r, y - r / 2); c.moveTo(x - r, y + r / 2); c.lineTo(x + r, y + r / 2); break;
            case collided: c.moveTo(x - r, y - r); c.lineTo(x + r, y + r); c.moveTo(x - r, y + r); c.lineTo(x + r, y - r); break;
            case busy: c.moveTo(x - r, y - r); c.lineTo(x, y + r); c.lineTo(x + r, y - r); break;
            case off: c.rect(x - r * 0.8, y - r * 0.8, r * 1.6, r * 1.6); break;
            default: c.moveTo(x, y - r); c.lineTo(x, y + r * 0.3); c.moveTo(x, y + r * 0.8); c.lineTo(x, y + r); break;
        }
    }

    /** @param {CanvasRenderingContext2D} c @param {number} sign @param {number} x @param {number} y @param {number} r */
    function draw(c, sign, x, y, r) {
        c.beginPath();
        outline(c, sign, x, y, r);
        pen.rimmed(c, color(sign), 2);
    }

    /** Number of receptions of each sign in the run. @param {Run} r @returns {number[]} */
    function counts(r) {
        const out = new Array(kinds.length).fill(0);
        r.head.counts.outcomes.forEach((n, outcome) => out[of(outcome)] += n);
        return out;
    }

    return { counts, received, duplicate, count, kinds, of, color, look, outline, draw };
})();
