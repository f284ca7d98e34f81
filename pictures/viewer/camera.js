// SPDX-License-Identifier: MIT
// Part of the world that the map shows.
const camera = (() => {
    "use strict";
    const margin = 0.03, closest = 5000;  // share of the larger side; [px/m]
    const buttons = 40, text_line = 24;   // [px] of buttons right, above if there are storeys; of the names of runs above, of the status below
    /** Middle of the map [m], pixels per metre, size [px]. */
    const now = { x: 0, y: 0, scale: 10, width: 100, height: 100 };

    /** @param {Head} head */
    function whole(head) {
        let [left, bottom, right, top] = head.map.bounds;
        const least = head.robots.length > 1 ? 1 : 10;
        const more = Math.max(margin * Math.max(right - left, top - bottom), (least - Math.max(right - left, top - bottom)) / 2);
        [left, bottom, right, top] = [left - more, bottom - more, right + more, top + more];
        const above = 12 + (head.map.floors.length > 1 ? buttons : 0) + (sides.own.all.length > 1 ? text_line : 0), wide = Math.min(buttons, now.width / 4);
        const scale = Math.min((now.width - wide) / (right - left), Math.max(now.height - above - text_line, 10) / (top - bottom)), slack = now.height - scale * (top - bottom);
        /** @param {number} slack @param {number} taken [px] by buttons at one end */
        const shift = (slack, taken) => Math.max(0, taken - slack / 2) / scale;
        return { x: (left + right) / 2 + shift(now.width - scale * (right - left), wide), y: (bottom + top) / 2 + shift(slack, above) - shift(slack, text_line), scale };
    }

    /** Takes the view of the state, or all of the map. @param {State} state @param {Head} head */
    function aim(state, head) { Object.assign(now, state.view ?? whole(head)); }

    /** @param {number} x [m] */
    function to_x(x) { return now.width / 2 + (x - now.x) * now.scale; }
    /** @param {number} y [m] */
    function to_y(y) { return now.height / 2 - (y - now.y) * now.scale; }
    /** @param {number} px */
    function from_x(px) { return now.x + (px - now.width / 2) / now.scale; }
    /** @param {number} py */
    function from_y(py) { return now.y - (py - now.height / 2) / now.scale; }

    /** View that is larger by a factor around a pixel. @param {number} factor @param {number} px @param {number} py @param {Head} head @returns {View} */
    function zoomed(factor, px, py, head) {
        const scale = Math.min(closest, Math.max(whole(head).scale / 8, now.scale * factor));
        const x = from_x(px), y = from_y(py);
        return { scale, x: x - (px - now.width / 2) / scale, y: y + (py - now.height / 2) / scale };
    }

    /** View that is moved by pixels. @param {number} dx @param {number} dy @returns {View} */
    function moved(dx, dy) { return { scale: now.scale, x: now.x - dx / now.scale, y: now.y + dy / now.scale }; }

    /** Round length of about that size. @param {number} v */
    function round_number(v) {
        const power = 10 ** Math.floor(Math.log10(v));
        return ([5, 2, 1].find(digit => digit * power <= v) ?? 1) * power;
    }

    return { now, aim, to_x, to_y, from_x, from_y, zoomed, moved, round_number };
})();
