// SPDX-License-Identifier: MIT
// Patterns of the antennas of chosen robots: gains by direction, around the robot.
const antennas = (() => {
    "use strict";
    const most = 56, least_db = -30, ring_db = 10;  // [px] from the robot to the largest gain; [dB] at the robot; between rings

    /** Distance [px] of a gain from the robot. @param {number} db */
    function reach(db) { return most * Math.max(0, 1 - db / least_db); }

    /** Gains of a robot's antenna, null for one that is equal in all directions. @param {Run} r @param {number} robot @returns {number[]|null} */
    function gains(r, robot) {
        const number = r.head.robots[robot]?.antenna;
        return typeof number === "number" ? r.head.antennas[number] ?? null : null;
    }

    /** @param {CanvasRenderingContext2D} c @param {Run} r @param {State} state */
    function draw(c, r, state) {
        for (const i of state.robots) {
            const pattern = gains(r, i), { [i]: x } = robots.at.x, { [i]: y } = robots.at.y;
            if (!pattern || robots.at.storey[i] !== state.storey) continue;
            pen.take(c, theme.colors().muted, 0.5);
            for (let db = 0; db > least_db; db -= ring_db) {
                pen.circle(c, x, y, reach(db));
                c.stroke();
            }
            pen.take(c, c.fillStyle = theme.colors().accent, 1.5);
            c.beginPath();
            pattern.forEach((db, k) => {
                const angle = robots.at.heading[i] + 2 * Math.PI * k / pattern.length;
                c.lineTo(x + reach(db) * Math.cos(angle), y - reach(db) * Math.sin(angle));
            });
            c.closePath();
            c.globalAlpha = 0.12;
            c.fill();
            c.globalAlpha = 1;
            c.stroke();
        }
    }

    /** @param {Item} item @param {Run} r @param {State} state */
    function legend(item, r, state) {
        if (!state.robots.some(i => gains(r, i))) return [];
        return [item(18, c => {
            pen.take(c, theme.colors().accent, 1.5);
            c.beginPath();
            c.ellipse(10, 8, 7, 4, 0, 0, 2 * Math.PI);
            c.stroke();
        }, `antenna: gain by direction, ${ring_db} dB a ring`, "The outer ring is the largest gain")];
    }

    return { draw, legend, gains };
})();
