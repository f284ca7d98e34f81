// SPDX-License-Identifier: MIT
// Frames on air: a ring that grows from the sender, lines to the receivers, signs where they end.
const flights = (() => {
    "use strict";
    const most_lines = 4000;
    /** Wall time that a frame stays after its end, and that its ring takes at least [s]. */
    const kept_s = 0.35, least_ring_s = 0.15;
    const shades = 3, crowd = 600;
    const shown = { lines: 0, left_out: 0, frames: 0 };
    const kind_colors = [0, 5, 3, 6, 1, 4];

    /** Colour of a kind of frame. @param {number} kind */
    function kind_color(kind) { return theme.category(kind_colors[kind % kind_colors.length]); }

    /** Lines and signs of one look, drawn together. @typedef {{lines: Path2D, ends: number[]}} Batch */

    /** Share of the way that a frame has made, and share of the time after it. */
    const made = { way: 0, age: 0, ended: false };

    /** @param {Block} block @param {number} flight @param {State} state */
    function progress(block, flight, state) {
        const start = block.start[flight], airtime = Math.max(1, block.airtime[flight]);
        const shown_ns = state.playing && !theme.is_still() ? Math.max(airtime, least_ring_s * state.speed * run.nanoseconds) : airtime;
        made.way = Math.min(1, (state.t - start) / shown_ns);
        made.age = Math.max(0, (state.t - start - Math.max(airtime, shown_ns)) / (kept_s * state.speed * run.nanoseconds));
        made.ended = state.t >= start + airtime && made.way >= 1;
        return made;
    }

    /** @param {CanvasRenderingContext2D} c @param {Blocks} all @param {State} state */
    function draw(c, all, state) {
        const { t, message, storey } = state, kept_ns = (kept_s + least_ring_s) * state.speed * run.nanoseconds;
        const { x: xs, y: ys, storey: storeys } = robots.at, { width, height } = camera.now, grows = theme.is_still() ? 0 : 1;
        const ring_colors = all.run.head.frame_kinds.map((_, kind) => pixels.word(kind_color(kind)));
        let on_air = 0;
        all.between(t - kept_ns, t, () => { on_air++; });
        const crowded = on_air > crowd;
        /** @type {(Batch|undefined)[]} */ const batches = new Array((signs.count + 1) * shades);
        /** Rings of each kind of frame and shade. @type {Map<number, Path2D>} */ const rings = new Map();
        const whole = all.between(t - kept_ns, t, (block, i) => {
            if (message >= 0 && block.message[i] !== message) return;
            const { way, age, ended } = progress(block, i, state);
            if (age > 1) return;
            shown.frames++;
            const { robot, outcome } = block, from = block.sender[i], shade = Math.min(shades - 1, Math.floor(age * shades));
            const x = xs[from], y = ys[from], here = storeys[from] === storey, last = block.first[i + 1];
            let square = 0;  // of the longest line
            for (let k = block.first[i]; k < last; k++) {
                if (here && shown.lines >= most_lines) {
                    shown.left_out += last - k;
                    break;
                }
                const to = robot[k];
                if (!here && storeys[to] !== storey) continue;
                if (shown.lines >= most_lines) {
                    shown.left_out++;
                    continue;
                }
                shown.lines++;
                const dx = xs[to] - x, dy = ys[to] - y, key = (ended ? signs.of(outcome[k]) : signs.count) * shades + shade;
                square = Math.max(square, dx * dx + dy * dy);
                const { lines, ends } = batches[key] ??= { lines: new Path2D(), ends: [] };
                lines.moveTo(x, y);
                lines.lineTo(x + dx * way, y + dy * way);
                if (ended) ends.push(xs[to], ys[to]);
            }
            // Of a crowd, those that are under way.
            if (!here || crowded && age > 0 || ended && !state.playing) return;
            const r = Math.max(8, Math.sqrt(square) * grows * way);
            if (x < -r || y < -r || x > width + r || y > height + r) return;
            if (crowded && pixels.ring(x, y, r, ring_colors[block.kind[i]])) return;
            ring(rings, block.kind[i] * shades + shade, x, y, r);
        });
        for (const [key, path] of rings) {
            c.globalAlpha = 0.8 * (1 - key % shades / shades);
            pen.take(c, kind_color(Math.floor(key / shades)), 1.2);
            c.stroke(path);
        }
        c.globalAlpha = 1;
        for (let key = batches.length - 1; key >= 0; key--) {
            const some = batches[key];
            if (some) stroke(c, some.lines, some.ends, Math.floor(key / shades), 1 - (key % shades) / shades, shown.lines > crowd);
        }
        return whole;
    }

    /** @param {Map<number, Path2D>} rings @param {number} key @param {number} x @param {number} y @param {number} r [px] */
    function ring(rings, key, x, y, r) {
        let path = rings.get(key);
        if (!path) rings.set(key, path = new Path2D());
        path.moveTo(x + r, y);
        path.arc(x, y, r, 0, 2 * Math.PI);
    }

    /** @param {CanvasRenderingContext2D} c @param {Path2D} lines @param {number[]} ends x and y of each @param {number} sign @param {number} strength @param {boolean} crowded */
    function stroke(c, lines, ends, sign, strength, crowded) {
        const under_way = sign >= signs.count;
        const color = under_way ? theme.colors().muted : signs.color(sign);
        c.globalAlpha = strength * (crowded ? 0.5 : 0.85);
        pen.take(c, color, crowded ? 1 : 1.6, under_way ? [4, 3] : []);
        c.stroke(lines);
        if (!under_way && crowded && sign > signs.duplicate) pixels.marks(ends, sign, 3, strength, pixels.word(color));
        if (!under_way && !crowded) {
            const marks = new Path2D();
            for (let i = 0; i < ends.length; i += 2) signs.outline(marks, sign, ends[i] + 9, ends[i + 1] - 9, 4);
            c.globalAlpha = strength;
            pen.rimmed(c, color, 2, marks);
        }
        c.globalAlpha = 1;
    }

    /** Counts what is shown anew, before the maps are drawn. */
    function begin() { shown.lines = shown.left_out = shown.frames = 0; }

    return { begin, draw, shown, kind_color };
})();
