// SPDX-License-Identifier: MIT
// Robots at the time shown, their names and trails.
const robots = (() => {
    "use strict";
    const least_radius = 4, beyond = 5;                 // [px]
    const most_named = 400, most_trails = 200, many = 1500;
    const trail_ns = 10e9, nowhere = 255;  // storey of a robot that has not departed, or has left
    /** @type {Pose} */ const pose = { x: 0, y: 0, z: 0, vx: 0, vy: 0, heading: 0 };

    /** Places of all robots [px] at the time of the last call of `place`. */
    const at = { t: -1, x: new Float64Array(0), y: new Float64Array(0), heading: new Float64Array(0), storey: new Uint8Array(0), on: new Uint8Array(0) };
    /** Robots of the storey that are in sight, if they are not too many to be drawn one by one. @type {number[]} */ let shown = [];
    let colors = new Int32Array(0);  // of a swarm

    /** @param {Run} r @param {number} t */
    function place(r, t) {
        if (at.x.length !== r.robots) {
            for (const key of /** @type {const} */ (["x", "y", "heading"])) at[key] = new Float64Array(r.robots);
            at.storey = new Uint8Array(r.robots);
            at.on = new Uint8Array(r.robots);
        }
        const storeys = r.head.map.floors.length > 1;
        for (let i = 0; i < r.robots; i++) {
            r.pose(i, t, pose);
            at.x[i] = camera.to_x(pose.x);
            at.y[i] = camera.to_y(pose.y);
            at.heading[i] = pose.heading;
            at.storey[i] = storeys ? r.storey(pose.z) : 0;
        }
        at.on.fill(1);
        for (const robot of r.states.keys()) {
            const { on, there } = r.state(robot, t);
            at.on[robot] = Number(on);
            if (!there) at.storey[robot] = nowhere;
        }
        at.t = t;
    }

    /** @param {Run} r @param {number} i */
    function radius(r, i) { return Math.max(least_radius, r.head.robots[i].radius * camera.now.scale); }

    /** @param {number} i @param {number} room [px] around it */
    function in_view(i, room) {
        return at.x[i] > -room && at.y[i] > -room && at.x[i] < camera.now.width + room && at.y[i] < camera.now.height + room;
    }

    /** Places of a robot in the seconds before, as a line. @param {CanvasRenderingContext2D} c @param {Run} r @param {number} robot @param {State} state */
    function trail(c, r, robot, state) {
        const from = Math.max(0, state.t - trail_ns), { start } = r.legs, first = r.leg(robot, from), last = r.leg(robot, state.t);
        let drawn = false;
        /** @param {number} t */
        const go = t => {
            r.pose(robot, t, pose);
            const here = r.storey(pose.z) === state.storey, x = camera.to_x(pose.x), y = camera.to_y(pose.y);
            if (here && drawn) c.lineTo(x, y); else c.moveTo(x, y);
            drawn = here;
        };
        go(from);
        for (let leg = first + 1; leg <= last; leg++) go(start[leg]);
        go(state.t);
    }

    /** @param {CanvasRenderingContext2D} c @param {Run} r @param {State} state */
    function trails(c, r, state) {
        const shown = state.trails && r.robots <= most_trails ? [...Array(r.robots).keys()] : state.robots;
        for (const robot of shown) {
            c.beginPath();
            trail(c, r, robot, state);
            pen.rimmed(c, theme.category(robot), 1.2);
        }
    }

    /** @param {CanvasRenderingContext2D} c @param {number} x @param {number} y @param {number} r @param {string} rim @param {boolean} on @param {boolean} chosen @param {number|null} heading */
    function disc(c, x, y, r, rim, on, chosen, heading) {
        const colors = theme.colors();
        pen.circle(c, x, y, r);
        if (on || chosen) {
            c.fillStyle = chosen ? colors.chosen : colors.paper;
            c.fill();
        }
        pen.take(c, rim, on ? 2.2 : 1.4, on ? [] : [2, 2]);
        c.stroke();
        if (!on || heading === null) return;
        c.beginPath();
        c.moveTo(x, y);
        c.lineTo(x + (r + beyond) * Math.cos(heading), y - (r + beyond) * Math.sin(heading));
        c.lineCap = "round";
        pen.rimmed(c, colors.ink, 2);
        c.lineCap = "butt";
    }

    /** Thousands of robots as squares, which leave room between them. @param {State} state @param {number[]} bounds of the map */
    function swarm(state, bounds) {
        const { scale, width, height } = camera.now, [left, bottom, right, top] = bounds;
        const area = Math.min(width * height, Math.max(1, (right - left) * (top - bottom)) * scale * scale);
        const size = Math.min(2 * least_radius - 2, Math.max(1.5, 0.35 * Math.sqrt(area / at.x.length)));
        const { muted, off } = theme.colors(), words = [pixels.word(off), pixels.word(muted)];
        if (colors.length !== at.x.length) colors = new Int32Array(at.x.length);
        for (let i = 0; i < colors.length; i++) colors[i] = at.storey[i] === state.storey ? words[at.on[i]] : -1;
        pixels.squares(at.x, at.y, colors, size);
    }

    /** Begins the picture of pixels, with all robots if they are a swarm. @param {Run} r @param {State} state */
    function begin(r, state) {
        shown = [];
        for (let i = 0; i < r.robots && shown.length <= many; i++) {
            if (at.storey[i] === state.storey && in_view(i, 40)) shown.push(i);
        }
        pixels.begin();
        if (shown.length > many) swarm(state, r.head.map.bounds);
        else pixels.clear();
    }

    /** Names that find room beside their robots: right, left, above or below. @param {CanvasRenderingContext2D} c @param {Run} r @param {number[]} shown */
    function names(c, r, shown) {
        const size = shown.length > 60 ? 9 : 12;
        for (const i of shown) {
            const { [i]: x } = at.x, { [i]: y } = at.y, reach = radius(r, i) + beyond + 4, high = reach + size / 2;
            pen.label(c, r.label(i), size, theme.colors().ink, width =>
                [[x + reach, y], [x - reach - width, y], [x - width / 2, y - high], [x - width / 2, y + high]]);
        }
    }

    /** Robots of other storeys, pale: a triangle on the first storey, a square on the second, and so on. @param {CanvasRenderingContext2D} c @param {Run} r @param {number} storey that is shown */
    function elsewhere(c, r, storey) {
        const color = theme.colors().muted;
        let named = 0;
        for (let i = 0; i < r.robots; i++) {
            if (at.storey[i] === storey || at.storey[i] === nowhere || !in_view(i, 40)) continue;
            const corners = at.storey[i] + 3, size = radius(r, i) + 2, reach = size + 4;
            c.beginPath();
            for (let k = 0; k < corners; k++) {
                const angle = (2 * k + 1) * Math.PI / corners + Math.PI / 2;
                c.lineTo(at.x[i] + size * Math.cos(angle), at.y[i] + size * Math.sin(angle));
            }
            c.closePath();
            pen.take(c, color, 1.2);
            c.stroke();
            if (++named <= most_named / 4) pen.label(c, `${r.label(i)}, storey ${at.storey[i] + 1}`, 10, color, width => [[at.x[i] + reach, at.y[i]], [at.x[i] - reach - width, at.y[i]]]);
        }
    }

    /** @param {CanvasRenderingContext2D} c @param {Run} r @param {State} state */
    function draw(c, r, state) {
        const colored = state.trails && r.robots <= most_trails;
        pixels.paint(c);
        if (shown.length <= many) {
            for (const i of shown) {
                const rim = colored ? theme.category(i) : theme.colors().ink;
                disc(c, at.x[i], at.y[i], radius(r, i), rim, at.on[i] === 1, false, at.heading[i]);
            }
        }
        for (const i of state.robots) {
            const rim = colored ? theme.category(i) : theme.colors().ink;
            if (at.storey[i] === state.storey) disc(c, at.x[i], at.y[i], radius(r, i) + 1, rim, at.on[i] === 1, true, at.heading[i]);
        }
        const here = shown.length > many ? state.robots.filter(i => at.storey[i] === state.storey) : shown;
        pen.clear(here.map(i => [at.x[i] - 5, at.y[i] - 5, at.x[i] + 5, at.y[i] + 5]));
        if (here.length <= most_named) names(c, r, [...state.robots.filter(i => here.includes(i)), ...here.filter(i => !state.robots.includes(i))]);
        if (state.all) elsewhere(c, r, state.storey);
    }

    /** Robot at a pixel, or -1. @param {Run} r @param {number} px @param {number} py @param {number} storey */
    function near(r, px, py, storey) {
        let best = -1, nearest = Infinity;
        for (let i = 0; i < at.x.length; i++) {
            if (at.storey[i] !== storey && (!selection.state.all || at.storey[i] === nowhere)) continue;
            const away = Math.hypot(at.x[i] - px, at.y[i] - py);
            if (away < nearest && away <= radius(r, i) + 6) [best, nearest] = [i, away];
        }
        return best;
    }

    return { at, place, begin, trails, draw, near, disc, radius };
})();
