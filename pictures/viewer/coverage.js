// SPDX-License-Identifier: MIT
// Levels that a robot would bring to each place, as the server computes them.
/** @typedef {{run: Run, robot: number, t: number, storey: number, columns: number, rows: number, left: number, bottom: number, cell_width: number, cell_height: number, low: number, high: number, dbm: (number|null)[], picture: HTMLCanvasElement}} HeatMap */
const coverage = (() => {
    "use strict";
    const cells = 60000;
    /** @type {{heat: HeatMap|null, version: number, changed: () => void, say: (text: string) => void}} */
    const own = { heat: null, version: 0, changed: () => {}, say: () => {} };

    /** @param {any} a answer @param {Run} r @param {number} robot @param {number} t @param {number} storey @returns {HeatMap} */
    function heat_of(a, r, robot, t, storey) {
        const { columns, rows, dbm } = a;
        if (!(columns > 0 && rows > 0 && Array.isArray(dbm) && dbm.length === columns * rows)) throw new Error("The server's coverage cannot be read.");
        const levels = dbm.filter(v => typeof v === "number"), high = levels.reduce((m, v) => Math.max(m, v), -300);
        const low = typeof a.low_dbm === "number" ? a.low_dbm : Math.max(high - 90, levels.reduce((m, v) => Math.min(m, v), 300));
        const picture = document.createElement("canvas");
        [picture.width, picture.height] = [columns, rows];
        const c = /** @type {CanvasRenderingContext2D} */ (picture.getContext("2d")), image = c.createImageData(columns, rows);
        const table = Array.from({ length: 256 }, (_, i) => theme.channels(theme.on_scale(signs.look.colors.lagoon, i / 255)));
        for (let i = 0; i < dbm.length; i++) {
            const row = rows - 1 - Math.floor(i / columns), at = 4 * (row * columns + i % columns);
            const share = Math.min(255, Math.max(0, Math.round((dbm[i] - low) / (high - low || 1) * 255)));
            image.data.set([...(table[share] ?? [0, 0, 0]), typeof dbm[i] === "number" ? 255 : 0], at);
        }
        c.putImageData(image, 0, 0);
        return { run: r, robot, t, storey, columns, rows, left: a.left, bottom: a.bottom, cell_width: a.cell_width, cell_height: a.cell_height, low, high, dbm, picture };
    }

    /** Shows the coverage of a robot at this time, or takes it away. @param {number} robot */
    function toggle(robot) {
        const r = sides.own.all[sides.lead()].run;
        if (own.heat?.robot === robot && own.heat.run === r || robot < 0) {
            own.heat = null;
            own.version++;
            return own.changed();
        }
        const { t, storey } = selection.state;
        own.say("computing the coverage \u2026");
        sides.ask("coverage", { robot, t_ns: t, storey, cells }).then(answer => {
            own.heat = heat_of(answer, r, robot, answer.t_ns ?? t, storey);
            own.version++;
            own.say("");
            own.changed();
        }).catch(error => own.say(error.message));
    }

    /** @param {CanvasRenderingContext2D} c @param {Run} r @param {number} storey */
    function paint(c, r, storey) {
        const h = own.heat;
        if (!h || h.run !== r || h.storey !== storey) return;
        const x = camera.to_x(h.left), y = camera.to_y(h.bottom + h.rows * h.cell_height);
        c.imageSmoothingEnabled = false;
        c.drawImage(h.picture, x, y, h.columns * h.cell_width * camera.now.scale, h.rows * h.cell_height * camera.now.scale);
    }

    /** Level at a pixel of a run's map, or "". @param {Run} r @param {number} px @param {number} py */
    function level_at(r, px, py) {
        const h = own.heat;
        if (h?.run !== r) return "";
        const column = Math.floor((camera.from_x(px) - h.left) / h.cell_width), row = Math.floor((camera.from_y(py) - h.bottom) / h.cell_height);
        if (column < 0 || row < 0 || column >= h.columns || row >= h.rows) return "";
        const level = h.dbm[row * h.columns + column];
        return typeof level === "number" ? `${level.toFixed(1).replace("-", "\u2212")} dBm` : "";
    }

    /** @param {(width: number, draw: (c: CanvasRenderingContext2D) => void, text: string) => HTMLElement} item */
    function legend(item) {
        const h = own.heat;
        if (!h) return [];
        return [item(90, c => {
            for (let x = 0; x < 90; x++) {
                c.fillStyle = theme.on_scale(signs.look.colors.lagoon, x / 89);
                c.fillRect(x, 3, 1, 10);
            }
        }, `coverage of ${words.shortened(words.visible(h.run.name(h.robot)), 24)}, ${words.number(Math.round(h.low))} to ${words.number(Math.round(h.high))} dBm, at ${words.seconds(h.t, 3)} s`)];
    }

    /** @param {() => void} changed @param {(text: string) => void} say */
    function begin(changed, say) { Object.assign(own, { changed, say }); }

    return { begin, toggle, paint, level_at, legend, version: () => own.version };
})();
