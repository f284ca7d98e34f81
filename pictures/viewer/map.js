// SPDX-License-Identifier: MIT
// Map of a storey: walls, doors, stairs. It is painted once for each view and kept.
const map = (() => {
    "use strict";
    const hatch_size = 6, thin_line = 0.4;  // [px]
    /** Painted map of each run. @type {WeakMap<Run, {canvas: HTMLCanvasElement, key: string}>} */ const painted = new WeakMap();

    /** @param {CanvasRenderingContext2D} c @param {number} style @returns {string|CanvasPattern} */
    function wall_fill(c, style) {
        const walls = signs.look.colors.walls, { color, hatch } = walls[style % walls.length];
        if (!hatch) return theme.wall(color);
        const tile = document.createElement("canvas");
        tile.width = tile.height = 2 * hatch_size;
        const t = /** @type {CanvasRenderingContext2D} */ (tile.getContext("2d"));
        t.scale(2, 2);
        t.fillStyle = theme.colors().paper;
        t.fillRect(0, 0, hatch_size, hatch_size);
        t.strokeStyle = theme.wall(color);
        t.lineWidth = 1.4;
        t.stroke(new Path2D(hatch));
        const pattern = c.createPattern(tile, "repeat");
        if (!pattern) return theme.wall(color);
        pattern.setTransform(new DOMMatrix([0.5, 0, 0, 0.5, 0, 0]));
        return pattern;
    }

    /** @param {CanvasRenderingContext2D} c @param {Run} r @param {number} storey @param {boolean} rimmed by paper, since colours lie below */
    function walls(c, r, storey, rimmed) {
        const material = r.col("walls.material"), of = r.col("walls.storey"), x = r.col("walls.x"), y = r.col("walls.y");
        /** @type {Map<number, Path2D>} */ const paths = new Map();
        for (let i = 0; i < material.length; i++) {
            if (of[i] !== storey) continue;
            let path = paths.get(material[i]);
            if (!path) paths.set(material[i], path = new Path2D());
            path.moveTo(camera.to_x(x[4 * i]), camera.to_y(y[4 * i]));
            for (let k = 1; k < 4; k++) path.lineTo(camera.to_x(x[4 * i + k]), camera.to_y(y[4 * i + k]));
            path.closePath();
        }
        for (const [number, path] of paths) {
            const style = r.head.map.materials[number].style;
            if (rimmed) {
                pen.take(c, theme.colors().paper, 2.5);
                c.stroke(path);
            }
            c.fillStyle = wall_fill(c, style);
            c.fill(path);
            pen.take(c, theme.wall(signs.look.colors.walls[style % signs.look.colors.walls.length].color), thin_line);
            c.stroke(path);
        }
    }

    /** Outline of a door, which has at least that width [px]. @param {CanvasRenderingContext2D} c @param {number} x0 @param {number} y0 @param {number} x1 @param {number} y1 @param {boolean} closed */
    function door(c, x0, y0, x1, y1, closed) {
        const length = Math.hypot(x1 - x0, y1 - y0) || 1, half = 3;
        const nx = -(y1 - y0) / length * half, ny = (x1 - x0) / length * half;
        const outline = new Path2D(`M${x0 + nx} ${y0 + ny}L${x1 + nx} ${y1 + ny} ${x1 - nx} ${y1 - ny} ${x0 - nx} ${y0 - ny}Z`);
        c.fillStyle = theme.colors().paper;
        c.fill(outline);
        pen.take(c, theme.readable(signs.look.colors.door), closed ? 2.2 : 1, closed ? [] : [3, 2]);
        c.stroke(outline);
    }

    /** Stairs from foot to head [px]. @param {CanvasRenderingContext2D} c @param {number} x0 @param {number} y0 @param {number} x1 @param {number} y1 */
    function stairs(c, x0, y0, x1, y1) {
        const rung = 7, apart = 5, tip = 6;
        const length = Math.max(Math.hypot(x1 - x0, y1 - y0), 1e-9), ux = (x1 - x0) / length, uy = (y1 - y0) / length;
        c.beginPath();
        c.moveTo(x0, y0);
        c.lineTo(x1, y1);
        for (let at = apart; at < length - tip; at += apart) {
            const x = x0 + at * ux, y = y0 + at * uy;
            c.moveTo(x - rung / 2 * uy, y + rung / 2 * ux);
            c.lineTo(x + rung / 2 * uy, y - rung / 2 * ux);
        }
        c.moveTo(x1 - tip * ux - tip / 2 * uy, y1 - tip * uy + tip / 2 * ux);
        c.lineTo(x1, y1);
        c.lineTo(x1 - tip * ux + tip / 2 * uy, y1 - tip * uy - tip / 2 * ux);
        pen.take(c, theme.readable(signs.look.colors.stairs), 1);
        c.stroke();
    }

    /** Faint lines at round places, where no walls tell the size. @param {CanvasRenderingContext2D} c */
    function grid(c) {
        const { width, height, scale } = camera.now, step = camera.round_number(160 / scale);
        c.fillStyle = theme.colors().faint;
        const left = Math.ceil(camera.from_x(0) / step), top = Math.floor(camera.from_y(0) / step);
        for (let i = 0; i * step * scale <= width; i++) c.fillRect(Math.round(camera.to_x((left + i) * step)), 0, 1, height);
        for (let i = 0; i * step * scale <= height; i++) c.fillRect(0, Math.round(camera.to_y((top - i) * step)), width, 1);
    }

    /** @param {CanvasRenderingContext2D} c @param {Run} r @param {number} storey @param {boolean[]} closed */
    function paint(c, r, storey, closed) {
        const { width, height } = camera.now, place = r.head.map;
        c.fillStyle = theme.colors().paper;
        c.fillRect(0, 0, width, height);
        if (place.open_field) grid(c);
        walls(c, r, storey, coverage.paint(c, r, storey));
        place.doors.forEach((d, i) => {
            if (r.storey(d.floor) === storey) door(c, camera.to_x(d.x0), camera.to_y(d.y0), camera.to_x(d.x1), camera.to_y(d.y1), closed[i]);
        });
        for (const { foot, head } of place.stairs) {
            const here = r.storey(foot[2]) === storey || r.storey(head[2]) === storey;
            if (here) stairs(c, camera.to_x(foot[0]), camera.to_y(foot[1]), camera.to_x(head[0]), camera.to_y(head[1]));
        }
        coverage.lines(c, r, storey);
    }

    /** @param {CanvasRenderingContext2D} c @param {Run} r @param {State} state */
    function draw(c, r, state) {
        const closed = r.doors(state.t), kept = painted.get(r) ?? { canvas: document.createElement("canvas"), key: "" };
        const { x, y, scale, width, height } = camera.now;
        const key = [x, y, scale, width, height, state.storey, closed.map(Number).join(""), theme.is_dark(), devicePixelRatio, coverage.version()].join(" ");
        if (kept.key !== key) {
            painted.set(r, kept);
            paint(dom.sized(kept.canvas, width, height), r, state.storey, closed);
            kept.key = key;
        }
        c.drawImage(kept.canvas, 0, 0, width, height);
    }

    return { draw, door, stairs, wall_fill };
})();
