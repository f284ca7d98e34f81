// SPDX-License-Identifier: MIT
// Charts of the run's series, and its metrics. Their time is that of the time line.
/** @typedef {{chart: string, name: string, unit: string, points: number, width_ns: number, outcome?: number, values?: (number|null)[]}} Series */
/** @typedef {{name: string, color: () => string, width: number, values: Numbers}} Curve */
/** @typedef {{canvas: HTMLCanvasElement, told: HTMLElement, unit: string, curves: Curve[]}} Chart */
const charts = (() => {
    "use strict";
    const height = 92, left = 40, axis = 16, top = 6, least_drag = 4;  // [px]
    /** @type {{run: Run, charts: Chart[], key: string, hover: number, drag: {chart: Chart, from: number, to: number}|null, asked: number}} */
    const own = { run: /** @type {any} */ (null), charts: [], key: "", hover: -1, drag: null, asked: 0 };
    const again_ms = 1000;

    function width() { return Math.max(120, dom.by_id("charts-panel").clientWidth - 8); }
    /** @param {number} t */
    function to_x(t) {
        const { from, to } = timeline.span();
        return left + (t - from) / (to - from) * (width() - left);
    }
    /** @param {number} x */
    function to_t(x) {
        const { from, to } = timeline.span();
        return Math.min(to, Math.max(from, from + (x - left) / (width() - left) * (to - from)));
    }

    /** Value of a curve at a time. @param {Curve} curve @param {number} t */
    function value(curve, t) {
        return curve.values[Math.min(curve.values.length - 1, Math.max(0, Math.ceil(t / curve.width) - 1))];
    }

    /** @param {number} v @param {string} unit */
    function text(v, unit) {
        if (!Number.isFinite(v)) return "\u2013";
        return unit === "s" ? words.span(v * run.nanoseconds) : words.number(v, 3) + (unit && `\u2009${unit}`);
    }

    /** First and last bin of a curve that are seen. @param {Curve} curve */
    function seen(curve) {
        const { from, to } = timeline.span();
        return [Math.max(0, Math.floor(from / curve.width)), Math.min(curve.values.length - 1, Math.ceil(to / curve.width))];
    }

    /** Upper end of the axis. @param {Chart} chart */
    function most_of(chart) {
        let most = 0;
        for (const curve of chart.curves) {
            const [first, last] = seen(curve);
            for (let i = first; i <= last; i++) if (curve.values[i] > most) most = curve.values[i];
        }
        return most || 1;
    }

    /** @param {CanvasRenderingContext2D} c @param {Curve} curve @param {(v: number) => number} to_y */
    function line(c, curve, to_y) {
        const [first, last] = seen(curve);
        c.beginPath();
        for (let i = first; i <= last; i++) {
            const v = curve.values[i], x = to_x(i * curve.width), y = to_y(v), begins = !Number.isFinite(curve.values[i - 1]);
            if (!Number.isFinite(v)) continue;
            if (begins) c.moveTo(x, y); else c.lineTo(x, y);
            c.lineTo(to_x((i + 1) * curve.width) + (begins && !Number.isFinite(curve.values[i + 1]) ? 2 : 0), y);
        }
        pen.take(c, curve.color(), 1.5);
        c.stroke();
    }

    /** @param {Chart} chart */
    function paint(chart) {
        const wide = width(), c = dom.sized(chart.canvas, wide, height), most = most_of(chart), step = camera.round_number(most / 2);
        const scale = chart.unit === "s" ? most : Math.ceil(most / step - 1e-9) * step, colors = theme.colors(), { from, to } = timeline.span();
        /** @param {number} v */
        const to_y = v => height - axis - v / scale * (height - axis - top);
        c.font = pen.font(10);
        c.textBaseline = "middle";
        c.fillStyle = colors.muted;
        c.textAlign = "right";
        for (let v = 0; v <= scale * 1.001; v += step) {
            const y = Math.round(to_y(v)) + 0.5;
            pen.take(c, colors.faint, 1);
            pen.line(c, left, y, wide, y);
            c.fillText(text(v, chart.unit === "s" ? "s" : "").replace(/^0(?![.,]).*/, "0"), left - 4, y);
        }
        c.textAlign = "center";
        const tick = camera.round_number((to - from) / 3.5) || 1;
        for (let t = Math.ceil(from / tick) * tick; t <= to; t += tick) {
            const label = `${words.number(t / run.nanoseconds, 9)}${t + tick > to ? "\u2009s" : ""}`, half = c.measureText(label).width / 2;
            c.fillText(label, Math.min(wide - half, Math.max(left + half - 8, to_x(t))), height - 6);
        }
        c.save();
        c.beginPath();
        c.rect(left, 0, wide - left, height - axis + 1);
        c.clip();
        for (const curve of chart.curves) line(c, curve, to_y);
        if (own.drag?.chart === chart) {
            c.globalAlpha = 0.2;
            c.fillStyle = colors.accent;
            c.fillRect(Math.min(own.drag.from, own.drag.to), 0, Math.abs(own.drag.to - own.drag.from), height);
            c.globalAlpha = 1;
        }
        c.fillStyle = colors.ink;
        c.fillRect(Math.round(to_x(selection.state.t)), 0, 1, height - axis);
        c.restore();
    }

    /** Values under the pointer, or at the time shown. @param {Chart} chart */
    function tell(chart) {
        const t = own.hover >= 0 ? own.hover : selection.state.t;
        chart.told.replaceChildren(...chart.curves.map(curve => {
            const out = dom.make("span", "item", dom.icon(10, c => {
                c.fillStyle = curve.color();
                c.fillRect(0, 7, 10, 2);
            }), `${curve.name} ${text(value(curve, t), chart.unit)}`);
            return out;
        }));
        chart.canvas.setAttribute("aria-label", `${chart.canvas.title}: ${chart.told.textContent}`);
    }

    /** @param {Chart} chart */
    function pointers(chart) {
        const { canvas } = chart;
        canvas.addEventListener("pointerdown", event => {
            canvas.setPointerCapture(event.pointerId);
            own.drag = { chart, from: event.offsetX, to: event.offsetX };
        });
        canvas.addEventListener("pointermove", event => {
            own.hover = to_t(event.offsetX);
            if (own.drag) own.drag.to = event.offsetX;
            main.redraw();
        });
        canvas.addEventListener("pointerup", event => {
            const begin = own.drag?.from ?? event.offsetX, [from, to] = [begin, event.offsetX].map(to_t).sort((a, b) => a - b);
            own.drag = null;
            if (Math.abs(begin - event.offsetX) < least_drag) clock.seek(to_t(event.offsetX));
            else if (to - from >= 1000) selection.set({ span: { from, to }, t: Math.min(to, Math.max(from, selection.state.t)) });
        });
        for (const end of ["pointerleave", "pointercancel"]) {
            canvas.addEventListener(end, () => {
                own.hover = -1;
                own.drag = null;
                main.redraw();
            });
        }
    }

    /** @param {State} state */
    function update(state) {
        if (state.panel !== "charts") return;
        if (live.is_live()) ask();
        const key = [state.t, state.span?.from, state.span?.to, own.hover, own.drag?.to, width(), theme.is_dark(), devicePixelRatio].join(" ");
        if (key === own.key) return;
        own.key = key;
        for (const chart of own.charts) {
            paint(chart);
            tell(chart);
        }
    }

    /** Asks for the series of a run that goes on, once a second, and when it has ended. */
    function ask() {
        const now = performance.now(), goes_on = live.goes_on();
        if (own.drag || own.asked === Infinity || goes_on && now < own.asked + again_ms) return;
        own.asked = goes_on ? now : Infinity;
        server.ask("series", {}).then(answer => {
            fill(answer.series, answer.metrics, ...(answer.from_ns > 0 ? [dom.make("p", "muted", `From ${words.seconds(answer.from_ns, 3)} s on, when a page was opened.`)] : []));
            main.redraw();
        }, error => dom.by_id("charts-panel").replaceChildren(dom.make("p", "muted", error.message)));
    }

    /** Curves of one chart; outcomes of receptions by their sign. @param {Series[]} series @returns {Curve[]} */
    function curves_of(series) {
        /** @type {Map<number, Curve>} */ const by_sign = new Map(), out = /** @type {Curve[]} */ ([]);
        for (const one of series) {
            const i = out.length, values = one.values ? Float64Array.from(one.values, v => v ?? NaN) : own.run.col(`series.${own.run.head.series.indexOf(one)}`);
            if (one.outcome === undefined) {
                out.push({ name: words.visible(one.name), color: () => theme.category(i), width: one.width_ns, values });
                continue;
            }
            const sign = signs.of(one.outcome), there = by_sign.get(sign);
            if (there) there.values = there.values.map((v, k) => v + values[k]);
            else by_sign.set(sign, { name: signs.kinds[sign].text, color: () => signs.color(sign), width: one.width_ns, values });
        }
        return [...out, ...by_sign.values()];
    }

    /** Canvas of a chart: the one that is there, or a new one. @param {string} title @returns {Chart} */
    function chart_of(title) {
        const there = own.charts.find(chart => chart.canvas.title === title);
        if (there) return there;
        const canvas = /** @type {HTMLCanvasElement} */ (dom.make("canvas", "chart"));
        canvas.title = title;
        canvas.setAttribute("role", "img");
        const chart = { canvas, told: dom.make("p", "told"), unit: "", curves: [] };
        pointers(chart);
        return chart;
    }

    /** @param {Series[]} series @param {Record<string, unknown>} metrics @param {(Node|string)[]} first */
    function fill(series, metrics, ...first) {
        own.charts = [...new Set(series.map(s => s.chart))].map(title => {
            const some = series.filter(s => s.chart === title);
            return Object.assign(chart_of(title), { unit: some[0].unit, curves: curves_of(some) });
        });
        own.key = "";
        const rows = Object.entries(metrics).filter(([, v]) => typeof v === "number").map(([key, v]) => /** @type {[string, string]} */ ([tables.title(key), tables.text(v)]));
        dom.by_id("charts-panel").replaceChildren(...first, ...own.charts.flatMap(chart => [dom.make("h3", "", chart.canvas.title), chart.told, chart.canvas]),
            ...(rows.length ? [dom.make("h3", "", "Metrics of the run"), dom.facts(rows)] : []));
    }

    /** @param {Run} r */
    function show(r) {
        Object.assign(own, { run: r, asked: 0, charts: [] });
        fill(r.head.series, r.head.metrics);
    }

    /** Values of all charts at a time, for tests. @param {number} t */
    function values(t) {
        return own.charts.map(chart => ({ chart: chart.canvas.title, values: chart.curves.map(curve => ({ name: curve.name, value: value(curve, t) })) }));
    }

    return { show, update, values };
})();
