// SPDX-License-Identifier: MIT
// Legend below the map: what is seen, and what it means.
/** @typedef {(width: number, draw: (c: CanvasRenderingContext2D) => void, text: string, hint?: string) => HTMLElement} Item */
const legend = (() => {
    "use strict";
    let last = "";

    /** @param {number} width @param {(c: CanvasRenderingContext2D) => void} draw @param {string} text @param {string} [hint] */
    function item(width, draw, text, hint) {
        const out = dom.make("span", "item", dom.icon(width, draw), text);
        if (hint) out.title = hint;
        return out;
    }

    function scale_bar() {
        const { width, scale } = camera.now, length = camera.round_number(width / 6 / scale), px = Math.max(2, length * scale);
        const text = length >= 1000 ? `${length / 1000} km` : length >= 1 ? `${length} m` : `${words.number(length * 100)} cm`;
        return item(px + 2, c => {
            pen.take(c, theme.colors().ink, 2);
            pen.line(c, 1, 4, 1, 12, 1, 8, px + 1, 8, px + 1, 4, px + 1, 12);
        }, text);
    }

    /** @param {Run} r @param {number} storey @returns {HTMLElement[]} */
    function places(r, storey) {
        const out = [], place = r.head.map, used = new Set(r.col("walls.material"));
        if (used.size > 1) {
            for (const number of [...used].slice(0, 12)) {
                const { name, style } = place.materials[number];
                out.push(item(18, c => {
                    c.fillStyle = map.wall_fill(c, style);
                    c.fillRect(0.5, 3.5, 17, 9);
                    pen.take(c, theme.colors().line, 1);
                    c.strokeRect(0.5, 3.5, 17, 9);
                }, words.short(name, 24)));
            }
        }
        if (place.doors.length) {
            out.push(item(20, c => map.door(c, 1, 8, 19, 8, false), "open door"), item(20, c => map.door(c, 1, 8, 19, 8, true), "closed door"));
        }
        if (place.stairs.length) out.push(item(26, c => map.stairs(c, 0, 8, 26, 8), "stairs, up"));
        return out;
    }

    /** @param {Run} r @param {State} state @returns {HTMLElement[]} */
    function marks(r, state) {
        const ink = theme.colors().ink, out = [];
        const some_off = r.col("states.what").includes(0);
        out.push(item(20, c => robots.disc(c, 8, 8, 5, ink, true, false, 0), "robot and heading"));
        if (some_off) out.push(item(16, c => robots.disc(c, 8, 8, 5, ink, false, false, null), "switched off"));
        if (state.trails && r.robots <= 200) {
            out.push(item(24, c => {
                pen.take(c, theme.category(0), 1.2);
                pen.line(c, 0, 11, 10, 5, 24, 8);
            }, "trail of 10 s"));
        }
        return out;
    }

    /** @param {Run} r @param {Blocks} all @returns {HTMLElement[]} */
    function frames(r, all) {
        /** @type {HTMLElement[]} */ const out = [];
        const counts = signs.counts(r);
        if (r.head.counts.flights === 0) return out;
        for (const kind of [...all.kinds].sort((x, y) => x - y)) {
            const name = r.head.frame_kinds[kind];
            out.push(item(18, c => {
                pen.take(c, flights.kind_color(kind), 1.5);
                pen.circle(c, 9, 8, 6);
                c.stroke();
            }, `${name} on air`));
        }
        counts.forEach((n, sign) => {
            if (n > 0) out.push(item(16, c => signs.draw(c, sign, 8, 8, 4), signs.kinds[sign].text, `${words.count(n)} copies in the run`));
        });
        return out;
    }

    /** @param {Run} r @param {Blocks} all @param {State} state */
    function draw(r, all, state) {
        const key = [state.runs, camera.now.scale, camera.now.width, state.storey, state.trails, theme.is_dark(), devicePixelRatio, all.kinds.size, coverage.version(), state.links && links.version(), state.robots, message_panel.version(), signs.counts(r).map(n => n > 0)].join(" ");
        if (key === last) return;
        last = key;
        dom.by_id("legend").replaceChildren(scale_bar(), ...places(r, state.storey), ...marks(r, state), ...antennas.legend(item, r, state), ...frames(r, all), ...links.legend(item, state), ...message_panel.legend(item), ...compare.legend(item), ...coverage.legend(item));
    }

    return { draw };
})();
