// SPDX-License-Identifier: MIT
// Time line: receptions by outcome, stacked; close up, the frames themselves.
const timeline = (() => {
    "use strict";
    const shortest = 1000;                                 // [ns]
    const axis = 18, bar = 3, most_bars = 1500;  // [px], frames
    /** @type {{run: Run, blocks: Blocks, width: number, height: number, top: number, key: string, picture: HTMLCanvasElement|null}} */
    const own = { run: /** @type {any} */ (null), blocks: /** @type {any} */ (null), width: 100, height: 80, top: 8, key: "", picture: null };

    function span() { return selection.state.span ?? { from: 0, to: Math.max(1, own.run.duration) }; }
    /** @param {number} t */
    function to_x(t) {
        const { from, to } = span();
        return (t - from) / (to - from) * own.width;
    }
    /** @param {number} x */
    function to_t(x) {
        const { from, to } = span();
        return from + x / own.width * (to - from);
    }

    /** Level whose bins are no wider than a pixel, or the finest. */
    function level() {
        const levels = own.run.head.density, { from, to } = span(), pixel = (to - from) / own.width * bar;
        let best = 0;
        for (let i = 1; i < levels.length; i++) {
            const finer = levels[i].width_ns < levels[best].width_ns;
            if (finer ? levels[best].width_ns > pixel : levels[i].width_ns <= pixel) best = i;
        }
        return best;
    }

    /** Receptions of each sign in each column of `bar` pixels. @returns {Float64Array[]} */
    function columns() {
        const out = Array.from({ length: signs.count }, () => new Float64Array(Math.ceil(own.width / bar)));
        if (own.run.head.density.length === 0) return out;
        const n = level(), { bins, width_ns } = own.run.head.density[n], counts = own.run.col(`density.${n}`);
        const { from, to } = span(), outcomes = head_check.outcomes;
        const first = Math.max(0, Math.floor(from / width_ns)), last = Math.min(bins - 1, Math.floor(to / width_ns));
        const wide = width_ns * own.width > (to - from) * bar;
        for (let bin = first; bin <= last; bin++) {
            const low = Math.max(0, Math.floor(to_x(bin * width_ns) / bar)), end = wide ? Math.ceil(to_x((bin + 1) * width_ns) / bar) - 1 : low;
            const high = Math.min(out[0].length - 1, Math.max(low, end));
            if (low > high) continue;
            for (let outcome = 0; outcome < outcomes; outcome++) {
                const count = counts[bin * outcomes + outcome];
                if (!count) continue;
                const column = out[signs.of(outcome)];
                if (high === low) column[low] += count;
                else for (let x = low; x <= high; x++) column[x] = Math.max(column[x], count);
            }
        }
        return out;
    }

    /** @param {CanvasRenderingContext2D} c */
    function density(c) {
        const all = columns(), room = own.height - axis - own.top - 11;
        let most = 0;
        const sums = new Float64Array(all[0].length);
        for (const column of all) column.forEach((v, x) => most = Math.max(most, sums[x] += v));
        if (most === 0) return;
        const base = new Float64Array(sums.length);
        all.forEach((column, sign) => {
            c.fillStyle = signs.color(sign);
            for (let x = 0; x < column.length; x++) {
                if (column[x] === 0) continue;
                const h = Math.max(1.5, column[x] / most * room);
                c.fillRect(x * bar, own.height - axis - base[x] - h, bar, h);
                base[x] += h;
            }
        });
        c.fillStyle = theme.colors().muted;
        c.textAlign = "right";
        c.fillText(`at most ${words.count(most)} in a column`, own.width - 6, own.top + 8);
        c.textAlign = "left";
    }

    /** Frames one below the other, if they are few; false if they are not drawn. @param {CanvasRenderingContext2D} c */
    function frames(c) {
        const { from, to } = span(), levels = own.run.head.density;
        if (levels.length && (to - from) / own.width > levels[level()].width_ns / 8) return false;
        /** @type {[Block, number][]} */ const found = [];
        const whole = own.blocks.between(from, to, (block, i) => {
            found.push([block, i]);
            return found.length <= most_bars;
        });
        if (!whole || found.length > most_bars) return !whole;
        found.sort((a, b) => a[0].start[a[1]] - b[0].start[b[1]]);
        const rows = [0], height = 14, room = Math.floor((own.height - axis - own.top) / height);
        for (const [block, i] of found) {
            const x = to_x(block.start[i]), w = Math.max(2, to_x(block.end(i)) - x);
            const name = own.run.label(block.sender[i], 20), text = c.measureText(name).width + 6, inside = text <= w;
            let row = rows.findIndex(until => until <= x);
            if (row < 0) row = rows.length < room ? rows.length : 0;
            rows[row] = x + (inside ? w : w + text) + 2;
            const y = own.top + row * height;
            c.fillStyle = flights.kind_color(block.kind[i]);
            c.fillRect(x, y, w, height - 2);
            c.fillStyle = inside ? theme.colors().paper : theme.colors().ink;
            c.fillText(name, inside ? Math.max(x, 0) + 3 : x + w + 3, y + height - 5);
        }
        return true;
    }

    /** Doors, robots switched, as ticks on the ground. @param {CanvasRenderingContext2D} c */
    function marks(c) {
        const y = own.height - axis, r = own.run;
        /** @param {Numbers} times @param {string} color */
        const ticks = (times, color) => {
            c.fillStyle = color;
            for (const t of times) if (to_x(t) >= 0 && to_x(t) <= own.width) c.fillRect(to_x(t) - 1, y - 8, 2, 8);
        };
        compare.ticks(c, to_x, own.width, 9);
        ticks(r.col("doors.time"), theme.readable(signs.look.colors.door));
        ticks(r.col("states.time").filter((/** @type {number} */ _, /** @type {number} */ i) => r.col("states.what")[i] <= 1), theme.colors().ink);
    }

    /** @param {CanvasRenderingContext2D} c */
    function ruler(c) {
        const { from, to } = span(), step = camera.round_number((to - from) / own.width * 130) || 1;
        const decimals = Math.min(9, Math.max(0, Math.ceil(9 - Math.log10(step))));
        c.fillStyle = theme.colors().muted;
        pen.take(c, theme.colors().line, 1);
        let free = 0;  // [px] from which on there is no text
        c.beginPath();
        c.moveTo(0, own.height - axis + 0.5);
        c.lineTo(own.width, own.height - axis + 0.5);
        for (let t = Math.ceil(from / step) * step; t <= to; t += step) {
            const x = Math.round(to_x(t)) + 0.5;
            c.moveTo(x, own.height - axis);
            c.lineTo(x, own.height - axis + 4);
            const text = words.seconds(Math.round(t), decimals) + "\u202fs", w = c.measureText(text).width, left = Math.min(own.width - w - 2, Math.max(2, x - w / 2));
            if (left < free) continue;
            c.fillText(text, left, own.height - 4);
            free = left + w + 6;
        }
        c.stroke();
    }

    function paint() {
        if (!own.picture) own.picture = document.createElement("canvas");
        const c = dom.sized(own.picture, own.width, own.height);
        c.font = pen.font(10);
        if (!frames(c)) density(c);
        marks(c);
        ruler(c);
    }

    function draw() {
        const { from, to } = span();
        const key = [from, to, own.width, own.height, theme.is_dark(), own.blocks.version, own.run.duration, own.run.head.counts.receptions, devicePixelRatio].join(" ");
        if (own.key !== key) paint();
        own.key = key;
        const c = dom.sized(dom.canvas("timeline"), own.width, own.height), x = to_x(selection.state.t);
        if (own.picture) c.drawImage(own.picture, 0, 0, own.width, own.height);
        c.fillStyle = theme.colors().ink;
        c.fillRect(x - 0.75, 0, 1.5, own.height - axis);
        c.beginPath();
        c.moveTo(x - 5, 0);
        c.lineTo(x + 5, 0);
        c.lineTo(x, 7);
        c.fill();
    }

    /** @param {number} factor below 1: closer @param {number} x that stays */
    function zoom(factor, x) {
        const { from, to } = span(), t = to_t(x), end = Math.max(1, own.run.duration);
        const length = Math.max(shortest, (to - from) * factor);
        if (length >= end) return selection.set({ span: null });
        const low = Math.min(end - length, Math.max(0, t - (t - from) / (to - from) * length));
        selection.set({ span: { from: low, to: low + length } });
    }

    /** @param {number} by [ns] */
    function move(by) {
        const { from, to } = span(), end = own.run.duration, low = Math.min(end - (to - from), Math.max(0, from + by));
        if (selection.state.span) selection.set({ span: { from: low, to: low + to - from } });
    }

    /** Keeps the time within what is seen. */
    function keep() {
        const { from, to } = span(), { t } = selection.state;
        if (t < from || t > to) move(t - from - (to - from) * (t > to ? 0.1 : 0.9));
    }

    /** @param {HTMLElement} area */
    function pointers(area) {
        let mode = "", last = 0;
        area.addEventListener("wheel", event => {
            event.preventDefault();
            if (Math.abs(event.deltaX) > Math.abs(event.deltaY)) move((to_t(event.deltaX) - to_t(0)));
            else zoom(1.0015 ** event.deltaY, event.offsetX);
        }, { passive: false });
        area.addEventListener("pointerdown", event => {
            area.setPointerCapture(event.pointerId);
            mode = event.shiftKey || event.button === 1 ? "move" : "seek";
            last = event.offsetX;
            if (mode === "seek") clock.seek(to_t(event.offsetX));
        });
        area.addEventListener("pointermove", event => {
            if (mode === "seek") clock.seek(to_t(Math.min(own.width, Math.max(0, event.offsetX))));
            if (mode === "move") move(to_t(last) - to_t(event.offsetX));
            last = event.offsetX;
        });
        for (const end of ["pointerup", "pointercancel"]) area.addEventListener(end, () => mode = "");
    }

    /** @param {Run} r @param {Blocks} all */
    function show(r, all) { Object.assign(own, { run: r, blocks: all, key: "" }); }

    function begin() {
        if (compare.is_there()) own.top = 18;
        pointers(dom.by_id("timeline"));
    }

    /** @param {number} width @param {number} height */
    function resize(width, height) { [own.width, own.height] = [Math.max(50, Math.floor(width)), height]; }

    /** Place of the time shown, if it is seen, else the middle [px]. */
    function middle() {
        const x = to_x(selection.state.t);
        return x >= 0 && x <= own.width ? x : own.width / 2;
    }

    return { begin, show, draw, zoom, middle, keep, resize, span, columns };
})();
