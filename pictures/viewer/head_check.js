// SPDX-License-Identifier: MIT
// Check of a view file's head: whatever passes can be drawn.
/** @typedef {(v: any) => boolean} Test */
const head_check = (() => {
    "use strict";
    const outcomes = 16;

    /** @type {Test} */ const text = v => typeof v === "string";
    /** @type {Test} */ const number = v => typeof v === "number" && Number.isFinite(v) && Math.abs(v) < 1e15;
    /** @type {Test} */ const count = v => Number.isSafeInteger(v) && v >= 0;
    /** @type {Test} */ const positive = v => count(v) && v > 0;
    /** @type {Test} */ const color = v => text(v) && /^#[0-9a-f]{6}$/i.test(v);
    /** @param {Test} of @param {number} [least] @returns {Test} */
    const list = (of, least = 0) => v => Array.isArray(v) && v.length >= least && v.every(of);
    /** @param {Record<string, Test>} keys @returns {Test} */
    const object = keys => v => v !== null && typeof v === "object" && Object.keys(keys).every(k => keys[k]?.(v[k]));

    const door = object({ name: text, floor: number, x0: number, y0: number, x1: number, y1: number });
    const stairs = object({ foot: list(number, 3), head: list(number, 3) });
    /** @type {Record<string, Test>} */
    const parts = {
        name: text,
        version: text,
        duration_ns: count,
        robots: list(object({ name: text, radius: number })),
        antennas: list(list(number, 1)),
        map: object({
            bounds: list(number, 4), floors: list(number, 1), materials: list(object({ name: text, style: count })),
            doors: list(door), stairs: list(stairs)
        }),
        colors: object({
            category: list(color, 1), lagoon: list(color, 2), ember: list(color, 9), balance: list(color, 2), links: list(object({ from_db: number, width: number, color }), 1),
            walls: list(object({ color, hatch: v => v === null || text(v) }), 1),
            door: color, stairs: color, outcomes: list(color, outcomes)
        }),
        models: list(text),
        drops: list(object({ text })),
        frame_kinds: list(text, 1),
        message_kinds: list(text, 1),
        flows: list(text, 1),
        blocks: list(object({ begin_ns: count, end_ns: count, flights: count, receptions: count })),
        counts: object({ flights: count, receptions: count, messages: count, outcomes: list(count) }),
        density: list(object({ bins: positive, width_ns: positive })),
        series: list(object({ chart: text, name: text, unit: text, points: count, width_ns: positive, outcome: v => v === undefined || count(v) && v < outcomes })),
        metrics: object({}),
        thinned: list(text),
        damage: list(text),
        follow: list(object({ message: count, robot: count, text })),
        sections: list(object({ name: text }))
    };

    const live = object({ now_ns: count });
    /** Parts of the head of a part of a run that goes on; they need not be there. @type {Record<string, Test>} */
    const later = { ...parts, live };

    /** Name of the first part that is wrong in the head of a later part of a run, or "". @param {any} head */
    function part_fault(head) {
        if (!Array.isArray(head.sections)) return "sections";
        return Object.keys(later).find(key => head[key] !== undefined && !later[key]?.(head[key])) ?? "";
    }

    /** Name of the first part that is missing or wrong, or "". @param {any} head */
    function fault(head) {
        return Object.keys(parts).find(key => !parts[key]?.(head[key])) ?? "";
    }

    return { fault, part_fault, count, outcomes };
})();
