// SPDX-License-Identifier: MIT
// Levels that a robot would bring to each place, or their difference under another model, as the server computes them.
/** @typedef {{meaning: string, level_dbm?: number, range_m?: number, other: boolean, lines: number[][]}} Contour */
/** @typedef {{run: Run, robot: number, t: number, storey: number, model: string, columns: number, rows: number, left: number, bottom: number, cell_width: number, cell_height: number, low: number, high: number, dbm: (number|null)[], difference: number[]|null, contours: Contour[], picture: HTMLCanvasElement}} HeatMap */
const coverage = (() => {
    "use strict";
    const cells = 60000;
    /** @type {{heat: HeatMap|null, version: number, model: string, changed: () => void, say: (text: string) => void, run: Run}} */
    const own = { heat: null, version: 0, model: "", changed: () => {}, say: () => {}, run: /** @type {any} */ (null) };

    /** Colour scale of a heat map. @param {HeatMap} h */
    function scale(h) { return h.difference ? signs.look.colors.balance : signs.look.colors.lagoon; }

    /** @param {HeatMap} h */
    function paint_picture(h) {
        [h.picture.width, h.picture.height] = [h.columns, h.rows];
        const c = /** @type {CanvasRenderingContext2D} */ (h.picture.getContext("2d")), image = c.createImageData(h.columns, h.rows);
        const table = Array.from({ length: 256 }, (_, i) => theme.channels(theme.on_scale(scale(h), i / 255)));
        (h.difference ?? h.dbm).forEach((v, i) => {
            const row = h.rows - 1 - Math.floor(i / h.columns), at = 4 * (row * h.columns + i % h.columns);
            if (typeof v === "number") image.data.set([...table[Math.min(255, Math.max(0, Math.round((v - h.low) / (h.high - h.low || 1) * 255)))], 255], at);
        });
        c.putImageData(image, 0, 0);
    }

    /** @param {any} a answer @param {Run} r @param {number} robot @param {number} t @param {number} storey @param {string} model @returns {HeatMap} */
    function heat_of(a, r, robot, t, storey, model) {
        const difference = a.difference_db ?? null, [low, high] = difference ? [-a.most_db, a.most_db] : [a.low_dbm, a.high_dbm];
        const out = { ...a, run: r, robot, t, storey, model, low, high, difference, picture: document.createElement("canvas") };
        paint_picture(out);
        return out;
    }

    /** @param {number} robot */
    async function ask(robot) {
        const { t, storey } = selection.state, { model, run: r } = own;
        own.say("computing the coverage \u2026");
        try {
            const answer = await sides.ask("coverage", { robot, t_ns: t, storey, cells, ...model && { with: `propagation.model=${model}` } });
            own.heat = heat_of(answer, r, robot, answer.t_ns ?? t, storey, model);
            own.version++;
            own.say("");
            selection.set({ coverage: robot });
            own.changed();
        } catch (error) {
            own.say(/** @type {Error} */ (error).message);
        }
    }

    /** Shows the coverage of a robot at this time, or takes it away. @param {number} robot */
    function toggle(robot) {
        if ((own.heat?.robot !== robot || own.heat.run !== own.run) && robot >= 0) return ask(robot);
        own.heat = null;
        own.version++;
        selection.set({ coverage: -1 });
        own.changed();
    }

    /** Choice of the model with which the coverage is compared. */
    function choice() {
        const out = /** @type {HTMLSelectElement} */ (dom.make("select", "", ...["", ...own.run.head.models].map(name => {
            const option = /** @type {HTMLOptionElement} */ (dom.make("option", "", name ? `difference to ${name}` : "levels"));
            option.value = name;
            return option;
        })));
        out.value = own.model;
        out.setAttribute("aria-label", "What the coverage shows");
        out.addEventListener("change", () => {
            own.model = out.value;
            if (own.heat) ask(own.heat.robot);
        });
        return out;
    }

    /** True if there is one. @param {CanvasRenderingContext2D} c @param {Run} r @param {number} storey */
    function paint(c, r, storey) {
        const h = own.heat;
        if (!h || h.run !== r || h.storey !== storey) return false;
        const x = camera.to_x(h.left), y = camera.to_y(h.bottom + h.rows * h.cell_height);
        c.imageSmoothingEnabled = false;
        c.drawImage(h.picture, x, y, h.columns * h.cell_width * camera.now.scale, h.rows * h.cell_height * camera.now.scale);
        return true;
    }

    /** Strokes a contour's path. @param {CanvasRenderingContext2D} c @param {Contour} contour */
    function stroke(c, { meaning, other }) {
        for (const [color, width, alpha] of /** @type {[string, number, number][]} */ ([["#ffffff", 3.2, 0.7], [other ? "#a03000" : "#00501e", 1.8, 1]])) {
            pen.take(c, color, width, alpha < 1 ? [] : meaning === "range_db" ? [7, 4] : other ? [2, 2] : []);
            c.globalAlpha = alpha;
            c.stroke();
        }
    }

    /** @param {CanvasRenderingContext2D} c @param {Run} r @param {number} storey */
    function lines(c, r, storey) {
        if (own.heat?.run !== r || own.heat.storey !== storey) return;
        for (const contour of own.heat.contours) {
            c.beginPath();
            for (const line of contour.lines) {
                for (let i = 0; i + 1 < line.length; i += 2) c[i ? "lineTo" : "moveTo"](camera.to_x(line[i]), camera.to_y(line[i + 1]));
            }
            stroke(c, contour);
        }
    }

    /** Level at a pixel of a run's map, or "". @param {Run} r @param {number} px @param {number} py */
    function level_at(r, px, py) {
        const h = own.heat;
        if (h?.run !== r) return "";
        const column = Math.floor((camera.from_x(px) - h.left) / h.cell_width), row = Math.floor((camera.from_y(py) - h.bottom) / h.cell_height);
        if (column < 0 || row < 0 || column >= h.columns || row >= h.rows) return "";
        const at = row * h.columns + column, level = h.dbm[at];
        if (typeof level !== "number") return "";
        /** @param {number} v @param {string} unit */
        const text = (v, unit) => `${words.fixed(v, 1)} ${unit}`;
        return text(level, "dBm") + (h.difference ? `, ${h.model} ${text(level + h.difference[at], "dBm")} (${h.difference[at] > 0 ? "+" : ""}${text(h.difference[at], "dB")})` : "");
    }

    /** @param {Item} item */
    function legend(item) {
        const h = own.heat;
        if (!h) return [];
        const who = h.run.label(h.robot), when = `at ${words.seconds(h.t, 3)} s`, ends = `${words.number(h.low)} to ${words.number(h.high)}`;
        const bar = item(90, c => {
            for (let x = 0; x < 90; x++) {
                c.fillStyle = theme.on_scale(scale(h), x / 89);
                c.fillRect(x, 3, 1, 10);
            }
        }, h.difference ? `${h.model} \u2212 ${h.run.head.robots[h.robot].model}, of ${who}, ${ends} dB, ${when}` : `coverage of ${who}, ${ends} dBm, ${when}`);
        const contours = h.contours.map(contour => item(26, c => {
            c.beginPath();
            c.moveTo(0, 8);
            c.lineTo(26, 8);
            stroke(c, contour);
        }, (contour.range_m === undefined ? `${words.number(contour.level_dbm ?? 0)} dBm, ${contour.meaning}` : `range of ${words.number(contour.range_m)} m`) + (contour.other ? ` by ${h.model}` : "")));
        return [...h.dbm.some(v => typeof v === "number") ? [bar] : [], ...contours];
    }

    /** @param {() => void} changed @param {(text: string) => void} say */
    function begin(changed, say) {
        Object.assign(own, { changed, say });
        if (selection.state.coverage >= 0) ask(selection.state.coverage);
    }

    /** @param {Run} r */
    function show(r) { own.run = r; }

    return { begin, show, heat: () => own.heat, shown: () => own.heat?.robot ?? -1, toggle, choice, paint, lines, level_at, legend, version: () => own.version };
})();
